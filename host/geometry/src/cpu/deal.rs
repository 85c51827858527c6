//! Items dealt to buckets in one pass, before it is known how many each will get.
//!
//! A bucket is a chain of chunks. Those of all buckets are pieces of one list, taken from it in the order of need, so
//! that dealing writes to one place per bucket, and all these places stay in the second-level cache. The last chunk of
//! each bucket is half empty on average, of each thread: so there should be a chunk of items at least for each thread
//! and bucket.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use bytemuck::Zeroable;

use crate::pages;

/// Items of a chunk: 2 kB of words, so that a chunk is read in one go and rarely taken.
pub(super) const CHUNK: usize = 256;
/// Most buckets, as a power of two: the 2048 lines of 64 bytes that are written to are an eighth of a second-level
/// cache of 1 MB.
pub(super) const MOST_BUCKETS_BITS: u32 = 11;

/// The items that one thread has dealt.
pub(super) struct Dealt<T> {
    /// All chunks.
    list: Vec<T>,
    /// For each chunk, the end of the previous chunk of its bucket in `list`; 0 for the first.
    before: Vec<u32>,
    /// For each bucket, the end of its last item in `list`; 0 if it has none.
    ends: Vec<u32>,
}

impl<T: Copy + Zeroable> Dealt<T> {
    /// No items yet in so many buckets; there should be about so many items. Room behind the last chunk costs nothing.
    pub(super) fn new(buckets: usize, items: usize) -> Self {
        let chunks = (items + items / 8) / CHUNK + buckets;
        Self { list: pages::zeros(CHUNK * chunks), before: Vec::with_capacity(chunks), ends: vec![0; buckets] }
    }

    /// Puts an item into a bucket. O(1).
    #[inline(always)]
    pub(super) fn put(&mut self, bucket: usize, item: T) {
        let mut place = self.ends[bucket] as usize;
        if place.is_multiple_of(CHUNK) {
            place = self.take_chunk(place);
        }
        self.list[place] = item;
        self.ends[bucket] = place as u32 + 1;
    }

    /// The place of a new chunk, after the one that ends at `end`.
    #[inline(never)]
    fn take_chunk(&mut self, end: usize) -> usize {
        let place = CHUNK * self.before.len();
        if self.list.len() == place {
            self.list.resize(2 * place + CHUNK, T::zeroed());
        }
        self.before.push(end as u32);
        place
    }

    /// The items of a bucket: the last chunk comes first.
    pub(super) fn chunks(&self, bucket: usize) -> impl Iterator<Item = &[T]> {
        let mut end = self.ends[bucket] as usize;
        core::iter::from_fn(move || {
            let start = end.checked_sub(1)? / CHUNK * CHUNK;
            let chunk = &self.list[start..end];
            end = self.before[start / CHUNK] as usize;
            Some(chunk)
        })
    }
}

/// The end of each bucket in the list of all items, bucket by bucket.
pub(super) fn bucket_ends<T: Copy + Zeroable>(dealt: &[Dealt<T>], buckets: usize) -> Vec<usize> {
    let size = |bucket| dealt.iter().flat_map(|own| own.chunks(bucket)).map(<[T]>::len).sum::<usize>();
    (0..buckets)
        .scan(0, |end, bucket| {
            *end += size(bucket);
            Some(*end)
        })
        .collect()
}

/// All buckets in `count` runs with about as many items each, as far as whole buckets allow.
pub(super) fn runs(ends: &[usize], count: usize) -> Vec<Range<usize>> {
    let all = ends.last().map_or(0, |&end| end);
    let mut first = 0;
    (1..=count)
        .map(|k| {
            let last = if k == count { ends.len() } else { ends.partition_point(|&end| end <= k * all / count) };
            core::mem::replace(&mut first, last)..last
        })
        .collect()
}

/// The place of a run of buckets in the list of all items.
pub(super) fn stretch(run: &Range<usize>, ends: &[usize]) -> Range<usize> {
    let end_before = |bucket: usize| bucket.checked_sub(1).map_or(0, |before| ends[before]);
    end_before(run.start)..end_before(run.end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn nothing_is_lost(buckets in prop::collection::vec(0usize..5, 0..5000), expected in 0usize..5000, threads in 1usize..4) {
            let items: Vec<(usize, u32)> = buckets.into_iter().zip(0..).collect();
            let dealt: Vec<Dealt<u32>> = items
                .chunks(items.len() / threads + 1)
                .map(|own| {
                    let mut dealt = Dealt::new(5, expected);
                    own.iter().for_each(|&(bucket, item)| dealt.put(bucket, item));
                    dealt
                })
                .collect();
            let ends = bucket_ends(&dealt, 5);
            for bucket in 0..5 {
                let mut own: Vec<u32> = dealt.iter().flat_map(|own| own.chunks(bucket)).flatten().copied().collect();
                own.sort_unstable();
                let expected: Vec<u32> = items.iter().filter(|item| item.0 == bucket).map(|item| item.1).collect();
                prop_assert_eq!(stretch(&(bucket..bucket + 1), &ends).len(), own.len());
                prop_assert_eq!(own, expected);
            }
            let runs = runs(&ends, threads);
            let largest = (0..5).map(|bucket| stretch(&(bucket..bucket + 1), &ends).len()).max().unwrap_or(0);
            let lengths: Vec<usize> = runs.iter().map(|run| stretch(run, &ends).len()).collect();
            prop_assert!(lengths.iter().all(|&own| own <= items.len() / threads + 1 + largest), "{:?}", lengths);
            prop_assert_eq!(runs.iter().cloned().flatten().collect::<Vec<_>>(), (0..5).collect::<Vec<_>>());
            prop_assert_eq!(runs.iter().map(|run| stretch(run, &ends).len()).sum::<usize>(), items.len());
        }
    }
}
