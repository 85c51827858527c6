//! A mesh of half-edges, some of which are fixed.
//!
//! A flag in the `end` of a half-edge, [`FIXED`], says that a constraint fixes the edge. [`GAP`] says that the outside
//! of the hull lies to the left. While a constraint is forced, [`INNER`] says that flips may replace the edge.

use alloc::vec::Vec;
use core::hint::black_box;
use core::ops::Range;

use crate::cpu::edges::{is_used, Half, Halves, HALVES};
use crate::cpu::kernel::Kernel;
use crate::pages;

/// Marks, in the `end` of a half-edge, that the outside lies to the left of the half-edge.
pub(super) const GAP: u32 = <[Half] as Halves>::GAP;
/// Marks, in the `end` of both halves of an edge, that a constraint fixes the edge. A vertex has a number below 2^29.
pub(super) const FIXED: u32 = GAP >> 1;
/// Marks, in the `end` of both halves of an edge, that the edge is new and inside the room of the constraint that is
/// being forced.
pub(super) const INNER: u32 = FIXED >> 1;
/// The bits of `end` that number a vertex.
pub(super) const VERTEX: u32 = INNER - 1;

/// A mesh of half-edges, some of which are fixed: no flip removes them.
pub(super) struct Fixed<'a, K: Kernel> {
    pub(super) sites: &'a [K::Site],
    pub(super) halves: &'a mut [Half],
    /// One of the half-edges that leave each vertex.
    pub(super) at: Vec<u32>,
    /// The fixed edges, by the numbers of their pairs.
    pub(super) fixed: Vec<u32>,
    /// The lists of a step, kept so that a step allocates nothing: the edges that may have to be flipped, the edges
    /// that a constraint crosses, the chains of edges on either side of them, and the part of a chain that is not
    /// filled yet.
    pub(super) stack: Vec<u32>,
    pub(super) crossed: Vec<u32>,
    pub(super) right: Vec<u32>,
    pub(super) left: Vec<u32>,
    pub(super) open: Vec<u32>,
}

/// An edge of the mesh, and the constraint that it is a part of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) edge: u32,
    pub(super) constraint: u32,
}

impl<'a, K: Kernel> Fixed<'a, K> {
    /// Takes the mesh of sites that are not all on one line. The half-edges along the outside have the mark [`GAP`].
    pub(super) fn new(sites: &'a [K::Site], halves: &'a mut [Half]) -> Self {
        let mut at = pages::zeros(sites.len());
        for (pair, two) in (0u32..).zip(halves.as_chunks::<2>().0) {
            let ends = two.map(|half| half.end & VERTEX);
            if is_used(ends) {
                at[ends[1] as usize] = 2 * pair;
                at[ends[0] as usize] = 2 * pair + 1;
            }
        }
        let [fixed, stack, crossed, right, left, open] = [(); 6].map(|()| Vec::new());
        Self { sites, halves, at, fixed, stack, crossed, right, left, open }
    }

    /// Takes the marks [`FIXED`] away, as the steps that follow do not know them.
    pub(super) fn unmark(self) {
        for pair in self.fixed {
            self.halves[pair as usize].end &= !FIXED;
            self.halves[pair as usize ^ 1].end &= !FIXED;
        }
    }

    /// Reads the half-edges of some vertices one after the other, so that they are in the cache afterwards. The
    /// processor sees such a sequence coming, but none of the scattered reads of a constraint.
    pub(super) fn fetch(&self, vertices: Range<usize>) {
        let all = self.halves.len();
        let own = &self.halves[(HALVES * vertices.start).min(all)..(HALVES * vertices.end).min(all)];
        // Five half-edges are a little less than a line of the cache.
        black_box(own.iter().step_by(5).fold(0, |sum, half| sum ^ half.end));
    }

    #[inline(always)]
    pub(super) fn half(&self, e: u32) -> Half {
        self.halves[e as usize]
    }

    /// The vertex at which a half-edge ends.
    #[inline(always)]
    pub(super) fn end(&self, e: u32) -> u32 {
        self.half(e).end & VERTEX
    }

    /// The vertex at which a half-edge begins.
    #[inline(always)]
    pub(super) fn origin(&self, e: u32) -> u32 {
        self.end(e ^ 1)
    }

    #[inline(always)]
    pub(super) fn site(&self, vertex: u32) -> K::Site {
        self.sites[vertex as usize]
    }

    #[inline(always)]
    pub(super) fn is_fixed(&self, e: u32) -> bool {
        self.half(e).end & FIXED != 0
    }

    /// Whether the edge is new, so that flips may replace it while a constraint is forced.
    #[inline(always)]
    pub(super) fn is_inner(&self, e: u32) -> bool {
        self.half(e).end & INNER != 0
    }

    /// Takes the mark [`INNER`] away from an edge.
    #[inline(always)]
    pub(super) fn settle(&mut self, e: u32) {
        self.halves[e as usize].end &= !INNER;
        self.halves[e as usize ^ 1].end &= !INNER;
    }

    /// Whether the outside of the hull lies to the left of a half-edge.
    #[inline(always)]
    pub(super) fn is_outside(&self, e: u32) -> bool {
        self.half(e).end & GAP != 0
    }

    /// Fixes an edge.
    pub(super) fn fix(&mut self, e: u32) {
        if !self.is_fixed(e) {
            self.halves[e as usize].end |= FIXED;
            self.halves[e as usize ^ 1].end |= FIXED;
            self.fixed.push(e & !1);
        }
    }

    /// The half-edge that follows `e` around the triangle to its left.
    #[inline(always)]
    pub(super) fn follower(&self, e: u32) -> u32 {
        self.half(e ^ 1).previous
    }

    /// Takes a half-edge out of the circle around its origin, which has others.
    #[inline(always)]
    pub(super) fn unlink(&mut self, e: u32, origin: u32) {
        let Half { next, previous, .. } = self.half(e);
        self.halves[previous as usize].next = next;
        self.halves[next as usize].previous = previous;
        self.at[origin as usize] = next;
    }

    /// Puts a half-edge between two neighbours of the circle around its origin.
    #[inline(always)]
    pub(super) fn insert(&mut self, e: u32, end: u32, previous: u32, next: u32) {
        self.halves[previous as usize].next = e;
        self.halves[next as usize].previous = e;
        self.halves[e as usize] = Half { next, previous, end };
    }
}
