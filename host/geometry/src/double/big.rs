//! Integers of any size, as far as the last stage of the predicates needs them.

use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

/// An integer of any size: a sign and a magnitude in words of 64 bits, the lowest first.
#[derive(Clone, Debug, Default)]
pub(super) struct Big {
    is_negative: bool,
    /// No word of zeros stands at the end, so that zero has no words.
    words: Vec<u64>,
}

impl Big {
    /// The integer `mantissa * 2^shift`.
    pub(super) fn shifted(mantissa: i64, shift: u32) -> Self {
        let (word, bit) = ((shift / u64::BITS) as usize, shift % u64::BITS);
        let wide = u128::from(mantissa.unsigned_abs()) << bit;
        let mut words = vec![0; word + 2];
        words[word] = wide as u64;
        words[word + 1] = (wide >> u64::BITS) as u64;
        Self::new(mantissa < 0, words)
    }

    fn new(is_negative: bool, mut words: Vec<u64>) -> Self {
        while words.last() == Some(&0) {
            words.pop();
        }
        Self { is_negative: is_negative && !words.is_empty(), words }
    }

    /// The integer compared with zero.
    pub(super) fn sign(&self) -> Ordering {
        match (self.is_negative, self.words.is_empty()) {
            (_, true) => Ordering::Equal,
            (true, _) => Ordering::Less,
            (false, _) => Ordering::Greater,
        }
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut words = vec![0; self.words.len() + other.words.len()];
        for (place, &one) in self.words.iter().enumerate() {
            let mut carry = 0;
            for (slot, &two) in words[place..].iter_mut().zip(&other.words) {
                // At most (2^64 - 1)^2 + 2 (2^64 - 1) = 2^128 - 1.
                let sum = u128::from(one) * u128::from(two) + u128::from(*slot) + carry;
                *slot = sum as u64;
                carry = sum >> u64::BITS;
            }
            words[place + other.words.len()] = carry as u64;
        }
        Self::new(self.is_negative != other.is_negative, words)
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        if self.is_negative == other.is_negative {
            return Self::new(self.is_negative, sum(&self.words, &other.words));
        }
        match compare(&self.words, &other.words) {
            Ordering::Less => Self::new(other.is_negative, difference(&other.words, &self.words)),
            _ => Self::new(self.is_negative, difference(&self.words, &other.words)),
        }
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        let negated = Self { is_negative: !other.is_negative, words: other.words.clone() };
        self.plus(&negated)
    }
}

/// Magnitudes without words of zeros at their ends.
fn compare(one: &[u64], other: &[u64]) -> Ordering {
    one.len().cmp(&other.len()).then_with(|| one.iter().rev().cmp(other.iter().rev()))
}

fn sum(one: &[u64], other: &[u64]) -> Vec<u64> {
    let (long, short) = if one.len() < other.len() { (other, one) } else { (one, other) };
    let mut words = Vec::with_capacity(long.len() + 1);
    let mut carry = false;
    for (place, &word) in long.iter().enumerate() {
        let (with_word, first) = word.overflowing_add(short.get(place).copied().unwrap_or(0));
        let (with_carry, second) = with_word.overflowing_add(u64::from(carry));
        words.push(with_carry);
        carry = first | second;
    }
    words.push(u64::from(carry));
    words
}

/// `large - small`, which must not be negative.
fn difference(large: &[u64], small: &[u64]) -> Vec<u64> {
    let mut words = Vec::with_capacity(large.len());
    let mut borrow = false;
    for (place, &word) in large.iter().enumerate() {
        let (without_word, first) = word.overflowing_sub(small.get(place).copied().unwrap_or(0));
        let (without_borrow, second) = without_word.overflowing_sub(u64::from(borrow));
        words.push(without_borrow);
        borrow = first | second;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn big(value: i128) -> Big {
        let low = Big::shifted((value & 0xffff_ffff) as i64, 0);
        let middle = Big::shifted((value >> 32 & 0xffff_ffff) as i64, 32);
        low.plus(&middle).plus(&Big::shifted((value >> 64) as i64, 64))
    }

    fn value(big: &Big) -> i128 {
        let magnitude = big.words.iter().rev().fold(0, |value, &word| value << 64 | i128::from(word));
        if big.is_negative {
            -magnitude
        } else {
            magnitude
        }
    }

    proptest! {
        #[test]
        fn sums_and_products_are_those_of_128_bits(
            one in -1i128 << 100..1 << 100,
            other in -1i128 << 100..1 << 100,
            cut in 0u32..90,
        ) {
            let (one, other) = (one >> cut, other >> (90 - cut));
            prop_assert_eq!(value(&big(one)), one);
            prop_assert_eq!(value(&big(one).plus(&big(other))), one + other);
            prop_assert_eq!(value(&big(one).minus(&big(other))), one - other);
            let (one, other) = (one >> 38, other >> 38);
            prop_assert_eq!(value(&big(one).times(&big(other))), one * other);
            prop_assert_eq!(big(one).minus(&big(other)).sign(), one.cmp(&other));
        }
    }

    #[test]
    fn carries_run_through_all_words() {
        let power = Big::shifted(1, 2000);
        let below = power.minus(&Big::shifted(1, 0));
        assert_eq!(below.words.len(), 32);
        let wide = below.plus(&Big::shifted(1, 0)).minus(&power);
        assert_eq!(wide.sign(), Ordering::Equal);
        // (2^2000 - 1)^2 = 2^4000 - 2^2001 + 1
        let square = Big::shifted(1, 4000).minus(&Big::shifted(1, 2001)).plus(&Big::shifted(1, 0));
        assert_eq!(below.times(&below).minus(&square).sign(), Ordering::Equal);
        assert_eq!(below.minus(&power).sign(), Ordering::Less);
    }
}
