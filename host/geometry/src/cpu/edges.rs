//! The subdivision of the plane: half-edges in pairs, linked into a circle around each vertex (Guibas and Stolfi
//! 1985, without the dual).
//!
//! Half-edge `e` leads to its `end`; `e ^ 1` is the other half and leads back. Around a vertex, `next` is the next
//! half-edge counter-clockwise and `previous` the next one clockwise. `n` points never have more than `3 n` edges, so
//! vertex `v` brings the six half-edges from `6 v` on: a part of the plane owns a range of the list, nothing is
//! allocated, and neighbours in the plane are neighbours in memory.

use bytemuck::{Pod, Zeroable};

use super::kernel::Kernel;

/// Half-edges that a vertex brings.
pub(super) const HALVES: usize = 6;

/// Stands for the absence of a half-edge.
const NONE: u32 = u32::MAX;

/// The `end` of half-edges that are not in use.
const UNUSED: u32 = u32::MAX;

/// One half of an edge.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Half {
    /// The next half-edge of this origin, counter-clockwise; of an unused pair, the next unused pair.
    pub(super) next: u32,
    /// The next half-edge of this origin, clockwise.
    pub(super) previous: u32,
    /// The vertex that the half-edge leads to.
    pub(super) end: u32,
}

impl Half {
    /// Whether the half-edge is part of an edge.
    pub(super) fn is_used(&self) -> bool {
        self.end != UNUSED
    }

    /// Renumbers the half-edge for a longer list: adds `by` to the numbers of half-edges and `vertices`
    /// to those of vertices.
    #[cfg(feature = "std")]
    #[inline(always)]
    pub(super) fn move_by(&mut self, by: u32, vertices: u32) {
        let Self { next, previous, end } = *self;
        let end = if end == UNUSED { UNUSED } else { end + vertices };
        *self = Self { next: moved(next, by), previous: moved(previous, by), end };
    }
}

/// The number of a half-edge plus `by`; [`NONE`] stays as it is.
#[cfg(feature = "std")]
#[inline(always)]
pub(super) fn moved(e: u32, by: u32) -> u32 {
    if e == NONE {
        NONE
    } else {
        e + by
    }
}

/// A linked list of unused pairs of half-edges.
#[derive(Clone, Copy)]
pub(super) struct Free {
    pub(super) first: u32,
    pub(super) last: u32,
}

/// The sites of a segment and the half-edges between them, both numbered from the start of the segment.
pub(super) struct Edges<'a, K: Kernel> {
    pub(super) sites: &'a [K::Site],
    pub(super) halves: &'a mut [Half],
}

impl<K: Kernel> Edges<'_, K> {
    #[inline(always)]
    pub(super) fn next(&self, e: u32) -> u32 {
        self.halves[e as usize].next
    }

    #[inline(always)]
    pub(super) fn previous(&self, e: u32) -> u32 {
        self.halves[e as usize].previous
    }

    /// The next half-edge of the origin, counter-clockwise, and the end.
    #[inline(always)]
    pub(super) fn next_and_end(&self, e: u32) -> (u32, u32) {
        let Half { next, end, .. } = self.halves[e as usize];
        (next, end)
    }

    /// The next half-edge of the origin, clockwise, and the end.
    #[inline(always)]
    pub(super) fn previous_and_end(&self, e: u32) -> (u32, u32) {
        let Half { previous, end, .. } = self.halves[e as usize];
        (previous, end)
    }

    #[inline(always)]
    pub(super) fn end(&self, e: u32) -> u32 {
        self.halves[e as usize].end
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
    pub(super) fn start_vertex(&mut self, v: u32) -> (u32, Free) {
        let first = HALVES as u32 * v;
        let own = &mut self.halves[first as usize..first as usize + HALVES];
        own[0] = Half { next: first, previous: first, end: v };
        own[1] = Half { next: first + 1, previous: first + 1, end: v };
        (first, unused(&mut own[2..], first + 2))
    }

    /// Makes the half-edges of two vertices, `v` and the next one: an edge between them.
    #[inline(always)]
    pub(super) fn start_edge(&mut self, v: u32) -> (u32, Free) {
        let first = HALVES as u32 * v;
        let own = &mut self.halves[first as usize..first as usize + 2 * HALVES];
        own[0] = Half { next: first, previous: first, end: v + 1 };
        own[1] = Half { next: first + 1, previous: first + 1, end: v };
        (first, unused(&mut own[2..], first + 2))
    }

    /// Makes the half-edges of three vertices from `v` on: a triangle with these corners, counter-clockwise. The first
    /// half-edge of each pair leaves the corners in this order.
    #[inline(always)]
    pub(super) fn start_triangle(&mut self, v: u32, [a, b, c]: [u32; 3]) -> (u32, Free) {
        let first = HALVES as u32 * v;
        let own = &mut self.halves[first as usize..first as usize + 3 * HALVES];
        let only = |other: u32, end: u32| Half { next: first + other, previous: first + other, end };
        own[..6].copy_from_slice(&[only(5, b), only(2, a), only(1, c), only(4, b), only(3, a), only(0, c)]);
        (first, unused(&mut own[6..], first + 6))
    }

    /// Puts half-edge `e`, which leads to `end`, between two neighbours of the circle around its origin.
    #[inline(always)]
    pub(super) fn insert(&mut self, e: u32, end: u32, previous: u32, next: u32) {
        self.halves[previous as usize].next = e;
        self.halves[next as usize].previous = e;
        self.halves[e as usize] = Half { next, previous, end };
    }

    /// Makes half-edge `e`, which leads to `end`, the only half-edge of its origin.
    #[inline(always)]
    pub(super) fn alone(&mut self, e: u32, end: u32) {
        self.halves[e as usize] = Half { next: e, previous: e, end };
    }

    /// Takes an unused pair. There is always one, because a plane graph has fewer edges than three times its vertices.
    #[inline(always)]
    pub(super) fn take(&mut self, free: &mut Free) -> u32 {
        let pair = free.first;
        free.first = self.next(pair);
        pair
    }

    /// Takes an edge out of the circles around both its ends, and makes its pair unused.
    #[inline(always)]
    pub(super) fn remove(&mut self, e: u32, free: &mut Free) {
        for half in [e, e ^ 1] {
            let Half { next, previous, .. } = self.halves[half as usize];
            self.halves[previous as usize].next = next;
            self.halves[next as usize].previous = previous;
        }
        self.give(e & !1, free);
    }

    /// Returns a pair to the unused ones.
    #[inline(always)]
    pub(super) fn give(&mut self, pair: u32, free: &mut Free) {
        self.halves[pair as usize] = Half { next: free.first, previous: NONE, end: UNUSED };
        self.halves[(pair ^ 1) as usize] = Half { next: NONE, previous: NONE, end: UNUSED };
        if free.first == NONE {
            free.last = pair;
        }
        free.first = pair;
    }

    /// Joins two lists of unused pairs.
    #[inline(always)]
    pub(super) fn join(&mut self, one: Free, other: Free) -> Free {
        if one.first == NONE {
            return other;
        }
        self.halves[one.last as usize].next = other.first;
        Free { first: one.first, last: if other.first == NONE { one.last } else { other.last } }
    }
}

/// Links all pairs of a range that begins with half-edge `first` into a list of unused pairs.
#[inline(always)]
fn unused(own: &mut [Half], first: u32) -> Free {
    let last = first + own.len() as u32 - 2;
    for (pair, halves) in (first..).step_by(2).zip(own.chunks_exact_mut(2)) {
        let next = if pair == last { NONE } else { pair + 2 };
        halves[0] = Half { next, previous: NONE, end: UNUSED };
        halves[1] = Half { next: NONE, previous: NONE, end: UNUSED };
    }
    Free { first, last }
}
