//! The triangles of a small set, sorted in memory that is kept from set to set.
//!
//! As in `collect`, each edge names at most one triangle, that to the left of the edge as seen from its end with the
//! smaller id, if this end is the smallest corner. No two triangles have the first and the second corner in common, so
//! two passes of a counting sort, by the second corner and then by the first, put all in order.

use alloc::vec::Vec;

use super::super::edges::{is_used, Half, Halves};
use super::super::short;

/// Bits of a corner in a word that holds a triangle.
const ID_BITS: u32 = 21;
/// Most points for which a triangle fits a word.
pub(super) const MOST: usize = 1 << ID_BITS;

/// The most sites whose half-edges (half a megabyte) stay in a second-level cache.
const IN_CACHE: usize = short::MOST;
/// The number of edges that are processed together. They take 5 kB.
const BLOCK: usize = 256;

/// The memory to sort triangles.
#[derive(Debug, Default)]
pub(super) struct SmallCollect {
    found: Vec<u64>,
    sorted: Vec<u64>,
    first: Vec<u32>,
    second: Vec<u32>,
}

/// One corner of a triangle in a word: 2 is the first and smallest, 0 the last.
#[inline(always)]
fn corner(word: u64, place: u32) -> u32 {
    (word >> (place * ID_BITS)) as u32 & (MOST as u32 - 1)
}

impl SmallCollect {
    /// Lists all `count` triangles of the mesh of `points` input points, smallest id first in each, sorted.
    pub(super) fn triangles<H: Halves + ?Sized>(
        &mut self,
        halves: &H,
        ids: &[u32],
        points: usize,
        count: usize,
        triangles: &mut Vec<[u32; 3]>,
    ) {
        for counts in [&mut self.first, &mut self.second] {
            counts.clear();
            counts.resize(points, 0);
        }
        self.found.resize(self.found.len().max(2 * points + 1), 0);
        self.sorted.resize(self.sorted.len().max(2 * points), 0);
        let found = self.find(halves, ids);
        // Euler's formula says how many there are.
        debug_assert_eq!(found, count);
        let (found, sorted) = (&self.found[..count], &mut self.sorted[..count]);
        add_up(&mut self.second);
        for &word in found {
            let place = &mut self.second[corner(word, 1) as usize];
            sorted[*place as usize] = word;
            *place += 1;
        }
        add_up(&mut self.first);
        triangles.resize(count, [0; 3]);
        for &mut word in sorted {
            let place = &mut self.first[corner(word, 2) as usize];
            triangles[*place as usize] = [corner(word, 2), corner(word, 1), corner(word, 0)];
            *place += 1;
        }
    }

    /// Finds all triangles, and counts how often each id is a first and a second corner. Returns the
    /// number of the triangles.
    fn find<H: Halves + ?Sized>(&mut self, halves: &H, ids: &[u32]) -> usize {
        let Self { found, first, second, .. } = self;
        let mut count = 0;
        let mut take = |edge: Edge, end: u32| {
            let third = ids[(end & !H::GAP) as usize];
            let Edge { smaller, larger, is_inside, .. } = edge;
            // Every triangle is written, and the counters keep the right ones: no processor would predict a branch.
            let is_triangle = u32::from(is_inside & (smaller < third));
            found[count] = u64::from(smaller) << (2 * ID_BITS) | u64::from(larger) << ID_BITS | u64::from(third);
            count += is_triangle as usize;
            first[smaller as usize] += is_triangle;
            second[larger as usize] += is_triangle;
        };
        let mut edges = (0..3 * ids.len() as u32).filter_map(|pair| edge(halves, ids, pair));
        if ids.len() <= IN_CACHE {
            edges.for_each(|edge| take(edge, halves.half(edge.next).end));
            return count;
        }
        let mut block = [(Edge::default(), 0); BLOCK];
        loop {
            let mut listed = 0;
            for (slot, edge) in block.iter_mut().zip(&mut edges) {
                slot.0 = edge;
                listed += 1;
            }
            // The loop is short so that the processor has many of its scattered reads under way at a time.
            for (edge, end) in &mut block[..listed] {
                *end = halves.half(edge.next).end;
            }
            for &(edge, end) in &block[..listed] {
                take(edge, end);
            }
            if listed < BLOCK {
                return count;
            }
        }
    }
}

/// An edge, seen from its end with the smaller id.
#[derive(Clone, Copy, Default)]
struct Edge {
    smaller: u32,
    larger: u32,
    /// The next half-edge counter-clockwise around the end with the smaller id.
    next: u32,
    /// Whether there is a triangle to the left of the edge.
    is_inside: bool,
}

/// The edge of a pair of half-edges, if the pair is used.
#[inline(always)]
fn edge<H: Halves + ?Sized>(halves: &H, ids: &[u32], pair: u32) -> Option<Edge> {
    let ends = [halves.half(2 * pair).end, halves.half(2 * pair + 1).end];
    if !is_used(ends) {
        return None;
    }
    let [to, from] = ends.map(|end| ids[(end & !H::GAP) as usize]);
    // The comparison is an index and no branch, because no processor predicts which end has the smaller id.
    let Half { next, end, .. } = halves.half(2 * pair + u32::from(to < from));
    Some(Edge { smaller: from.min(to), larger: from.max(to), next, is_inside: end & H::GAP == 0 })
}

/// Replaces each count by the sum of all counts before it.
fn add_up(counts: &mut [u32]) {
    let mut sum = 0;
    for count in counts {
        sum += core::mem::replace(count, sum);
    }
}
