//! Stable radix sort of keyed entries.

use crate::pages;

/// Bits of a radix digit: 2048 counters stay in the first-level cache.
const DIGIT_BITS: u32 = 11;
/// Below this length a comparison sort is faster than clearing the counters.
const SMALL: usize = 1024;

/// Something with an unsigned integer key.
pub(crate) trait Keyed: Copy + Default {
    /// The key to sort by.
    fn key(&self) -> u64;
}

/// A 32-bit key above a 32-bit value, in one word.
#[derive(Clone, Copy, Default, Debug, PartialEq, Eq)]
pub(crate) struct Narrow(u64);

impl Narrow {
    pub(crate) fn new(key: u32, value: u32) -> Self {
        Self(u64::from(key) << 32 | u64::from(value))
    }
}

impl Keyed for Narrow {
    fn key(&self) -> u64 {
        self.0 >> 32
    }
}

/// A 64-bit key and a 32-bit value.
#[derive(Clone, Copy, Default, Debug, PartialEq, Eq)]
pub(crate) struct Wide {
    key: u64,
    value: u32,
}

impl Wide {
    pub(crate) fn new(key: u64, value: u32) -> Self {
        Self { key, value }
    }
}

impl Keyed for Wide {
    fn key(&self) -> u64 {
        self.key
    }
}

/// An entry that carries an index.
pub(crate) trait Entry: Keyed {
    /// The index carried.
    fn value(&self) -> u32;
}

impl Entry for Narrow {
    fn value(&self) -> u32 {
        self.0 as u32
    }
}

impl Entry for Wide {
    fn value(&self) -> u32 {
        self.value
    }
}

/// Sorts by key; entries of equal key keep their order. O(n) per digit in which the keys differ.
pub(crate) fn sort_by_key<E: Keyed>(entries: &mut Vec<E>) {
    if entries.len() < SMALL {
        entries.sort_by_key(E::key);
        return;
    }
    let (any, all) = entries.iter().fold((0, u64::MAX), |(any, all), e| (any | e.key(), all & e.key()));
    let varying = any & !all;
    let mut scratch = pages::filled(E::default(), entries.len());
    let mut shift = 0;
    while shift < u64::BITS {
        if varying >> shift & ((1 << DIGIT_BITS) - 1) != 0 {
            sort_by_digit(entries, &mut scratch, shift);
            std::mem::swap(entries, &mut scratch);
        }
        shift += DIGIT_BITS;
    }
}

/// One counting pass over the digit at `shift`.
fn sort_by_digit<E: Keyed>(from: &[E], to: &mut [E], shift: u32) {
    let digit = |entry: &E| (entry.key() >> shift) as usize & ((1 << DIGIT_BITS) - 1);
    let mut starts = [0u32; 1 << DIGIT_BITS];
    for entry in from {
        starts[digit(entry)] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    for entry in from {
        let slot = &mut starts[digit(entry)];
        to[*slot as usize] = *entry;
        *slot += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sorts_stably_like_the_standard_library(
            keys in prop::collection::vec(any::<u64>(), 0..3000),
            mask in any::<u64>(),
        ) {
            let entries: Vec<Wide> =
                keys.iter().enumerate().map(|(i, &k)| Wide::new(k & mask & 0xff00_0000_0fff_00ff, i as u32)).collect();
            let mut expected = entries.clone();
            expected.sort_by_key(|e| e.key);
            let mut sorted = entries;
            sort_by_key(&mut sorted);
            prop_assert_eq!(sorted, expected);
        }

        #[test]
        fn narrow_entries_sort_by_their_upper_half(keys in prop::collection::vec(any::<u32>(), 2000)) {
            let mut entries: Vec<Narrow> = keys.iter().enumerate().map(|(i, &k)| Narrow::new(k, i as u32)).collect();
            sort_by_key(&mut entries);
            for pair in entries.windows(2) {
                prop_assert!(pair[0].0 < pair[1].0);
            }
        }
    }
}
