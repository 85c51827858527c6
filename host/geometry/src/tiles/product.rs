//! The comparison of two products of integers that are too wide for 128 bits.

/// Bits of a half of a factor.
const HALF: u32 = u128::BITS / 2;

/// Whether `one * other > square²`, for all integers. Products have 256 bits; those of factors that fit 64 bits take
/// one multiplication each.
pub(super) fn exceeds_square(one: i128, other: i128, square: i128) -> bool {
    if let (Ok(one), Ok(other), Ok(square)) = (i64::try_from(one), i64::try_from(other), i64::try_from(square)) {
        return i128::from(one) * i128::from(other) > i128::from(square) * i128::from(square);
    }
    // A square is not negative.
    (one < 0) == (other < 0) && product(one, other) > product(square, square)
}

/// The magnitude of a product: its upper and its lower 128 bits.
fn product(one: i128, other: i128) -> (u128, u128) {
    let halves = |factor: i128| (factor.unsigned_abs() >> HALF, u128::from(factor.unsigned_abs() as u64));
    let ((one_high, one_low), (other_high, other_low)) = (halves(one), halves(other));
    let low = one_low * other_low;
    // Both sums are at most (2^64 - 1)² + 2^64 - 1, which is below 2^128.
    let first = one_high * other_low + (low >> HALF);
    let second = one_low * other_high + u128::from(first as u64);
    let high = one_high * other_high + (first >> HALF) + (second >> HALF);
    (high, second << HALF | u128::from(low as u64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    #[test]
    fn products_of_the_widest_factors_are_whole() {
        assert_eq!(product(i128::MIN, i128::MIN), (1 << 126, 0));
        assert_eq!(product(i128::MAX, i128::MAX), ((1 << 126) - 1, 1));
        assert_eq!(product(-1, i128::MAX), (0, i128::MAX as u128));
        assert_eq!(product(1 << 100, 1 << 100), (1 << 72, 0));
    }

    #[test]
    fn products_obey_the_law_of_squares() {
        // (a + b)(a - b) = a² - b², so the product is below a² for b that is not zero.
        let mut random = SplitMix64::new(3);
        for _ in 0..10_000 {
            let bits = 1 + random.below(126) as u32;
            let wide = i128::from(random.next_u64()) << 64 | i128::from(random.next_u64());
            let square = wide >> (127 - bits);
            let step = 1 + i128::from(random.below(3));
            if square.unsigned_abs() < 1 << 126 {
                assert!(!exceeds_square(square + step, square - step, square), "{square} {step}");
                assert!(exceeds_square(square, square + square.signum(), square) == (square != 0), "{square}");
                assert!(!exceeds_square(square, square, square), "{square}");
                assert!(!exceeds_square(-1 - square.abs(), 1 + square.abs(), square), "{square}");
            }
        }
    }
}
