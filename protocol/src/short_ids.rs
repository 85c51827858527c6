//! Short ids: the answer to a `Triangles` in which an id takes 10 or 12 bits instead of 16.
//!
//! A device has them if its [`Identity`](crate::Identity) has the feature [`FEATURE_SHORT_IDS`]. The host chooses the
//! form in the command word. Ids keep their low bits, so the infinite vertex is all ones, or all ones of its own width
//! where that is smaller. A record takes a word, and of 12 bits four more, its *rest*; the rests of eight records share
//! a word behind them.

/// The bit of [`Identity::features`](crate::Identity::features) of a device that sends short ids.
pub const FEATURE_SHORT_IDS: u32 = 2;

/// The bit in the word of a `Triangles` that asks for short ids.
pub const TRIANGLES_SHORT: u32 = 8;
/// The bit beside [`TRIANGLES_SHORT`] that asks for 12 bits rather than 10.
pub const TRIANGLES_TWELVE: u32 = 4;

/// Records whose rests share a word.
const GROUP: usize = 8;
/// Bits of each id that are in the word of its record.
const LOW_BITS: u32 = 10;
/// Bits of a rest.
const REST_BITS: usize = 4;

/// How many bits an id takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShortIds {
    /// 10 bits: for ids below 1,023.
    Ten,
    /// 12 bits: for ids below 4,095.
    Twelve,
}

impl ShortIds {
    /// Number of records whose payload ends with a whole word. Ranges of so many records, or of a multiple, may be
    /// asked for one by one, and their payloads put together.
    pub const WHOLE: u32 = GROUP as u32;
    /// Most points of a mesh whose ids can be short.
    pub const MOST_IDS: u32 = 0xfff;

    /// The shortest form for a mesh of points with ids below `ids`; `None` if only 16 bits are enough. One value more
    /// is needed for the infinite vertex.
    pub const fn below(ids: u32) -> Option<Self> {
        match ids {
            0..=0x3ff => Some(Self::Ten),
            0x400..=0xfff => Some(Self::Twelve),
            _ => None,
        }
    }

    /// The form that the word of a `Triangles` asks for; `None` for ids of 16 bits.
    pub const fn of_word(word: u32) -> Option<Self> {
        match (word & TRIANGLES_SHORT != 0, word & TRIANGLES_TWELVE != 0) {
            (false, _) => None,
            (true, false) => Some(Self::Ten),
            (true, true) => Some(Self::Twelve),
        }
    }

    /// The bits in the word of a `Triangles` that ask for this form: the number of bits of an id.
    pub const fn word_bits(self) -> u32 {
        match self {
            Self::Ten => 10,
            Self::Twelve => 12,
        }
    }

    /// The value that the infinite vertex has in this form on a device where it is `infinite`.
    pub const fn infinite(self, infinite: u32) -> u32 {
        infinite & ((1 << self.word_bits()) - 1)
    }

    /// Number of payload words for so many records.
    pub const fn words(self, records: u32) -> u64 {
        match self {
            Self::Ten => records as u64,
            Self::Twelve => records as u64 + (records as u64).div_ceil(GROUP as u64),
        }
    }

    /// The vertices of a record in a payload of `records` records.
    #[inline]
    pub fn vertices_from_words(self, words: &[u32], records: usize, record: usize) -> [u32; 3] {
        let (own, rest) = self.places(records, record);
        let low = words[own];
        let mask = (1 << LOW_BITS) - 1;
        let [v0, v1, v2] = [low & mask, low >> LOW_BITS & mask, low >> (2 * LOW_BITS) & mask];
        match rest {
            None => [v0, v1, v2],
            Some((place, shift)) => {
                let rest = words[place] >> shift;
                [v0 | low >> 30 << LOW_BITS, v1 | (rest & 3) << LOW_BITS, v2 | (rest >> 2 & 3) << LOW_BITS]
            }
        }
    }

    /// Puts the vertices of a record into a payload of `records` records. The words must have been zero there.
    #[inline]
    pub fn vertices_to_words(self, [v0, v1, v2]: [u32; 3], words: &mut [u32], records: usize, record: usize) {
        let mask = (1 << LOW_BITS) - 1;
        let (own, rest) = self.places(records, record);
        words[own] = v0 & mask | (v1 & mask) << LOW_BITS | (v2 & mask) << (2 * LOW_BITS) | v0 >> LOW_BITS << 30;
        if let Some((place, shift)) = rest {
            words[place] |= (v1 >> LOW_BITS & 3 | (v2 >> LOW_BITS & 3) << 2) << shift;
        }
    }

    /// The bits of the last word of a payload that hold nothing and are 0.
    pub const fn spare_bits(self, records: usize) -> u32 {
        match self {
            Self::Ten => 0,
            // Rests fill their word from the top.
            Self::Twelve => (1 << (REST_BITS * ((GROUP - records % GROUP) % GROUP))) - 1,
        }
    }

    /// The word of a record, and the word and the lowest bit of its rest.
    fn places(self, records: usize, record: usize) -> (usize, Option<(usize, usize)>) {
        match self {
            Self::Ten => (record, None),
            Self::Twelve => {
                let (group, place) = (record / GROUP, record % GROUP);
                let count = GROUP.min(records - group * GROUP);
                let first = group * (GROUP + 1);
                // The rest of the last record of a group is at the top.
                (first + place, Some((first + count, REST_BITS * (GROUP - count + place))))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;
    use std::vec;
    use std::vec::Vec;

    #[test]
    fn what_is_put_in_comes_out() {
        for form in [ShortIds::Ten, ShortIds::Twelve] {
            let all = (1 << form.word_bits()) - 1;
            assert_eq!(ShortIds::of_word(7 << 24 | form.word_bits()), Some(form));
            for records in 0..40usize {
                let id =
                    |k: usize| if k.is_multiple_of(5) { all } else { (k as u32).wrapping_mul(0x9e37_79b9) >> 7 & all };
                let mut words = vec![0; form.words(records as u32) as usize];
                let vertices: Vec<[u32; 3]> = (0..records).map(|r| [id(3 * r), id(3 * r + 1), id(3 * r + 2)]).collect();
                for (record, v) in vertices.iter().enumerate() {
                    form.vertices_to_words(*v, &mut words, records, record);
                }
                for (record, v) in vertices.iter().enumerate() {
                    assert_eq!(form.vertices_from_words(&words, records, record), *v, "{form:?} {record} of {records}");
                }
                let spare = form.spare_bits(records);
                assert!(words.last().is_none_or(|last| last & spare == 0), "{form:?}, {records} records");
                // Eight records end with a word, so what follows is as in a payload of its own.
                if let Some(rest) = records.checked_sub(ShortIds::WHOLE as usize) {
                    let mut behind = vec![0; form.words(rest as u32) as usize];
                    for (record, v) in vertices[ShortIds::WHOLE as usize..].iter().enumerate() {
                        form.vertices_to_words(*v, &mut behind, rest, record);
                    }
                    assert_eq!(words[form.words(ShortIds::WHOLE) as usize..], behind);
                }
            }
        }
        assert_eq!(
            [1023, 1024, 4095, 4096].map(ShortIds::below),
            [Some(ShortIds::Ten), Some(ShortIds::Twelve), Some(ShortIds::Twelve), None]
        );
        assert_eq!(ShortIds::of_word(7 << 24), None);
        assert_eq!(ShortIds::Twelve.infinite(0x7ff), 0x7ff);
        assert_eq!(ShortIds::Twelve.infinite(0x1fff), 0xfff);
    }
}
