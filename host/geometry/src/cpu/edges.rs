//! The subdivision of the plane: half-edges in pairs, linked into a circle around each vertex (Guibas and Stolfi
//! 1985, without the dual).
//!
//! Half-edge `e` leads to its `end`; `e ^ 1` is the other half and leads back. Around a vertex, `next` is the next
//! half-edge counter-clockwise and `previous` the next one clockwise. `n` points never have more than `3 n` edges, so a
//! part of the plane owns a range of six half-edges a vertex, and nothing is allocated.
//!
//! Unused pairs form a linked list without any preparation: both ends of an unused pair are equal, and the `next` of
//! its first half counts from the pair behind it. So a range of zeros is the list of all its pairs in order. Pairs that
//! become unused go to the front of the list, where they are still in the cache when they are taken again.

use bytemuck::{Pod, Zeroable};

use super::kernel::Kernel;

/// Half-edges that a vertex brings.
pub(super) const HALVES: usize = 6;

/// One half of an edge.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Half {
    /// The next half-edge of this origin, counter-clockwise; of an unused pair, the place of the next unused pair,
    /// counted from the pair behind this one.
    pub(super) next: u32,
    /// The next half-edge of this origin, clockwise.
    pub(super) previous: u32,
    /// The vertex that the half-edge leads to.
    pub(super) end: u32,
}

/// A list of half-edges.
pub(super) trait Halves {
    /// The bits of a number of a half-edge.
    const MASK: u32;
    /// A bit that no number of a vertex has.
    const GAP: u32;

    /// Reads a half-edge.
    fn half(&self, e: u32) -> Half;

    /// Writes a half-edge.
    fn put(&mut self, e: u32, half: Half);

    /// Writes the `next` of a half-edge.
    fn set_next(&mut self, e: u32, next: u32);

    /// Writes the `previous` of a half-edge.
    fn set_previous(&mut self, e: u32, previous: u32);

    /// Writes the `end` of a half-edge.
    fn set_end(&mut self, e: u32, end: u32);

    /// Whether a merge may take one more step. It always may, unless the half-edges come from outside and may be wrong.
    #[inline(always)]
    fn may_go_on(&self) -> bool {
        true
    }
}

impl Halves for [Half] {
    const MASK: u32 = u32::MAX;
    const GAP: u32 = 1 << 31;

    #[inline(always)]
    fn half(&self, e: u32) -> Half {
        self[e as usize]
    }

    #[inline(always)]
    fn put(&mut self, e: u32, half: Half) {
        self[e as usize] = half;
    }

    #[inline(always)]
    fn set_next(&mut self, e: u32, next: u32) {
        self[e as usize].next = next;
    }

    #[inline(always)]
    fn set_previous(&mut self, e: u32, previous: u32) {
        self[e as usize].previous = previous;
    }

    #[inline(always)]
    fn set_end(&mut self, e: u32, end: u32) {
        self[e as usize].end = end;
    }
}

/// Whether a pair of half-edges is an edge. The ends of unused pairs are equal.
#[inline(always)]
pub(super) fn is_used(ends: [u32; 2]) -> bool {
    ends[0] != ends[1]
}

/// The sites of a segment and the half-edges between them, both numbered from the start of the segment.
pub(super) struct Edges<'a, K: Kernel, H: Halves + ?Sized> {
    pub(super) sites: &'a [K::Site],
    pub(super) halves: &'a mut H,
    /// The first unused pair.
    pub(super) unused: u32,
}

impl<K: Kernel, H: Halves + ?Sized> Edges<'_, K, H> {
    #[inline(always)]
    pub(super) fn next(&self, e: u32) -> u32 {
        self.halves.half(e).next
    }

    #[inline(always)]
    pub(super) fn previous(&self, e: u32) -> u32 {
        self.halves.half(e).previous
    }

    /// The next half-edge of the origin, counter-clockwise, and the end.
    #[inline(always)]
    pub(super) fn next_and_end(&self, e: u32) -> (u32, u32) {
        let Half { next, end, .. } = self.halves.half(e);
        (next, end)
    }

    /// The next half-edge of the origin, clockwise, and the end.
    #[inline(always)]
    pub(super) fn previous_and_end(&self, e: u32) -> (u32, u32) {
        let Half { previous, end, .. } = self.halves.half(e);
        (previous, end)
    }

    #[inline(always)]
    pub(super) fn end(&self, e: u32) -> u32 {
        self.halves.half(e).end
    }

    #[inline(always)]
    pub(super) fn origin(&self, e: u32) -> u32 {
        self.end(e ^ 1)
    }

    #[inline(always)]
    pub(super) fn site(&self, v: u32) -> K::Site {
        self.sites[v as usize]
    }

    /// The vertex at which half-edge `e` begins.
    #[inline(always)]
    pub(super) fn from(&self, e: u32) -> K::Site {
        self.site(self.origin(e))
    }

    /// The vertex at which half-edge `e` ends.
    #[inline(always)]
    pub(super) fn to(&self, e: u32) -> K::Site {
        self.site(self.end(e))
    }

    /// Makes the half-edges of a single vertex: a pair that begins and ends at the vertex, each alone in its circle.
    #[inline(always)]
    pub(super) fn start_vertex(&mut self, v: u32) -> u32 {
        let pair = self.take();
        self.alone(pair, v);
        self.alone(pair ^ 1, v);
        pair
    }

    /// Makes the half-edges of two vertices, `v` and the next one: an edge between them.
    #[inline(always)]
    pub(super) fn start_edge(&mut self, v: u32) -> u32 {
        let pair = self.take();
        self.alone(pair, v + 1);
        self.alone(pair ^ 1, v);
        pair
    }

    /// Makes the half-edges of a counter-clockwise triangle; returns those that leave the corners along the hull.
    #[inline(always)]
    pub(super) fn start_triangle(&mut self, [a, b, c]: [u32; 3]) -> [u32; 3] {
        let [at_a, at_b, at_c] = [self.take(), self.take(), self.take()];
        let mut put = |e: u32, other: u32, end: u32| self.halves.put(e, Half { next: other, previous: other, end });
        put(at_a, at_c ^ 1, b);
        put(at_a ^ 1, at_b, a);
        put(at_b, at_a ^ 1, c);
        put(at_b ^ 1, at_c, b);
        put(at_c, at_b ^ 1, a);
        put(at_c ^ 1, at_a, c);
        [at_a, at_b, at_c]
    }

    /// Puts half-edge `e`, which leads to `end`, between two neighbours of the circle around its origin.
    #[inline(always)]
    pub(super) fn insert(&mut self, e: u32, end: u32, previous: u32, next: u32) {
        self.halves.set_next(previous, e);
        self.halves.set_previous(next, e);
        self.halves.put(e, Half { next, previous, end });
    }

    /// Makes half-edge `e`, which leads to `end`, the only half-edge of its origin.
    #[inline(always)]
    pub(super) fn alone(&mut self, e: u32, end: u32) {
        self.halves.put(e, Half { next: e, previous: e, end });
    }

    /// Takes an unused pair. There is always one, because a plane graph has fewer edges than three times its vertices.
    #[inline(always)]
    pub(super) fn take(&mut self) -> u32 {
        let pair = self.unused;
        self.unused = self.next(pair).wrapping_add(pair.wrapping_add(2)) & H::MASK;
        pair
    }

    /// Takes an edge out of the circles around both its ends, and makes its pair unused.
    #[inline(always)]
    pub(super) fn remove(&mut self, e: u32) {
        for half in [e, e ^ 1] {
            let Half { next, previous, .. } = self.halves.half(half);
            self.halves.set_next(previous, next);
            self.halves.set_previous(next, previous);
        }
        self.give(e & !1);
    }

    /// Returns a pair to the unused ones.
    #[inline(always)]
    pub(super) fn give(&mut self, pair: u32) {
        self.halves.set_next(pair, self.unused.wrapping_sub(pair.wrapping_add(2)));
        self.halves.set_end(pair, 0);
        self.halves.set_end(pair ^ 1, 0);
        self.unused = pair;
    }
}
