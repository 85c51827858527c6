//! A stable radix sort of entries with integer keys.

use alloc::vec::Vec;

use bytemuck::Zeroable;

use crate::pages;

/// Most bits of a radix digit. The 2048 counters of such a digit stay in the first-level cache.
const DIGIT_BITS: u32 = 11;
/// Most bits of a digit if there are fewer than [`FEW`] entries, so that summing up the counters costs less.
const SMALL_DIGIT_BITS: u32 = 8;
/// Lists of fewer entries than this are sorted by small digits.
const FEW: usize = 4096;
/// Below this length a comparison sort is faster than all passes of the radix sort.
pub const SMALL: usize = 256;
/// Entries of at least this many bytes do not stay in a second-level cache, and are sorted in parts.
const LARGE: usize = 1 << 20;
/// Approximate bytes of a part. A part and its copy stay in the first-level cache, or nearly.
const PART: usize = 32 << 10;
/// Bits of the key that number the parts. More bits would mean too many places to write to at a time.
const PART_BITS: core::ops::RangeInclusive<u32> = 6..=DIGIT_BITS;

/// A value with an unsigned integer key.
pub trait Keyed: Copy + Zeroable {
    /// The key that the value is sorted by.
    fn key(&self) -> u64;
}

/// A 32-bit key above a 32-bit value, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Zeroable)]
pub struct Narrow(u64);

impl Narrow {
    /// Makes an entry of a key and a value.
    #[inline]
    pub fn new(key: u32, value: u32) -> Self {
        Self(u64::from(key) << 32 | u64::from(value))
    }
}

impl Keyed for Narrow {
    #[inline]
    fn key(&self) -> u64 {
        self.0 >> 32
    }
}

/// A 64-bit key and a 32-bit value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Zeroable)]
pub struct Wide {
    key: u64,
    value: u32,
}

impl Wide {
    /// Makes an entry of a key and a value.
    #[inline]
    pub fn new(key: u64, value: u32) -> Self {
        Self { key, value }
    }
}

impl Keyed for Wide {
    #[inline]
    fn key(&self) -> u64 {
        self.key
    }
}

/// A keyed value that carries an index.
pub trait Entry: Keyed {
    /// The index that the entry carries.
    fn value(&self) -> u32;
}

impl Entry for Narrow {
    #[inline]
    fn value(&self) -> u32 {
        self.0 as u32
    }
}

impl Entry for Wide {
    #[inline]
    fn value(&self) -> u32 {
        self.value
    }
}

/// Sorts entries by their keys; entries of equal keys keep their order.
///
/// O(n) for each digit of up to 11 bits in which the keys differ, with a second list of the same length while it runs.
/// Lists of fewer than [`SMALL`] entries are sorted by comparison.
///
/// ```
/// use incircle_geometry::sort::{sort_by_key, Entry, Narrow};
///
/// let mut entries = vec![Narrow::new(7, 0), Narrow::new(3, 1), Narrow::new(7, 2)];
/// sort_by_key(&mut entries);
/// assert_eq!(entries.iter().map(Entry::value).collect::<Vec<_>>(), [1, 0, 2]);
/// ```
pub fn sort_by_key<E: Keyed>(entries: &mut Vec<E>) {
    if entries.len() < SMALL {
        entries.sort_by_key(E::key);
        return;
    }
    let (any, all) = entries.iter().fold((0, u64::MAX), |(any, all), e| (any | e.key(), all & e.key()));
    let varying = any & !all;
    let mut scratch = pages::zeros(entries.len());
    let bytes = size_of::<E>() * entries.len();
    let part_bits = (bytes / PART).max(1).ilog2().clamp(*PART_BITS.start(), *PART_BITS.end());
    let shift = (u64::BITS - varying.leading_zeros()).saturating_sub(part_bits);
    if bytes >= LARGE && shift > 0 {
        sort_in_parts(entries, &mut scratch, varying, shift);
    } else if sort_by_digits(entries, &mut scratch, varying) {
        core::mem::swap(entries, &mut scratch);
    }
}

/// Sorts entries by the bits from `shift` up, then sorts each part of entries that agree in those bits by itself. So
/// only the first pass goes through all the memory at once.
fn sort_in_parts<E: Keyed>(entries: &mut [E], scratch: &mut [E], varying: u64, shift: u32) {
    sort_by_digit(entries, scratch, shift, u64::BITS - varying.leading_zeros() - shift);
    let mut rest = entries;
    for part in scratch.chunk_by_mut(|one, other| (one.key() ^ other.key()) & varying >> shift << shift == 0) {
        let (sorted, after) = rest.split_at_mut(part.len());
        if part.len() < SMALL {
            part.sort_by_key(E::key);
            sorted.copy_from_slice(part);
        } else if !sort_by_digits(part, sorted, varying & ((1 << shift) - 1)) {
            sorted.copy_from_slice(part);
        }
        rest = after;
    }
}

/// Sorts by all digits in which the keys differ, lowest first. All digits have one width, the least for their number.
/// Returns true if the result is in `scratch`.
fn sort_by_digits<E: Keyed>(entries: &mut [E], scratch: &mut [E], varying: u64) -> bool {
    if varying == 0 {
        return false;
    }
    let most = if entries.len() < FEW { SMALL_DIGIT_BITS } else { DIGIT_BITS };
    let (lowest, end) = (varying.trailing_zeros(), u64::BITS - varying.leading_zeros());
    let bits = (end - lowest).div_ceil((end - lowest).div_ceil(most));
    let (mut from, mut to) = (entries, scratch);
    let mut is_in_scratch = false;
    for shift in (lowest..end).step_by(bits as usize) {
        if varying >> shift & ((1 << bits) - 1) != 0 {
            sort_by_digit(from, to, shift, bits);
            core::mem::swap(&mut from, &mut to);
            is_in_scratch = !is_in_scratch;
        }
    }
    is_in_scratch
}

/// Makes one counting pass over the digit of up to [`DIGIT_BITS`] bits from `shift` up.
fn sort_by_digit<E: Keyed>(from: &[E], to: &mut [E], shift: u32, bits: u32) {
    const MASK: usize = (1 << DIGIT_BITS) - 1;
    let mask = (1 << bits) - 1;
    let digit = |entry: &E| (entry.key() >> shift) as usize & mask & MASK;
    let mut starts = [0u32; 1 << DIGIT_BITS];
    for entry in from {
        starts[digit(entry)] += 1;
    }
    let mut sum = 0;
    for start in &mut starts[..1 << bits] {
        sum += core::mem::replace(start, sum);
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
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn sorts_stably_like_the_standard_library(
            keys in prop::collection::vec(any::<u64>(), 0..6000),
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
        fn many_entries_sort_in_parts(seed in any::<u64>(), low in 0u32..64, high in 0u32..64) {
            let mask = u64::MAX << low & u64::MAX >> high;
            let keys = (0..LARGE as u64 / 16 + 1).map(|k| (k ^ seed).wrapping_mul(0x9e37_79b9_7f4a_7c15) & mask);
            let mut entries: Vec<Wide> = (0..).zip(keys).map(|(index, key)| Wide::new(key, index)).collect();
            let mut expected = entries.clone();
            expected.sort_by_key(|entry| entry.key);
            sort_by_key(&mut entries);
            prop_assert!(entries == expected);
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
