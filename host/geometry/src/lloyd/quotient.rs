//! Integer division, rounded down, of numbers whose quotient usually is small.

/// Quotients up to this magnitude come from an estimate in doubles, which then is off by one at most.
const SMALL: f64 = (1u64 << 50) as f64;

/// The quotient, rounded down, for a positive divisor. Division of 128 bits takes several times as long as an estimate
/// that is put right by its remainder.
#[inline]
pub(super) fn floor_quotient(n: i128, d: i128) -> i128 {
    let estimate = n as f64 / d as f64;
    // Three roundings of 2^-53 each: below this limit the estimate is off by less than a half.
    if estimate.abs() < SMALL {
        // The conversion cuts off towards zero: for negative estimates that is up to one too much.
        let quotient = i128::from(estimate as i64 - i64::from(estimate < 0.0));
        let rest = n.wrapping_sub(quotient.wrapping_mul(d));
        return quotient + i128::from(rest >= d) - i128::from(rest < 0);
    }
    n.div_euclid(d)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn quotients_are_those_of_the_division(n in any::<i128>(), d in 1..=i128::MAX, cut in 0u32..126, cut_d in 0u32..126) {
            let (n, d) = (n >> cut >> 1, (d >> cut_d >> 1).max(1));
            prop_assert_eq!(floor_quotient(n, d), n.div_euclid(d));
            // Exact multiples and their neighbours.
            let multiple = n.div_euclid(d) * d;
            for n in [multiple, multiple.saturating_sub(1), multiple.saturating_add(1)] {
                prop_assert_eq!(floor_quotient(n, d), n.div_euclid(d));
            }
        }
    }
}
