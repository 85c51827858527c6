//! The comparison of two products of integers that are too wide for 128 bits.

use crate::product::product;

/// Whether `one * other > square²`, for all integers. Products have 256 bits; those of factors that fit 64 bits take
/// one multiplication each.
pub(super) fn exceeds_square(one: i128, other: i128, square: i128) -> bool {
    if let (Ok(one), Ok(other), Ok(square)) = (i64::try_from(one), i64::try_from(other), i64::try_from(square)) {
        return i128::from(one) * i128::from(other) > i128::from(square) * i128::from(square);
    }
    // A square is not negative.
    let magnitude = |one: i128, other: i128| product(one.unsigned_abs(), other.unsigned_abs());
    (one < 0) == (other < 0) && magnitude(one, other) > magnitude(square, square)
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

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
