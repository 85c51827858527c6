//! Constraints in the mesh of the CPU triangulator, before it is brought into canonical form.
//!
//! The vertices have their numbers along the curve here, and the edges of a neighbourhood lie close together in
//! memory. So constraints are forced many times faster than in a list of triangles, whose order is that of the input.
//! Vertices are taken in the order of the curve, too. `force` brings a constraint in, and `flips` makes the edges
//! around it locally Delaunay. Then `parts` floods the parts of the plane between the constraints, and `domain` takes the
//! triangles of those that are wanted.
//!
//! A flag in the `end` of a half-edge, [`FIXED`], says that a constraint fixes the edge. [`GAP`] says that the outside
//! of the hull lies to the left.

mod connect;
mod domain;
mod flips;
mod force;
mod parts;
mod turn;

use alloc::vec::Vec;

use super::edges::{is_used, Half, Halves};
use super::kernel::Kernel;
use crate::pages;
use crate::sort::{sort_by_key, Keyed};

pub(crate) use connect::{connect_fixed, Asked, Forced};
use force::Stop;

/// Marks, in the `end` of a half-edge, that the outside lies to the left of the half-edge.
pub(super) const GAP: u32 = <[Half] as Halves>::GAP;
/// Marks, in the `end` of both halves of an edge, that a constraint fixes the edge. A vertex has a number below 2^29.
pub(super) const FIXED: u32 = GAP >> 1;
/// The bits of `end` that number a vertex.
pub(super) const VERTEX: u32 = FIXED - 1;

/// A mesh of half-edges, some of which are fixed: no flip removes them.
pub(super) struct Fixed<'a, K: Kernel> {
    sites: &'a [K::Site],
    halves: &'a mut [Half],
    /// One of the half-edges that leave each vertex.
    at: Vec<u32>,
    /// The fixed edges, by the numbers of their pairs.
    fixed: Vec<u32>,
    /// The lists of a step, kept so that a step allocates nothing: the edges that may have to be flipped, the edges
    /// that a constraint crosses, the chains of edges on either side of them, and the part of a chain that is not filled
    /// yet.
    stack: Vec<u32>,
    crossed: Vec<u32>,
    right: Vec<u32>,
    left: Vec<u32>,
    open: Vec<u32>,
}

/// An edge of the mesh, and the constraint that it is a part of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) edge: u32,
    pub(super) constraint: u32,
}

/// A constraint, by the place on the curve at which it is forced.
#[derive(Clone, Copy, bytemuck::Zeroable)]
struct Turned {
    first: u32,
    constraint: u32,
}

impl Keyed for Turned {
    #[inline(always)]
    fn key(&self) -> u64 {
        self.first.into()
    }
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

    /// Forces all constraints in, given by the vertices at their ends, as far as there is room for `most` parts.
    ///
    /// # Errors
    /// Two constraints cross at a place that is not a vertex, or there are too many parts.
    pub(super) fn force_all(&mut self, ends: &[[u32; 2]], most: usize) -> Result<Vec<Part>, Stop> {
        let turned = |(constraint, [a, b]): (u32, &[u32; 2])| Turned { first: *a.min(b), constraint };
        let mut order: Vec<Turned> = (0..).zip(ends).map(turned).collect();
        sort_by_key(&mut order);
        let mut parts = Vec::with_capacity(ends.len());
        for Turned { constraint, .. } in order {
            let mut rest = ends[constraint as usize];
            while rest[0] != rest[1] {
                let (edge, left) = self.step(rest)?;
                if parts.len() == most {
                    return Err(Stop::TooManyParts);
                }
                parts.push(Part { edge, constraint });
                rest = left;
            }
        }
        Ok(parts)
    }

    /// Takes the marks [`FIXED`] away, as the steps that follow do not know them.
    pub(super) fn unmark(self) {
        for pair in self.fixed {
            self.halves[pair as usize].end &= !FIXED;
            self.halves[pair as usize ^ 1].end &= !FIXED;
        }
    }

    #[inline(always)]
    fn half(&self, e: u32) -> Half {
        self.halves[e as usize]
    }

    /// The vertex at which a half-edge ends.
    #[inline(always)]
    fn end(&self, e: u32) -> u32 {
        self.half(e).end & VERTEX
    }

    /// The vertex at which a half-edge begins.
    #[inline(always)]
    fn origin(&self, e: u32) -> u32 {
        self.end(e ^ 1)
    }

    #[inline(always)]
    fn site(&self, vertex: u32) -> K::Site {
        self.sites[vertex as usize]
    }

    #[inline(always)]
    fn is_fixed(&self, e: u32) -> bool {
        self.half(e).end & FIXED != 0
    }

    /// Whether the outside of the hull lies to the left of a half-edge.
    #[inline(always)]
    fn is_outside(&self, e: u32) -> bool {
        self.half(e).end & GAP != 0
    }

    /// Fixes an edge.
    fn fix(&mut self, e: u32) {
        if !self.is_fixed(e) {
            self.halves[e as usize].end |= FIXED;
            self.halves[e as usize ^ 1].end |= FIXED;
            self.fixed.push(e & !1);
        }
    }

    /// The half-edge that follows `e` around the triangle to its left.
    #[inline(always)]
    fn follower(&self, e: u32) -> u32 {
        self.half(e ^ 1).previous
    }

    /// Takes a half-edge out of the circle around its origin, which has others.
    #[inline(always)]
    fn unlink(&mut self, e: u32, origin: u32) {
        let Half { next, previous, .. } = self.half(e);
        self.halves[previous as usize].next = next;
        self.halves[next as usize].previous = previous;
        self.at[origin as usize] = next;
    }

    /// Puts a half-edge between two neighbours of the circle around its origin.
    #[inline(always)]
    fn insert(&mut self, e: u32, end: u32, previous: u32, next: u32) {
        self.halves[previous as usize].next = e;
        self.halves[next as usize].previous = e;
        self.halves[e as usize] = Half { next, previous, end };
    }
}
