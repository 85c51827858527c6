//! The distinct points along the Z-curve, which is what the engine divides by.
//!
//! The leading bits of a point's position on the curve name its bucket, a cell of the plane. The other bits and the
//! index of the point make one word, and each bucket of words is sorted by itself. Where both do not fit 64 bits the
//! last bits of the position are left out: words that agree in the others are sorted by those once more, for which
//! their points are looked up.

use alloc::vec::Vec;

use bytemuck::Zeroable;

use super::deal::{bucket_ends, runs, stretch, Dealt, CHUNK, MOST_BUCKETS_BITS};
use super::parallel::in_parallel;
use super::view::Site;
use crate::order::z_curve::{point_at, position};
use crate::pages;
use crate::point::Duplicate;
use crate::point::Point;
use crate::sort::{sort_by_key, Keyed, SMALL};

/// Bits of a word that are sorted at a time: three digits of the radix sort of a usual bucket, enough to tell nearly
/// all its points apart.
const KEY_BITS: u32 = 24;
/// Points of a bucket, where there are several, as many to twice as many on average if points are even: 16 to 32 kB,
/// and as much again to sort them, which is near what a first-level cache holds.
const BUCKET: usize = 2048;

/// The distinct points, sorted.
pub(super) struct Sites {
    /// Along the Z-curve, seen from the lower left corner of all.
    pub(super) sites: Vec<Site>,
    /// The input index of each: the lowest of its place.
    pub(super) ids: Vec<u32>,
    /// Points that fell onto an earlier one, in any order.
    pub(super) duplicates: Vec<Duplicate>,
    /// Bits of a coordinate of `sites`.
    pub(super) bits: u32,
}

/// A point of the grid as a word to sort by, and where it comes from.
///
/// From the top: the position on the curve without the bits that the bucket says, as many as there is room for; the
/// index of the point.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Zeroable)]
struct Placed(u64);

impl Keyed for Placed {
    fn key(&self) -> u64 {
        self.0 >> (u64::BITS - KEY_BITS)
    }
}

/// Sorts words by their leading bits, then those that agree in them by the others.
fn sort_words(words: &mut Vec<Placed>) {
    if words.len() < SMALL {
        return words.sort_unstable();
    }
    sort_by_key(words);
    for group in words.chunk_by_mut(|one, other| one.key() == other.key()) {
        if group.len() < SMALL {
            group.sort_unstable();
            continue;
        }
        let leading = group[0].key() << (u64::BITS - KEY_BITS);
        let mut rest: Vec<Placed> = group.iter().map(|word| Placed(word.0 << KEY_BITS)).collect();
        sort_words(&mut rest);
        for (slot, word) in group.iter_mut().zip(rest) {
            *slot = Placed(leading | word.0 >> KEY_BITS);
        }
    }
}

/// The window onto the grid that the points are in, and the curve through it: positions count from its lower left
/// corner.
#[derive(Clone, Copy)]
struct Curve {
    corner: Point,
    /// Bits of a coordinate seen from the corner.
    bits: u32,
    /// Leading bits of a position, which say the bucket.
    bucket_bits: u32,
    /// The other bits of a position. At least one, which is zero where all points are at one place.
    rest_bits: u32,
    /// Bits of an index.
    index_bits: u32,
}

impl Curve {
    /// For points that so many threads deal.
    fn of(points: &[Point], threads: usize) -> Self {
        let none = (Point::new(u32::MAX, u32::MAX), Point::new(0, 0));
        let (corner, far) = points.iter().fold(none, |(low, high), p| {
            (Point::new(low.x.min(p.x), low.y.min(p.y)), Point::new(high.x.max(p.x), high.y.max(p.y)))
        });
        let extent = far.x.saturating_sub(corner.x) | far.y.saturating_sub(corner.y);
        let bits = u32::BITS - extent.leading_zeros();
        let average = BUCKET.max(CHUNK * threads);
        let most = MOST_BUCKETS_BITS.min((2 * bits).saturating_sub(1));
        let bucket_bits = (points.len() / average).max(1).ilog2().min(most);
        let rest_bits = (2 * bits - bucket_bits).max(1);
        let index_bits = usize::BITS - points.len().saturating_sub(1).leading_zeros();
        Self { corner, bits, bucket_bits, rest_bits, index_bits }
    }

    fn buckets(&self) -> usize {
        1 << self.bucket_bits
    }

    /// The position of a point: its coordinates' bits in turn, x first.
    #[inline(always)]
    fn position(&self, point: Point) -> u64 {
        position(point.x - self.corner.x, point.y - self.corner.y)
    }

    /// The point, seen from the corner.
    #[inline(always)]
    fn site(&self, point: Point) -> Site {
        Point::new(point.x - self.corner.x, point.y - self.corner.y).into()
    }

    /// The bits of a position below those of the bucket, at the top of a word.
    #[inline(always)]
    fn rest(&self, position: u64) -> u64 {
        position << (u64::BITS - self.rest_bits)
    }

    /// The bits of a word that are an index.
    #[inline(always)]
    fn indices(&self) -> u64 {
        (1 << self.index_bits) - 1
    }

    /// Positions stand whole in the words.
    fn is_exact(&self) -> bool {
        self.rest_bits + self.index_bits <= u64::BITS
    }

    /// The word of a point that has this position.
    #[inline(always)]
    fn placed(&self, position: u64, index: u64) -> Placed {
        Placed(self.rest(position) & !self.indices() | index)
    }

    /// The word for a second sort, where words are not exact: with the bits of the position that those leave out. They fit: `rest_bits` is
    /// at most 62, an index has 29.
    fn placed_finely(&self, position: u64, index: u64) -> Placed {
        let missing = self.rest_bits + self.index_bits - u64::BITS;
        Placed(position << (u64::BITS - missing) | index)
    }

    /// Deals points, the first of which has this index, to the cells that their leading bits name.
    fn deal(&self, points: &[Point], first: usize) -> Dealt<Placed> {
        let mut dealt = Dealt::new(self.buckets(), points.len());
        for (&point, index) in points.iter().zip(first as u64..) {
            let position = self.position(point);
            dealt.put((position >> self.rest_bits) as usize, self.placed(position, index));
        }
        dealt
    }
}

/// Sorts the points along the curve and takes duplicates out, on so many threads. O(n), by radix: points are dealt to
/// cells of [`BUCKET`] points or some more, if they are even, and each cell is sorted by itself. A thread has whole
/// cells, so threads help less where most points are in few of them.
pub(super) fn sort(points: &[Point], threads: usize) -> Sites {
    let curve = Curve::of(points, threads);
    let mut all = Sites {
        sites: pages::zeros(points.len()),
        ids: pages::zeros(points.len()),
        duplicates: Vec::new(),
        bits: curve.bits,
    };
    let share = points.len().div_ceil(threads).max(1);
    let dealt = in_parallel(points.chunks(share).enumerate(), |(place, own)| curve.deal(own, share * place));
    let ends = bucket_ends(&dealt, curve.buckets());
    let (mut sites, mut ids) = (all.sites.as_mut_slice(), all.ids.as_mut_slice());
    let tasks = runs(&ends, threads).into_iter().map(|run| {
        let room = ..stretch(&run, &ends).len();
        let sites = sites.split_off_mut(room).unwrap_or_default();
        let ids = ids.split_off_mut(room).unwrap_or_default();
        (run, Kept { sites, ids, count: 0, duplicates: Vec::new() })
    });
    let kept = in_parallel(tasks, |(run, mut kept)| {
        let room = kept.sites.len();
        let mut words = Vec::new();
        for bucket in run {
            words.clear();
            dealt.iter().flat_map(|own| own.chunks(bucket)).for_each(|chunk| words.extend_from_slice(chunk));
            sort_words(&mut words);
            if curve.is_exact() {
                kept.take_exact(&words, bucket as u64, curve);
            } else {
                kept.take_rounded(&mut words, points, curve);
            }
        }
        (room, kept.count, kept.duplicates)
    });
    all.close_up(kept);
    all
}

/// The distinct points of a run of buckets, with room for all points of the run.
struct Kept<'a> {
    sites: &'a mut [Site],
    ids: &'a mut [u32],
    count: usize,
    duplicates: Vec<Duplicate>,
}

impl Kept<'_> {
    /// Takes the words of a bucket, sorted, which have the whole position.
    fn take_exact(&mut self, words: &[Placed], bucket: u64, curve: Curve) {
        let mut before = None;
        for &Placed(word) in words {
            let index = (word & curve.indices()) as u32;
            let rest = word & !curve.indices();
            if before == Some(rest) {
                self.drop_onto_last(index);
                continue;
            }
            before = Some(rest);
            let position = bucket << curve.rest_bits | rest >> (u64::BITS - curve.rest_bits);
            self.keep(point_at(position).into(), index);
        }
    }

    /// Takes the words of a bucket, sorted, which have the leading bits of the position.
    fn take_rounded(&mut self, words: &mut [Placed], points: &[Point], curve: Curve) {
        for group in words.chunk_by_mut(|one, other| (one.0 ^ other.0) & !curve.indices() == 0) {
            if group.len() > 1 {
                for word in &mut *group {
                    let index = word.0 & curve.indices();
                    *word = curve.placed_finely(curve.position(points[index as usize]), index);
                }
                let mut sorted = group.to_vec();
                sort_words(&mut sorted);
                group.copy_from_slice(&sorted);
            }
            let mut before = None;
            for word in &*group {
                let index = (word.0 & curve.indices()) as u32;
                let point = points[index as usize];
                if before == Some(point) {
                    self.drop_onto_last(index);
                    continue;
                }
                before = Some(point);
                self.keep(curve.site(point), index);
            }
        }
    }

    #[inline(always)]
    fn keep(&mut self, site: Site, id: u32) {
        (self.sites[self.count], self.ids[self.count]) = (site, id);
        self.count += 1;
    }

    fn drop_onto_last(&mut self, index: u32) {
        // There is a last one: the point fell onto it.
        self.duplicates.extend(self.ids[..self.count].last().map(|&of| Duplicate { index, of }));
    }
}

impl Sites {
    /// Takes runs together: of each its room, how much of that is used, and its duplicates.
    fn close_up(&mut self, runs: Vec<(usize, usize, Vec<Duplicate>)>) {
        let (mut from, mut to) = (0, 0);
        for (room, count, duplicates) in runs {
            if from > to {
                self.sites.copy_within(from..from + count, to);
                self.ids.copy_within(from..from + count, to);
            }
            (from, to) = (from + room, to + count);
            self.duplicates.extend(duplicates);
        }
        self.sites.truncate(to);
        self.ids.truncate(to);
    }
}
