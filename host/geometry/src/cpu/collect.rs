//! From the subdivision to the canonical mesh.
//!
//! The list of triangles is sorted by the smallest corner, then by the second one. Each edge names at most one
//! triangle: seen along the edge from the end with the smaller id, the triangle to the left is named if that end is its
//! smallest corner. The edge from the smallest corner of a triangle to the next corner names it, and no other edge
//! does. So a pass over the edges finds every triangle once, in the order of the curve. The triangles are distributed
//! to buckets of neighbouring ids, and each bucket is sorted while it is in the cache. No list is read in an order far
//! from that of the curve or of the ids.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use bytemuck::Zeroable;

use super::buckets::{bucket_ends, items_of, runs, Bucketed, CHUNK, MOST_BUCKETS_BITS};
use super::edges::{is_used, Half, Halves};
use super::parallel::in_parallel;
use crate::mesh::smallest_first;
use crate::pages;

/// Marks, in the `end` of a half-edge, that the outside lies to the left of the half-edge.
const GAP: u32 = <[Half] as Halves>::GAP;
/// Ids of a bucket, as a power of two, unless threads or very many points ask for more. With two triangles an id a
/// bucket and its copy take 64 kB.
const BUCKET_BITS: u32 = 11;
/// Triangles of an id that are sorted without branches. An id is the smallest corner of two triangles on average, and
/// of more than four in one case out of ten.
const FEW: usize = 4;
/// Edges that are processed together. A block and its triangles, 14 kB, stay in the first-level cache.
const BLOCK: usize = 512;

/// The hull, counter-clockwise from its lowest id on. The function also marks the half-edges that have the
/// outside to their left.
pub(super) fn hull<H: Halves + ?Sized>(halves: &mut H, ids: &[u32], start: u32, hull: &mut Vec<u32>) {
    hull.clear();
    let mut e = start;
    loop {
        // The outside lies to the right of `e`, so the next half-edge clockwise around its origin has it to the left.
        let Half { previous, end, .. } = halves.half(e);
        halves.set_end(previous, halves.half(previous).end | H::GAP);
        hull.push(ids[(end & !H::GAP) as usize]);
        e = halves.half(e ^ 1).next;
        // A hull has each vertex once, unless the half-edges come from outside and are wrong.
        if e == start || hull.len() > ids.len() {
            break;
        }
    }
    let lowest = (0..hull.len()).min_by_key(|&place| hull[place]).unwrap_or(0);
    hull.rotate_left(lowest);
}

/// The hull in a list of its own; see [`hull`].
pub(super) fn hull_of(halves: &mut [Half], ids: &[u32], start: u32) -> Vec<u32> {
    let mut found = Vec::new();
    hull(halves, ids, start, &mut found);
    found
}

/// All `count` triangles of the mesh of `points` input points, smallest id first in each, sorted. The memory of the
/// half-edges is reused for the result.
pub(super) fn triangles(halves: Vec<Half>, ids: &[u32], points: usize, count: usize, threads: usize) -> Vec<[u32; 3]> {
    let found = triangles_with(halves, ids, &[], points, count, threads);
    // Euler's formula says how many there are, so they are never missing.
    debug_assert!(found.is_some());
    found.unwrap_or_default()
}

/// Triangles that are known already.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    /// The corners of each triangle, as places in `ids`, the first of them in any place.
    pub(super) triangles: &'a [[u32; 3]],
    /// The input indices of the vertices.
    pub(super) ids: &'a [u32],
}

/// All `count` triangles of a mesh of which some are known already, in lists of any lengths; see [`triangles`]. Returns
/// `None` if the edges and the lists give another number of triangles.
pub(super) fn triangles_with(
    halves: Vec<Half>,
    ids: &[u32],
    known: &[Known<'_>],
    points: usize,
    count: usize,
    threads: usize,
) -> Option<Vec<[u32; 3]>> {
    let buckets = Buckets::of(points, threads);
    if buckets.fit_a_word() {
        buckets.sorted::<Packed>(halves, ids, known, count, threads)
    } else {
        buckets.sorted::<[u32; 3]>(halves, ids, known, count, threads)
    }
}

/// The buckets of triangles: each holds the triangles whose smallest corner is in a range of ids.
#[derive(Clone, Copy)]
struct Buckets {
    /// Ids of a bucket, as a power of two.
    bits: u32,
    /// The number of bits of an id.
    id_bits: u32,
    count: usize,
}

/// A triangle in a bucket, ordered by its corners.
trait Triangle: Copy + Ord + Zeroable + Send + Sync {
    /// A value that sorts after all triangles of its bucket.
    const LAST: Self;

    fn of(corners: [u32; 3], buckets: Buckets) -> Self;

    /// The smallest corner, counted from the first id of the bucket.
    fn smallest(self, buckets: Buckets) -> usize;

    /// The corners, in a bucket whose ids begin with `first`.
    fn corners(self, first: u32, buckets: Buckets) -> [u32; 3];
}

/// The form for any number of points.
impl Triangle for [u32; 3] {
    const LAST: Self = [u32::MAX; 3];

    fn of(corners: [u32; 3], _: Buckets) -> Self {
        corners
    }

    fn smallest(self, buckets: Buckets) -> usize {
        (self[0] & buckets.mask()) as usize
    }

    fn corners(self, _: u32, _: Buckets) -> [u32; 3] {
        self
    }
}

/// The form for up to 2^25 points: all corners in one word, the smallest one at the top, without the leading bits that
/// follow from the bucket.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Zeroable)]
struct Packed(u64);

impl Triangle for Packed {
    const LAST: Self = Self(u64::MAX);

    #[inline(always)]
    fn of([smallest, second, third]: [u32; 3], buckets: Buckets) -> Self {
        let pair = u64::from(second) << buckets.id_bits | u64::from(third);
        Self(u64::from(smallest & buckets.mask()) << (2 * buckets.id_bits) | pair)
    }

    #[inline(always)]
    fn smallest(self, buckets: Buckets) -> usize {
        (self.0 >> (2 * buckets.id_bits)) as usize
    }

    #[inline(always)]
    fn corners(self, first: u32, buckets: Buckets) -> [u32; 3] {
        let id = |word: u64| word as u32 & ((1 << buckets.id_bits) - 1);
        [first + self.smallest(buckets) as u32, id(self.0 >> buckets.id_bits), id(self.0)]
    }
}

/// An edge, seen from its end with the smaller id.
#[derive(Clone, Copy, Default)]
struct Edge {
    smaller: u32,
    larger: u32,
    /// The next half-edge counter-clockwise; later the vertex that this half-edge leads to.
    next: u32,
    /// Whether there is a triangle to the left of the edge.
    is_inside: bool,
}

/// Lists the edges of a block of half-edges; returns their number.
fn look_at(halves: &[Half], ids: &[u32], edges: &mut [Edge; BLOCK]) -> usize {
    let mut count = 0;
    for pair in halves.as_chunks::<2>().0.iter().filter(|pair| is_used([pair[0].end, pair[1].end])) {
        let id = |half: Half| ids[(half.end & !GAP) as usize];
        let (from, to) = (id(pair[1]), id(pair[0]));
        // An index instead of a branch, because no processor predicts which end has the smaller id.
        let leaving = pair[usize::from(to < from)];
        edges[count] =
            Edge { smaller: from.min(to), larger: from.max(to), next: leaving.next, is_inside: leaving.end < GAP };
        count += 1;
    }
    count
}

impl Buckets {
    /// Buckets for ids below `points`, and for triangles that `threads` threads find.
    fn of(points: usize, threads: usize) -> Self {
        let last = points.saturating_sub(1);
        let id_bits = usize::BITS - last.leading_zeros();
        // There are two triangles an id. Each thread and bucket should have at least a chunk of them.
        let least = BUCKET_BITS.max((CHUNK * threads / 2).next_power_of_two().ilog2());
        let bits = least.min(id_bits).max(id_bits.saturating_sub(MOST_BUCKETS_BITS));
        Self { bits, id_bits, count: (last >> bits) + 1 }
    }

    /// Whether a triangle fits one word.
    fn fit_a_word(self) -> bool {
        self.bits + 2 * self.id_bits <= u64::BITS
    }

    /// The bits of an id that number it inside its bucket.
    #[inline(always)]
    fn mask(self) -> u32 {
        (1 << self.bits) - 1
    }

    fn sorted<T: Triangle>(
        self,
        halves: Vec<Half>,
        ids: &[u32],
        known: &[Known<'_>],
        count: usize,
        threads: usize,
    ) -> Option<Vec<[u32; 3]>> {
        // Each thread has a share of the half-edges and a share of the lists.
        let own = (halves.len() / 2).div_ceil(threads).max(1) * 2;
        let shares = |k: usize| halves.chunks(own).nth(k).unwrap_or_default();
        let lists = known.len().div_ceil(threads).max(1);
        let tasks = (0..threads).map(|k| (shares(k), known.chunks(lists).nth(k).unwrap_or_default()));
        let found: Vec<Bucketed<T>> = in_parallel(tasks, |(own, known)| {
            let mut bucketed = Bucketed::new(self.count, count / threads);
            self.distribute(known, &mut bucketed);
            self.find(&halves, own, ids, &mut bucketed);
            bucketed
        });
        let ends = bucket_ends(&found, self.count);
        if ends.last() != Some(&count) {
            return None;
        }
        // The triangles take the memory of the half-edges, whose pages the system has provided already.
        let mut triangles: Vec<[u32; 3]> =
            if halves.len() < count { pages::zeros(count) } else { bytemuck::cast_vec(halves) };
        triangles.truncate(count);
        let mut rest = triangles.as_mut_slice();
        let tasks = runs(&ends, threads).into_iter().map(|run| {
            let own = rest.split_off_mut(..items_of(&run, &ends).len()).unwrap_or_default();
            (own, run)
        });
        in_parallel(tasks, |(own, run)| self.sort(&found, own, run));
        triangles.shrink_to_fit();
        Some(triangles)
    }

    /// Distributes triangles that are known already.
    fn distribute<T: Triangle>(self, known: &[Known<'_>], bucketed: &mut Bucketed<T>) {
        for &Known { triangles, ids } in known {
            for &corners in triangles {
                let triangle = smallest_first(corners.map(|v| ids[v as usize]));
                bucketed.put((triangle[0] >> self.bits) as usize, T::of(triangle, self));
            }
        }
    }

    /// Distributes the triangles that the edges in a range of the half-edges name.
    fn find<T: Triangle>(self, halves: &[Half], own: &[Half], ids: &[u32], bucketed: &mut Bucketed<T>) {
        let mut edges = [Edge::default(); BLOCK];
        let mut triangles = [[0; 3]; BLOCK];
        for block in own.chunks(2 * BLOCK) {
            let count = look_at(block, ids, &mut edges);
            let edges = &mut edges[..count];
            // The loop is short so that the processor has many of its scattered reads under way at a time.
            for edge in &mut *edges {
                edge.next = halves[edge.next as usize].end & !GAP;
            }
            let mut found = 0;
            for &Edge { smaller, larger, next, is_inside } in &*edges {
                let third = ids[next as usize];
                // Every triangle is written, and the counter keeps the right ones: no processor would predict a branch.
                triangles[found] = [smaller, larger, third];
                found += usize::from(is_inside & (smaller < third));
            }
            for &triangle in &triangles[..found] {
                bucketed.put((triangle[0] >> self.bits) as usize, T::of(triangle, self));
            }
        }
    }

    /// Sorts a run of buckets into its range of the list.
    fn sort<T: Triangle>(self, found: &[Bucketed<T>], mut rest: &mut [[u32; 3]], run: Range<usize>) {
        let mut room = Room { id_ends: vec![0; 1 << self.bits], sorted: Vec::new() };
        for bucket in run {
            let triangles = || found.iter().flat_map(|found| found.chunks(bucket)).flatten().copied();
            let sorted = room.sort(triangles, self);
            let first = (bucket << self.bits) as u32;
            for (slot, triangle) in rest.iter_mut().zip(sorted) {
                *slot = triangle.corners(first, self);
            }
            rest = rest.split_off_mut(sorted.len()..).unwrap_or_default();
        }
        debug_assert!(rest.is_empty());
    }
}

/// The memory in which a thread sorts its buckets, one after the other.
struct Room<T> {
    /// For each id of the bucket, the end of its triangles in `sorted`.
    id_ends: Vec<u32>,
    /// The triangles of the bucket, then [`FEW`] more places.
    sorted: Vec<T>,
}

impl<T: Triangle> Room<T> {
    /// Sorts the triangles of a bucket by counting their smallest corners, then sorts the few triangles of each id.
    fn sort<I: Iterator<Item = T>>(&mut self, triangles: impl Fn() -> I, buckets: Buckets) -> &[T] {
        let Self { id_ends, sorted } = self;
        id_ends.fill(0);
        triangles().for_each(|triangle| id_ends[triangle.smallest(buckets)] += 1);
        let mut count = 0;
        for end in &mut *id_ends {
            count += core::mem::replace(end, count);
        }
        let count = count as usize;
        sorted.resize(sorted.len().max(count + FEW), T::LAST);
        sorted[count..][..FEW].fill(T::LAST);
        triangles().for_each(|triangle| {
            let end = &mut id_ends[triangle.smallest(buckets)];
            sorted[*end as usize] = triangle;
            *end += 1;
        });
        let mut start = 0;
        for &end in &*id_ends {
            let own = core::mem::replace(&mut start, end as usize);
            if start - own > FEW {
                sorted[own..start].sort_unstable();
            } else if let Some(few) = sorted[own..].first_chunk_mut() {
                // `first_chunk_mut` always succeeds, because `sorted` has `FEW` places behind the triangles.
                sort_few(few);
            }
        }
        &sorted[..count]
    }
}

/// Sorts four triangles without branches, because no processor predicts how many triangles an id has. The last ones may
/// belong to larger ids. As these sort behind, the triangles of each id stay together.
#[inline(always)]
fn sort_few<T: Ord + Copy>([a, b, c, d]: &mut [T; FEW]) {
    let order = |a: &mut T, b: &mut T| (*a, *b) = ((*a).min(*b), (*a).max(*b));
    order(a, b);
    order(c, d);
    order(a, c);
    order(b, d);
    order(b, c);
}

#[cfg(test)]
mod tests {
    use super::super::edges::HALVES;
    use super::super::segments;
    use super::super::sites::{sort, Sites};
    use super::super::view::{Integers, Narrow};
    use super::*;
    use crate::order::mix;
    use crate::point::Point;
    use proptest::prelude::*;

    #[test]
    fn both_forms_of_triangles_sort_alike() {
        let points: Vec<Point> = (0..6000).map(mix).map(|k| Point::new(k as u32 & 0xffff, k as u32 >> 16)).collect();
        let Sites { sites, ids, .. } = sort(&points, 1);
        let mut halves = pages::zeros(HALVES * sites.len());
        let whole =
            segments::triangulate::<Integers<Narrow>>(&sites, &sites, &mut halves, 1, &mut |_| true).expect("points");
        let hull = hull_of(&mut halves, &ids, whole.leftmost());
        let (buckets, count) = (Buckets::of(points.len(), 1), 2 * ids.len() - 2 - hull.len());
        let words = buckets.sorted::<Packed>(halves.clone(), &ids, &[], count, 1).expect("all triangles");
        assert_eq!(words.len(), count);
        assert!(words.is_sorted());
        for threads in [1, 3] {
            assert!(Some(&words) == buckets.sorted::<[u32; 3]>(halves.clone(), &ids, &[], count, threads).as_ref());
        }
    }

    #[test]
    fn words_hold_all_corners_up_to_2_to_the_25_points() {
        for points in [3, 4, 2047, 2048, 2049, 1 << 22, (1 << 22) + 1, (1 << 25) - 1, 1 << 25] {
            let buckets = Buckets::of(points, 1);
            assert!(buckets.fit_a_word(), "{points}");
            let last = points as u32 - 1;
            let mut before = None;
            for corners in
                [[0, 1, 2], [0, 2, 1], [0, last - 1, last], [last - 2, last - 1, last], [last - 2, last, last - 1]]
            {
                let packed = Packed::of(corners, buckets);
                let bucket = corners[0] >> buckets.bits;
                assert!((bucket as usize) < buckets.count && packed < Packed::LAST);
                assert_eq!(packed.smallest(buckets) as u32, corners[0] & buckets.mask());
                assert_eq!(packed.corners(bucket << buckets.bits, buckets), corners);
                let place = (bucket, packed);
                assert!(before.is_none_or(|before| before < place) || points == 3, "{corners:?}");
                before = Some(place);
            }
        }
        assert!(!Buckets::of((1 << 25) + 1, 1).fit_a_word());
    }

    #[test]
    fn threads_and_buckets_have_a_chunk_of_triangles_each() {
        for threads in 1..=300 {
            for points in [1, 16_384 * threads, 1 << 22, (1 << 29) - 1] {
                let Buckets { bits, count, .. } = Buckets::of(points, threads);
                assert!(count == 1 || (2 << bits) >= CHUNK * threads, "{threads} threads, {points} points");
                assert!(count <= 1 << MOST_BUCKETS_BITS);
            }
        }
    }

    proptest! {
        #[test]
        fn a_bucket_is_sorted(
            counts in prop::collection::vec(0u32..10, 1 << 8),
            full in 0u32..10,
            seed in any::<u64>(),
        ) {
            let buckets = Buckets::of(1 << 8, 1);
            let mut triangles: Vec<[u32; 3]> = Vec::new();
            let counts = counts.into_iter().chain([full]).rev().take(1 << 8);
            for (id, count) in (0..1u32 << 8).rev().zip(counts) {
                triangles.extend((0..count).map(|k| [id, mix(seed ^ u64::from(k + 10 * id)) as u32 & 255, k]));
            }
            triangles.sort_by_key(|&[a, b, c]| mix(seed ^ u64::from(a << 16 | b << 8 | c)));
            let mut room = Room { id_ends: vec![0; 1 << 8], sorted: Vec::new() };
            // The second part is sorted in memory that still holds the first one.
            for part in [&triangles[..], &triangles[triangles.len() / 2..]] {
                let mut expected = part.to_vec();
                expected.sort_unstable();
                let packed = || part.iter().map(|&corners| Packed::of(corners, buckets));
                let sorted: Vec<_> = room.sort(packed, buckets).iter().map(|found| found.corners(0, buckets)).collect();
                prop_assert_eq!(sorted, expected);
            }
        }
    }
}
