//! Products of two integers of 128 bits, compared exactly.

use core::cmp::Ordering;

use crate::product::product;

/// Compares the products of two pairs.
#[inline]
pub(super) fn compare_products([a, b]: [i128; 2], [c, d]: [i128; 2]) -> Ordering {
    if let (Some(one), Some(other)) = (a.checked_mul(b), c.checked_mul(d)) {
        return one.cmp(&other);
    }
    let (one, other) = (a.signum() * b.signum(), c.signum() * d.signum());
    one.cmp(&other).then_with(|| {
        let size = |x: i128, y: i128| product(x.unsigned_abs(), y.unsigned_abs());
        let sizes = size(a, b).cmp(&size(c, d));
        if one < 0 {
            sizes.reverse()
        } else {
            sizes
        }
    })
}

/// Compares two fractions of a numerator and a denominator, which is not zero.
#[inline]
pub(super) fn compare_fractions([a, b]: [i128; 2], [c, d]: [i128; 2]) -> Ordering {
    let order = compare_products([a, d], [c, b]);
    if (b < 0) == (d < 0) {
        order
    } else {
        order.reverse()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn comparisons_are_those_of_integers_of_any_size(
            numbers in [any::<i128>(), any::<i128>(), any::<i128>(), any::<i128>()],
            cuts in [0u32..127, 0u32..127, 0u32..127, 0u32..127],
            alike in any::<bool>(),
        ) {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| numbers[k] >> cuts[k]);
            let (c, d) = if alike { (b, a) } else { (c, d) };
            let big = |x: i128, y: i128| BigInt::from(x) * BigInt::from(y);
            prop_assert_eq!(compare_products([a, b], [c, d]), big(a, b).cmp(&big(c, d)));
            if b != 0 && d != 0 {
                let expected = (big(a, d) - big(c, b)) * b.signum() * d.signum();
                prop_assert_eq!(compare_fractions([a, b], [c, d]), expected.cmp(&BigInt::ZERO));
            }
        }
    }
}
