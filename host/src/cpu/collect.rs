//! From the subdivision to the canonical mesh.
//!
//! The list is sorted by smallest corner, then by the second one. Each edge knows one triangle of which its end with the smaller id may be the
//! smallest corner: the one to its left, seen from there. So a pass over the edges finds every triangle once, in the order of the curve. They are
//! dealt to buckets of neighbouring ids, and each bucket is sorted while it is in the cache: no list is walked in an order far from that of the curve
//! or of the ids.

use std::ops::Range;

use bytemuck::Zeroable;

use super::deal::{ends, runs, stretch, Dealt};
use super::edges::Half;
use super::parallel::in_parallel;

/// Marks the end of a half-edge that has the outside to its left.
const GAP: u32 = 1 << 31;
/// Least ids of a bucket, as a power of two: with its triangles and their copy it stays in the second-level cache, up to four million points.
const BUCKET_BITS: u32 = 11;
/// Most buckets, as a power of two: so many places can be written to at a time.
const MOST_BUCKETS_BITS: u32 = 11;
/// Most triangles of an id that are sorted without branches.
const FEW: usize = 4;
/// Edges that are looked at together.
const BLOCK: usize = 512;

/// The hull, counter-clockwise from its lowest id on; marks its half-edges.
pub(super) fn hull(halves: &mut [Half], ids: &[u32], start: u32) -> Vec<u32> {
    let mut hull = Vec::new();
    let mut e = start;
    loop {
        // The outside lies to the right of `e`, and so clockwise of it at its origin.
        let Half { previous, end, .. } = halves[e as usize];
        halves[previous as usize].end |= GAP;
        hull.push(ids[(end & !GAP) as usize]);
        e = halves[(e ^ 1) as usize].next;
        if e == start {
            break;
        }
    }
    let lowest = (0..hull.len()).min_by_key(|&place| hull[place]).unwrap_or(0);
    hull.rotate_left(lowest);
    hull
}

/// All `count` triangles of the mesh of `points` input points, smallest id first in each, sorted. The half-edges are not needed any more.
pub(super) fn triangles(halves: Vec<Half>, ids: &[u32], points: usize, count: usize, threads: usize) -> Vec<[u32; 3]> {
    let buckets = Buckets::of(points);
    if buckets.bits + 2 * buckets.id_bits <= u64::BITS {
        buckets.sorted::<Word>(halves, ids, count, threads)
    } else {
        buckets.sorted::<[u32; 3]>(halves, ids, count, threads)
    }
}

/// Triangles by their smallest corner: neighbouring ids are together.
#[derive(Clone, Copy)]
struct Buckets {
    /// Ids of a bucket, as a power of two.
    bits: u32,
    /// Bits of an id.
    id_bits: u32,
    count: usize,
}

/// A triangle in a bucket. The order is that of the corners.
trait Triangle: Copy + Ord + Zeroable + Send + Sync {
    /// After all others of its bucket.
    const LAST: Self;

    fn of(corners: [u32; 3], buckets: Buckets) -> Self;

    /// The smallest corner, counted from the first id of the bucket.
    fn smallest(self, buckets: Buckets) -> usize;

    /// The corners, in a bucket whose ids begin with `first`.
    fn corners(self, first: u32, buckets: Buckets) -> [u32; 3];
}

/// Any number of points.
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

/// All corners in one word, the smallest one at the top, where the bucket says its leading bits: up to 2^25 points.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Zeroable)]
struct Word(u64);

impl Triangle for Word {
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
    /// The next half-edge counter-clockwise, then the vertex that it leads to.
    next: u32,
    /// There is a triangle to the left.
    is_inside: bool,
}

/// Looks at the edges of some half-edges; returns how many there are.
fn look_at(halves: &[Half], ids: &[u32], edges: &mut [Edge; BLOCK]) -> usize {
    let mut count = 0;
    for pair in halves.as_chunks::<2>().0.iter().filter(|pair| pair[0].is_used()) {
        let id = |half: Half| ids[(half.end & !GAP) as usize];
        let (from, to) = (id(pair[1]), id(pair[0]));
        // An index instead of a branch: no processor predicts which.
        let leaving = pair[usize::from(to < from)];
        edges[count] =
            Edge { smaller: from.min(to), larger: from.max(to), next: leaving.next, is_inside: leaving.end < GAP };
        count += 1;
    }
    count
}

impl Buckets {
    fn of(points: usize) -> Self {
        let id_bits = usize::BITS - points.leading_zeros();
        let bits = BUCKET_BITS.max(id_bits.saturating_sub(MOST_BUCKETS_BITS));
        Self { bits, id_bits, count: (points >> bits) + 1 }
    }

    /// The bits of an id that say which one of its bucket it is.
    #[inline(always)]
    fn mask(self) -> u32 {
        (1 << self.bits) - 1
    }

    fn sorted<T: Triangle>(self, halves: Vec<Half>, ids: &[u32], count: usize, threads: usize) -> Vec<[u32; 3]> {
        let own = (halves.len() / 2).div_ceil(threads).max(1) * 2;
        let found: Vec<Dealt<T>> = in_parallel(halves.chunks(own), |own| self.find(&halves, own, ids, count / threads));
        // They take the room of the half-edges, which the system has given already.
        let mut triangles: Vec<[u32; 3]> = bytemuck::cast_vec(halves);
        triangles.truncate(count);
        let ends = ends(&found, self.count);
        let mut rest = triangles.as_mut_slice();
        let runs = runs(&ends, threads).into_iter().map(|run| {
            let own = rest.split_off_mut(..stretch(&run, &ends).len()).unwrap_or_default();
            (own, run)
        });
        in_parallel(runs, |(own, run)| self.sort(&found, own, run));
        triangles.shrink_to_fit();
        triangles
    }

    /// Deals out the triangles of which an edge in a stretch of the half-edges knows. There should be about `expected`.
    fn find<T: Triangle>(self, halves: &[Half], own: &[Half], ids: &[u32], expected: usize) -> Dealt<T> {
        let mut dealt = Dealt::new(self.count, expected);
        let mut edges = [Edge::default(); BLOCK];
        let mut triangles = [[0; 3]; BLOCK];
        for block in own.chunks(2 * BLOCK) {
            let count = look_at(block, ids, &mut edges);
            let edges = &mut edges[..count];
            // A loop of its own, with so little in it that the processor waits for many of these at a time.
            for edge in &mut *edges {
                edge.next = halves[edge.next as usize].end & !GAP;
            }
            let mut found = 0;
            for &Edge { smaller, larger, next, is_inside } in &*edges {
                let third = ids[next as usize];
                // Written in any case and kept in some: no processor predicts which.
                triangles[found] = [smaller, larger, third];
                found += usize::from(is_inside & (smaller < third));
            }
            for &triangle in &triangles[..found] {
                dealt.put((triangle[0] >> self.bits) as usize, T::of(triangle, self));
            }
        }
        dealt
    }

    /// Sorts a run of buckets into its stretch of the list.
    fn sort<T: Triangle>(self, found: &[Dealt<T>], mut rest: &mut [[u32; 3]], run: Range<usize>) {
        let (mut ends, mut sorted) = (vec![0; 1 << self.bits], Vec::new());
        for bucket in run {
            ends.fill(0);
            self.sort_bucket(
                || found.iter().flat_map(|found| found.chunks(bucket)).flatten().copied(),
                &mut ends,
                &mut sorted,
            );
            let count = ends.last().map_or(0, |&end| end as usize);
            let first = (bucket << self.bits) as u32;
            for (slot, triangle) in rest.iter_mut().zip(&sorted[..count]) {
                *slot = triangle.corners(first, self);
            }
            rest = rest.split_off_mut(count..).unwrap_or_default();
        }
    }

    /// Sorts the triangles of a bucket. For each id there must be a zero, which becomes the place where its triangles end.
    fn sort_bucket<T: Triangle, I: Iterator<Item = T>>(
        self,
        triangles: impl Fn() -> I,
        ends: &mut [u32],
        sorted: &mut Vec<T>,
    ) {
        triangles().for_each(|triangle| ends[triangle.smallest(self)] += 1);
        let mut count = 0;
        for end in &mut *ends {
            count += std::mem::replace(end, count);
        }
        let count = count as usize;
        sorted.resize(sorted.len().max(count + FEW), T::LAST);
        sorted[count..][..FEW].fill(T::LAST);
        triangles().for_each(|triangle| {
            let end = &mut ends[triangle.smallest(self)];
            sorted[*end as usize] = triangle;
            *end += 1;
        });
        let mut start = 0;
        for &end in &*ends {
            let own = std::mem::replace(&mut start, end as usize);
            if start - own > FEW {
                sorted[own..start].sort_unstable();
            } else if let Some(few) = sorted[own..].first_chunk_mut() {
                sort_few(few);
            }
        }
    }
}

/// Sorts a few triangles, of which some at the end may be of larger ids, without branches: no processor predicts how many there are.
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
    use super::super::sites::{sort, Sites};
    use super::super::{conquer, view::Narrow};
    use super::*;
    use crate::order::mix;
    use crate::pages;
    use crate::point::Point;

    #[test]
    fn both_forms_of_triangles_sort_alike() {
        let points: Vec<Point> = (0..6000).map(mix).map(|k| Point::new(k as u32 & 0xffff, k as u32 >> 16)).collect();
        let Sites { sites, ids, .. } = sort(&points, 1);
        let mut halves = pages::zeros(HALVES * sites.len());
        let whole = conquer::triangulate::<Narrow>(&sites, &mut halves, 1, &mut |_| true).expect("points");
        let hull = hull(&mut halves, &ids, whole.leftmost());
        let (buckets, count) = (Buckets::of(points.len()), 2 * ids.len() - 2 - hull.len());
        let words = buckets.sorted::<Word>(halves.clone(), &ids, count, 1);
        assert_eq!(words.len(), count);
        assert!(words.is_sorted());
        for threads in [1, 3] {
            assert!(words == buckets.sorted::<[u32; 3]>(halves.clone(), &ids, count, threads));
        }
    }
}
