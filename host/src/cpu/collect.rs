//! From the subdivision to the canonical mesh.
//!
//! The list is sorted by smallest corner, then by the second one. Each edge knows one triangle of which its end with the smaller id may be the
//! smallest corner: the one to its left, seen from there. So a pass over the edges finds every triangle once, in the order of the curve. They are
//! dealt to buckets of neighbouring ids, and each bucket is sorted while it is in the cache: no list is walked in an order far from that of the curve
//! or of the ids.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::edges::Half;
use super::parallel::in_parallel;
use crate::pages::{self, shared};

/// Marks the end of a half-edge that has the outside to its left.
const GAP: u32 = 1 << 31;
/// Least ids of a bucket, as a power of two: with its triangles and their copy it stays in the second-level cache, up to four million points.
const BUCKET_BITS: u32 = 11;
/// Most buckets, as a power of two: so many places can be written to at a time.
const MOST_BUCKETS_BITS: u32 = 11;
/// Edges between two looks at the room that is left.
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
    let stretch = (halves.len() / 2).div_ceil(threads).max(1) * 2;
    let mut found = in_parallel(halves.chunks(stretch), |own| buckets.find(&halves, own, ids, count / threads));
    let ends = buckets.give_places(&mut found);
    // They take the room of the half-edges, which the system has given already.
    let mut triangles: Vec<[u32; 3]> = bytemuck::cast_vec(halves);
    triangles.truncate(count);
    let corners = shared(triangles.as_flattened_mut());
    in_parallel(found.into_iter(), |found| found.deal(buckets, corners));
    in_parallel(split(&mut triangles, &ends, threads).into_iter(), |own| buckets.sort(own, &ends));
    triangles.shrink_to_fit();
    triangles
}

/// Triangles by their smallest corner: those of so many ids are together.
#[derive(Clone, Copy)]
struct Buckets {
    /// Ids of a bucket, as a power of two.
    bits: u32,
    count: usize,
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

/// Triangles of a stretch of half-edges.
struct Found {
    triangles: Vec<[u32; 3]>,
    /// Of each bucket: first how many of the triangles are its own, then the place in the list of all where the next of them goes.
    places: Vec<u32>,
}

impl Buckets {
    fn of(points: usize) -> Self {
        let bits = BUCKET_BITS.max((points.max(1).ilog2() + 1).saturating_sub(MOST_BUCKETS_BITS));
        Self { bits, count: (points >> bits) + 1 }
    }

    fn at(self, id: u32) -> usize {
        (id >> self.bits) as usize
    }

    /// The triangles of which an edge in a stretch of the half-edges knows. There should be about `expected`.
    fn find(self, halves: &[Half], own: &[Half], ids: &[u32], expected: usize) -> Found {
        let mut triangles: Vec<[u32; 3]> = pages::zeros(expected + expected / 8 + BLOCK);
        let mut sizes = vec![0; self.count];
        let mut found = 0;
        let mut edges = [Edge::default(); BLOCK];
        for block in own.chunks(2 * BLOCK) {
            if triangles.len() < found + BLOCK {
                triangles.resize(2 * (found + BLOCK), [0; 3]);
            }
            let count = look_at(block, ids, &mut edges);
            let edges = &mut edges[..count];
            // A loop of its own, with so little in it that the processor waits for many of these at a time.
            for edge in &mut *edges {
                edge.next = halves[edge.next as usize].end & !GAP;
            }
            for &Edge { smaller, larger, next, is_inside } in &*edges {
                let third = ids[next as usize];
                // Written in any case and kept in some: no processor predicts which.
                triangles[found] = [smaller, larger, third];
                let is_one = is_inside & (smaller < third);
                sizes[self.at(smaller)] += u32::from(is_one);
                found += usize::from(is_one);
            }
        }
        triangles.truncate(found);
        Found { triangles, places: sizes }
    }

    /// Gives the triangles of all stretches their places in the list, bucket by bucket; returns where each bucket ends.
    fn give_places(self, found: &mut [Found]) -> Vec<usize> {
        let mut end = 0;
        (0..self.count)
            .map(|bucket| {
                for found in &mut *found {
                    let size = std::mem::replace(&mut found.places[bucket], end as u32);
                    end += size as usize;
                }
                end
            })
            .collect()
    }

    /// Sorts some buckets, which are a stretch of the list.
    fn sort(self, (own, buckets): (&mut [[u32; 3]], Range<usize>), ends: &[usize]) {
        let mut rest = own;
        let mut start = buckets.start.checked_sub(1).map_or(0, |before| ends[before]);
        let mut room = Room { ends: vec![0; 1 << self.bits], pairs: Vec::new() };
        for bucket in buckets {
            let size = ends[bucket] - std::mem::replace(&mut start, ends[bucket]);
            let (own, after) = rest.split_at_mut(size);
            room.sort(own, (bucket << self.bits) as u32);
            rest = after;
        }
    }
}

impl Found {
    /// Writes the triangles to their places, corner by corner.
    fn deal(mut self, buckets: Buckets, corners: &[AtomicU32]) {
        for &triangle in &self.triangles {
            let place = &mut self.places[buckets.at(triangle[0])];
            let slots = &corners[3 * *place as usize..][..3];
            slots.iter().zip(triangle).for_each(|(slot, corner)| slot.store(corner, Relaxed));
            *place += 1;
        }
    }
}

/// What sorting a bucket takes.
struct Room {
    /// Of each id, where its triangles end.
    ends: Vec<u32>,
    /// The two larger corners of each triangle, in one word.
    pairs: Vec<u64>,
}

impl Room {
    /// Sorts the triangles of a bucket, whose ids begin with `first`.
    fn sort(&mut self, own: &mut [[u32; 3]], first: u32) {
        self.ends.fill(0);
        for [smallest, ..] in &*own {
            self.ends[(smallest - first) as usize] += 1;
        }
        let mut sum = 0;
        for end in &mut self.ends {
            sum += std::mem::replace(end, sum);
        }
        self.pairs.resize(self.pairs.len().max(own.len()), 0);
        for &[smallest, second, third] in &*own {
            let end = &mut self.ends[(smallest - first) as usize];
            self.pairs[*end as usize] = u64::from(second) << 32 | u64::from(third);
            *end += 1;
        }
        let mut start = 0;
        for (id, &end) in (first..).zip(&self.ends) {
            let range = std::mem::replace(&mut start, end as usize)..end as usize;
            let pairs = &mut self.pairs[range.clone()];
            sort_few(pairs);
            for (slot, &mut pair) in own[range].iter_mut().zip(pairs) {
                *slot = [id, (pair >> 32) as u32, pair as u32];
            }
        }
    }
}

/// Sorts a few words. Up to four without branches on them.
#[inline(always)]
fn sort_few(words: &mut [u64]) {
    let order = |a: &mut u64, b: &mut u64| (*a, *b) = ((*a).min(*b), (*a).max(*b));
    match words {
        [] | [_] => {}
        [a, b] => order(a, b),
        [a, b, c] => {
            order(a, b);
            order(b, c);
            order(a, b);
        }
        [a, b, c, d] => {
            order(a, b);
            order(c, d);
            order(a, c);
            order(b, d);
            order(b, c);
        }
        more => more.sort_unstable(),
    }
}

/// The list in stretches of whole buckets with about as many triangles each, and which buckets these are.
fn split<'a>(triangles: &'a mut [[u32; 3]], ends: &[usize], count: usize) -> Vec<(&'a mut [[u32; 3]], Range<usize>)> {
    let all = triangles.len();
    let (mut rest, mut first, mut start) = (triangles, 0, 0);
    (1..=count)
        .map(|k| {
            let last = if k == count { ends.len() } else { ends.partition_point(|&end| end <= k * all / count) };
            let end = last.checked_sub(1).map_or(0, |last| ends[last]);
            let (own, after) = std::mem::take(&mut rest).split_at_mut(end - start);
            (rest, start) = (after, end);
            (own, std::mem::replace(&mut first, last)..last)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::edges::HALVES;
    use super::super::sites::{sort, Sites};
    use super::super::{conquer, view::Narrow};
    use super::*;
    use crate::order::mix;
    use crate::point::Point;

    #[test]
    fn a_stretch_may_have_more_triangles_than_expected() {
        let points: Vec<Point> = (0..4000).map(mix).map(|k| Point::new(k as u32 & 0xffff, k as u32 >> 16)).collect();
        let Sites { sites, ids, .. } = sort(&points, 1);
        let mut halves = pages::zeros(HALVES * sites.len());
        let whole = conquer::triangulate::<Narrow>(&sites, &mut halves, 1, &mut |_| true).expect("points");
        let hull = hull(&mut halves, &ids, whole.leftmost());
        let buckets = Buckets::of(points.len());
        let found = [0, 8000].map(|expected| buckets.find(&halves, &halves, &ids, expected));
        assert_eq!(found[0].triangles.len(), 2 * ids.len() - 2 - hull.len());
        assert!(found[0].triangles == found[1].triangles && found[0].places == found[1].places);
        assert_eq!(found[0].places.iter().sum::<u32>() as usize, found[0].triangles.len());
    }
}
