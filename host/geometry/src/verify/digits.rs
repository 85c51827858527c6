//! Numbers of any size for the validator: sums of digits times powers of 2^32.

use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

/// The base of the digits.
const BASE: i128 = 1 << 32;

/// A number `sum(digits[k] * 2^(32 (low + k)))`. All digits are in `0..2^32`, but for the last, which has the sign of
/// the number and is not zero.
#[derive(Clone, Debug, Default)]
pub(super) struct Digits {
    low: i32,
    digits: Vec<i128>,
}

impl Digits {
    /// The number `mantissa * 2^exponent`.
    pub(super) fn new(mantissa: i64, exponent: i32) -> Self {
        let shift = exponent.rem_euclid(32);
        Self::carried(exponent.div_euclid(32), vec![i128::from(mantissa) << shift])
    }

    /// Brings digits of any size into range, from the lowest on.
    fn carried(low: i32, mut digits: Vec<i128>) -> Self {
        let mut carry = 0;
        for digit in &mut digits {
            let sum = *digit + carry;
            (*digit, carry) = (sum.rem_euclid(BASE), sum.div_euclid(BASE));
        }
        while !(-1..=0).contains(&carry) {
            digits.push(carry.rem_euclid(BASE));
            carry = carry.div_euclid(BASE);
        }
        // What is left is 0 or -1, and the sign.
        digits.push(carry);
        while digits.last() == Some(&0) {
            digits.pop();
        }
        Self { low, digits }
    }

    /// The number compared with zero: all digits but the last are positive, and together smaller than one of its units.
    pub(super) fn sign(&self) -> Ordering {
        self.digits.last().map_or(Ordering::Equal, |last| last.cmp(&0))
    }

    /// `self + factor * other`, for a factor of 1 or -1.
    fn combined(&self, factor: i128, other: &Self) -> Self {
        let low = self.low.min(other.low);
        let end = |number: &Self| number.low + number.digits.len() as i32;
        let mut digits = vec![0; (end(self).max(end(other)) - low) as usize];
        for (number, factor) in [(self, 1), (other, factor)] {
            let own = &mut digits[(number.low - low) as usize..];
            own.iter_mut().zip(&number.digits).for_each(|(sum, digit)| *sum += factor * digit);
        }
        Self::carried(low, digits)
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        self.combined(1, other)
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.combined(-1, other)
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut digits = vec![0; self.digits.len() + other.digits.len()];
        for (place, one) in self.digits.iter().enumerate() {
            // At most some hundred products below 2^64 each come together.
            digits[place..].iter_mut().zip(&other.digits).for_each(|(sum, two)| *sum += one * two);
        }
        Self::carried(self.low + other.low, digits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn number(value: i128) -> Digits {
        Digits::new((value >> 62) as i64, 62).plus(&Digits::new((value & ((1 << 62) - 1)) as i64, 0))
    }

    proptest! {
        #[test]
        fn arithmetic_is_that_of_128_bits(
            one in -1i128 << 120..1 << 120,
            other in -1i128 << 120..1 << 120,
            cut in 0u32..120,
        ) {
            let (one, other) = (one >> cut, other >> (120 - cut));
            prop_assert_eq!(number(one).sign(), one.cmp(&0));
            prop_assert_eq!(number(one).minus(&number(other)).sign(), one.cmp(&other));
            prop_assert_eq!(number(one).plus(&number(other)).minus(&number(one + other)).sign(), Ordering::Equal);
            let (one, other) = (one >> 58, other >> 58);
            prop_assert_eq!(number(one).times(&number(other)).minus(&number(one * other)).sign(), Ordering::Equal);
        }
    }

    #[test]
    fn exponents_meet_from_afar() {
        let (large, small) = (Digits::new(3, 2000), Digits::new(-1, -2000));
        assert_eq!(large.plus(&small).minus(&large).minus(&small).sign(), Ordering::Equal);
        assert_eq!(large.times(&small).plus(&Digits::new(3, 0)).sign(), Ordering::Equal);
        assert_eq!(small.plus(&large).sign(), Ordering::Greater);
    }
}
