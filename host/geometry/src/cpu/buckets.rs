//! Items distributed to buckets in one pass, before the sizes of the buckets are known.
//!
//! A bucket is a chain of chunks. The chunks of all buckets are pieces of one list, taken in the order of need. So the
//! pass writes to one place per bucket, and all these places stay in the second-level cache. The last chunk of each
//! bucket of each thread is half empty on average, so there should be at least a chunk of items for
//! each thread and bucket.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use bytemuck::Zeroable;

use crate::pages;

/// Items of a chunk. With 2 kB of words a chunk is read in one go, and a new one is rarely needed.
pub(super) const CHUNK: usize = 256;
/// Most buckets, as a power of two. The pass writes to 2048 cache lines of 64 bytes, which are an eighth of a
/// second-level cache of 1 MB.
pub(super) const MOST_BUCKETS_BITS: u32 = 11;

/// The items that one thread has distributed.
pub(super) struct Bucketed<T> {
    /// The chunks of all buckets.
    list: Vec<T>,
    /// For each chunk, the end of the previous chunk of its bucket in `list`; 0 for the first.
    before: Vec<u32>,
    /// For each bucket, the end of its last item in `list`; 0 if it has none.
    ends: Vec<u32>,
}

impl<T: Copy + Zeroable> Bucketed<T> {
    /// Makes empty buckets for about `items` items in all. Unused room behind the last chunk costs nothing.
    pub(super) fn new(buckets: usize, items: usize) -> Self {
        let chunks = (items + items / 8) / CHUNK + buckets;
        Self { list: pages::zeros(CHUNK * chunks), before: Vec::with_capacity(chunks), ends: vec![0; buckets] }
    }

    /// Puts an item into a bucket, in constant time.
    #[inline(always)]
    pub(super) fn put(&mut self, bucket: usize, item: T) {
        let mut place = self.ends[bucket] as usize;
        if place.is_multiple_of(CHUNK) {
            place = self.take_chunk(place);
        }
        self.list[place] = item;
        self.ends[bucket] = place as u32 + 1;
    }

    /// Takes a new chunk for the bucket whose last chunk ends at `end`; returns the place of the chunk.
    #[inline(never)]
    fn take_chunk(&mut self, end: usize) -> usize {
        let place = CHUNK * self.before.len();
        if self.list.len() == place {
            self.list.resize(2 * place + CHUNK, T::zeroed());
        }
        self.before.push(end as u32);
        place
    }

    /// The items of a bucket, chunk by chunk, the last chunk first.
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

/// The end of each bucket in a list that holds all items, bucket by bucket.
pub(super) fn bucket_ends<T: Copy + Zeroable>(bucketed: &[Bucketed<T>], buckets: usize) -> Vec<usize> {
    let size = |bucket| bucketed.iter().flat_map(|own| own.chunks(bucket)).map(<[T]>::len).sum::<usize>();
    (0..buckets)
        .scan(0, |end, bucket| {
            *end += size(bucket);
            Some(*end)
        })
        .collect()
}

/// Divides all buckets into `count` runs with about the same number of items each, as far as whole buckets allow.
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

/// The places of a run of buckets in the list of all items.
pub(super) fn items_of(run: &Range<usize>, ends: &[usize]) -> Range<usize> {
    let end_before = |bucket: usize| bucket.checked_sub(1).map_or(0, |before| ends[before]);
    end_before(run.start)..end_before(run.end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn nothing_is_lost(
            buckets in prop::collection::vec(0usize..5, 0..5000),
            expected in 0usize..5000,
            threads in 1usize..4,
        ) {
            let items: Vec<(usize, u32)> = buckets.into_iter().zip(0..).collect();
            let bucketed: Vec<Bucketed<u32>> = items
                .chunks(items.len() / threads + 1)
                .map(|own| {
                    let mut bucketed = Bucketed::new(5, expected);
                    own.iter().for_each(|&(bucket, item)| bucketed.put(bucket, item));
                    bucketed
                })
                .collect();
            let ends = bucket_ends(&bucketed, 5);
            for bucket in 0..5 {
                let mut own: Vec<u32> = bucketed.iter().flat_map(|own| own.chunks(bucket)).flatten().copied().collect();
                own.sort_unstable();
                let expected: Vec<u32> = items.iter().filter(|item| item.0 == bucket).map(|item| item.1).collect();
                prop_assert_eq!(items_of(&(bucket..bucket + 1), &ends).len(), own.len());
                prop_assert_eq!(own, expected);
            }
            let runs = runs(&ends, threads);
            let largest = (0..5).map(|bucket| items_of(&(bucket..bucket + 1), &ends).len()).max().unwrap_or(0);
            let lengths: Vec<usize> = runs.iter().map(|run| items_of(run, &ends).len()).collect();
            prop_assert!(lengths.iter().all(|&own| own <= items.len() / threads + 1 + largest), "{:?}", lengths);
            prop_assert_eq!(runs.iter().cloned().flatten().collect::<Vec<_>>(), (0..5).collect::<Vec<_>>());
            prop_assert_eq!(runs.iter().map(|run| items_of(run, &ends).len()).sum::<usize>(), items.len());
        }
    }
}
