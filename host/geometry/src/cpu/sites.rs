//! The distinct points along the Z-curve, by which the CPU triangulator divides the plane.
//!
//! The leading bits of a point's position on the curve name its bucket, which is a cell of the plane. The other bits
//! and the index of the point make one word, and each bucket of words is sorted by itself. If both do not fit 64 bits,
//! the word leaves out the last bits of the position. Words that agree in the bits they have are then sorted once more,
//! by the missing bits, for which their points are looked up.

use alloc::vec::Vec;

use bytemuck::Zeroable;

use super::buckets::{bucket_ends, items_of, runs, Bucketed, CHUNK, MOST_BUCKETS_BITS};
use super::parallel::in_parallel;
use super::view::Site;
use crate::order::z_curve::{point_at, position};
use crate::pages;
use crate::point::Duplicate;
use crate::point::Point;
use crate::sort::{sort_by_key, Keyed, SMALL};

/// Bits of a word that are sorted at a time: three digits of the radix sort of a usual bucket, enough to distinguish
/// nearly all its points.
const KEY_BITS: u32 = 24;
/// Points of a bucket on average, if there are several buckets and the points are spread evenly: this number to twice
/// as many, unless many threads or very many points ask for larger buckets. Such a bucket takes 16 to 32 kB, and as
/// much again to be sorted, which is near what a first-level cache holds.
const BUCKET: usize = 2048;

/// The distinct points of a set, sorted along the Z-curve.
pub(super) struct Sites {
    /// The coordinates, counted from the lower left corner of the bounding box.
    pub(super) sites: Vec<Site>,
    /// The input index of each site: the lowest of all points at its place.
    pub(super) ids: Vec<u32>,
    /// Points with the coordinates of an earlier one, in any order.
    pub(super) duplicates: Vec<Duplicate>,
    /// The number of bits of a coordinate of `sites`.
    pub(super) bits: u32,
}

/// A point as a word to sort by.
///
/// From the top, the word has the position on the curve without the bits that name the bucket, as far as there is room,
/// then the index of the point.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Zeroable)]
struct Placed(u64);

impl Keyed for Placed {
    fn key(&self) -> u64 {
        self.0 >> (u64::BITS - KEY_BITS)
    }
}

/// Sorts words by their leading bits, then sorts those that agree in the leading bits by the other bits.
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

/// The bounding box of the points and the curve through it, with positions counted from its lower left corner.
#[derive(Clone, Copy)]
struct Curve {
    corner: Point,
    /// The number of bits of a coordinate counted from the corner.
    bits: u32,
    /// The number of leading bits of a position, which name the bucket.
    bucket_bits: u32,
    /// The number of the other bits of a position: at least one, which is zero if all points are at one place.
    rest_bits: u32,
    /// The number of bits of an index.
    index_bits: u32,
}

/// The most bits that name a bucket, for this number of points and of threads.
fn bucket_bits(points: usize, threads: usize) -> u32 {
    let average = BUCKET.max(CHUNK * threads);
    (points / average).max(1).ilog2().min(MOST_BUCKETS_BITS)
}

/// The number of bits of an index into a list of this many points.
fn index_bits(points: usize) -> u32 {
    usize::BITS - points.saturating_sub(1).leading_zeros()
}

/// The most bits that coordinates may have so that words hold whole positions, for this number of points and of
/// threads.
pub(super) fn exact_bits(points: usize, threads: usize) -> u32 {
    (u64::BITS + bucket_bits(points, threads) - index_bits(points)) / 2
}

impl Curve {
    /// The curve for these points, with buckets for `threads` threads.
    fn of(points: &[Point], threads: usize) -> Self {
        let none = (Point::new(u32::MAX, u32::MAX), Point::new(0, 0));
        let (corner, far) = points.iter().fold(none, |(low, high), p| {
            (Point::new(low.x.min(p.x), low.y.min(p.y)), Point::new(high.x.max(p.x), high.y.max(p.y)))
        });
        let extent = far.x.saturating_sub(corner.x) | far.y.saturating_sub(corner.y);
        let bits = u32::BITS - extent.leading_zeros();
        let bucket_bits = bucket_bits(points.len(), threads).min((2 * bits).saturating_sub(1));
        let rest_bits = (2 * bits - bucket_bits).max(1);
        let index_bits = index_bits(points.len());
        Self { corner, bits, bucket_bits, rest_bits, index_bits }
    }

    fn buckets(&self) -> usize {
        1 << self.bucket_bits
    }

    /// The position of a point on the curve: the bits of its coordinates in turn, x first.
    #[inline(always)]
    fn position(&self, point: Point) -> u64 {
        position(point.x - self.corner.x, point.y - self.corner.y)
    }

    /// The point with its coordinates counted from the corner.
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

    /// The bucket that the leading bits of a position name. Where there is one bucket, positions may
    /// have 64 other bits.
    #[inline(always)]
    fn bucket(&self, position: u64) -> usize {
        position.checked_shr(self.rest_bits).unwrap_or(0) as usize
    }

    /// Whether the words have whole positions.
    fn is_exact(&self) -> bool {
        self.rest_bits + self.index_bits <= u64::BITS
    }

    /// The word of the point at this position.
    #[inline(always)]
    fn placed(&self, position: u64, index: u64) -> Placed {
        Placed(self.rest(position) & !self.indices() | index)
    }

    /// The word for the second sort, if words are not exact: the bits of the position that the first word left out, and
    /// the index. Both fit one word, because `rest_bits` is at most 64 and an index has at most 29 bits.
    fn placed_finely(&self, position: u64, index: u64) -> Placed {
        let missing = self.rest_bits + self.index_bits - u64::BITS;
        Placed(position << (u64::BITS - missing) | index)
    }

    /// Distributes points to the buckets that their leading bits name. The first point has the index `first`.
    fn distribute(&self, points: &[Point], first: usize) -> Bucketed<Placed> {
        let mut bucketed = Bucketed::new(self.buckets(), points.len());
        for (&point, index) in points.iter().zip(first as u64..) {
            let position = self.position(point);
            bucketed.put(self.bucket(position), self.placed(position, index));
        }
        bucketed
    }
}

/// Sorts the points along the curve and takes duplicates out, on `threads` threads.
///
/// O(n), by radix: points are distributed to buckets of [`BUCKET`] points or somewhat more, if they are spread evenly,
/// and each bucket is sorted by itself. A thread has whole buckets, so threads help less if few buckets hold
/// most of the points.
pub(super) fn sort(points: &[Point], threads: usize) -> Sites {
    let curve = Curve::of(points, threads);
    let mut all = Sites {
        sites: pages::zeros(points.len()),
        ids: pages::zeros(points.len()),
        duplicates: Vec::new(),
        bits: curve.bits,
    };
    let share = points.len().div_ceil(threads).max(1);
    let bucketed = in_parallel(points.chunks(share).enumerate(), |(place, own)| curve.distribute(own, share * place));
    let ends = bucket_ends(&bucketed, curve.buckets());
    let (mut sites, mut ids) = (all.sites.as_mut_slice(), all.ids.as_mut_slice());
    let tasks = runs(&ends, threads).into_iter().map(|run| {
        let room = ..items_of(&run, &ends).len();
        let sites = sites.split_off_mut(room).unwrap_or_default();
        let ids = ids.split_off_mut(room).unwrap_or_default();
        (run, Kept { sites, ids, count: 0, duplicates: Vec::new() })
    });
    let kept = in_parallel(tasks, |(run, mut kept)| {
        let room = kept.sites.len();
        let (mut words, mut found) = (Vec::new(), Vec::new());
        for bucket in run {
            words.clear();
            bucketed.iter().flat_map(|own| own.chunks(bucket)).for_each(|chunk| words.extend_from_slice(chunk));
            sort_words(&mut words);
            if curve.is_exact() {
                kept.take_exact(&words, bucket as u64, curve);
            } else {
                kept.take_rounded(&mut words, points, &mut found, curve);
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
    /// Takes the sorted words of a bucket that have whole positions.
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
            let position = bucket.checked_shl(curve.rest_bits).unwrap_or(0) | rest >> (u64::BITS - curve.rest_bits);
            self.keep(point_at(position).into(), index);
        }
    }

    /// Takes the sorted words of a bucket if they hold only the leading bits of their positions. `found` is memory for
    /// the points of these words.
    fn take_rounded(&mut self, words: &mut [Placed], points: &[Point], found: &mut Vec<Point>, curve: Curve) {
        let groups = words.chunk_by_mut(|one, other| (one.0 ^ other.0) & !curve.indices() == 0);
        for group in groups.filter(|group| group.len() > 1) {
            for word in &mut *group {
                let index = word.0 & curve.indices();
                *word = curve.placed_finely(curve.position(points[index as usize]), index);
            }
            let mut sorted = group.to_vec();
            sort_words(&mut sorted);
            group.copy_from_slice(&sorted);
        }
        let index = |word: &Placed| (word.0 & curve.indices()) as u32;
        found.clear();
        // The loop is short so that the processor has many of its scattered reads under way at a time.
        found.extend(words.iter().map(|word| points[index(word) as usize]));
        let mut before = None;
        for (word, &point) in words.iter().zip(&*found) {
            if before == Some(point) {
                self.drop_onto_last(index(word));
                continue;
            }
            before = Some(point);
            self.keep(curve.site(point), index(word));
        }
    }

    #[inline(always)]
    fn keep(&mut self, site: Site, id: u32) {
        (self.sites[self.count], self.ids[self.count]) = (site, id);
        self.count += 1;
    }

    fn drop_onto_last(&mut self, index: u32) {
        // The list of kept points is never empty here, because the point has the coordinates of the last of them.
        self.duplicates.extend(self.ids[..self.count].last().map(|&of| Duplicate { index, of }));
    }
}

impl Sites {
    /// Closes the gaps between runs. Each run is given by its room, the number of sites in it, and its duplicates.
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
