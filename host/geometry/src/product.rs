//! Products of integers of 128 bits, as numbers of 256 bits.

/// The product of two numbers of 128 bits: its upper and its lower 128 bits.
#[inline]
pub(crate) fn product(one: u128, other: u128) -> (u128, u128) {
    const HALF: u32 = u128::BITS / 2;
    const LOW: u128 = u64::MAX as u128;
    let ([a, b], [c, d]) = ([one >> HALF, one & LOW], [other >> HALF, other & LOW]);
    let low = b * d;
    // Both sums are at most (2^64 - 1)^2 + 2^64 - 1, which is below 2^128.
    let first = a * d + (low >> HALF);
    let second = b * c + (first & LOW);
    (a * c + (first >> HALF) + (second >> HALF), second << HALF | low & LOW)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_the_widest_factors_are_whole() {
        const SIGN: u128 = i128::MIN.unsigned_abs();
        assert_eq!(product(u128::MAX, u128::MAX), (u128::MAX - 1, 1));
        assert_eq!(product(SIGN, SIGN), (1 << 126, 0));
        assert_eq!(product(SIGN - 1, SIGN - 1), ((1 << 126) - 1, 1));
        assert_eq!(product(1, SIGN - 1), (0, SIGN - 1));
        assert_eq!(product(1 << 100, 1 << 100), (1 << 72, 0));
    }
}
