//! A mesh with fixed edges, as the forcing of constraints sees it: the builder's mesh and the mesh that lives share the
//! steps of [`force`](super::force) by this trait.

use alloc::vec::Vec;

use crate::living::plane::{Plane, Side, INFINITE, NEXT};
use crate::site::Site;

/// The triangles are not those of a mesh of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NoMesh;

/// An edge of a chain: its first end, its side outside the chain, and whether it is fixed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub from: u32,
    pub outside: Side,
    pub is_fixed: bool,
}

/// The lists of a step. They are kept from step to step, so that a step allocates nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Work {
    /// The edges that may have to be flipped.
    pub stack: Vec<Side>,
    /// The triangles that the constraint at hand crosses.
    pub crossed: Vec<u32>,
    /// The chains of edges on either side of these triangles.
    pub left: Vec<Link>,
    pub right: Vec<Link>,
    /// The part of a chain that is not filled yet.
    pub chain: Vec<Link>,
    /// Links of a chain whose edges hang into it, and whose other sides have not been met yet.
    pub open: Vec<(usize, [u32; 2])>,
    /// Triangles of no place that stand between the two sides of edges that hang into a chain.
    pub between: Vec<u32>,
}

/// A mesh with ghost triangles, some of whose edges are fixed: no flip removes them.
pub(crate) trait FixedMesh {
    type Site: Site;

    fn site(&self, vertex: u32) -> Self::Site;
    fn plane(&self) -> &Plane;
    fn plane_mut(&mut self) -> &mut Plane;
    fn work(&mut self) -> &mut Work;

    /// Whether the edge is fixed.
    fn is_fixed(&self, side: Side) -> bool;

    /// Fixes an edge, on both of its sides.
    fn fix(&mut self, side: Side);

    /// Writes a triangle, with what lies behind its three sides and whether those edges are fixed.
    fn write(&mut self, triangle: u32, vertices: [u32; 3], links: [(Side, bool); 3]);

    /// One of the triangles at a vertex that is an end of a constraint or of a piece.
    fn triangle_at(&self, vertex: u32) -> u32;

    /// Says in which triangle an end of a piece is.
    fn note(&mut self, vertex: u32, triangle: u32);

    /// Marks a triangle that a constraint crosses, until it is written.
    fn mark_crossed(&mut self, triangle: u32);

    /// Whether a triangle has the mark of [`mark_crossed`](Self::mark_crossed).
    fn is_crossed(&self, triangle: u32) -> bool;

    /// A triangle of no place, whose sides are still to be linked and whose edges are free. It has an infinite vertex.
    fn take_spare(&mut self) -> u32;

    /// Gives a triangle of no place back.
    fn give_spare(&mut self, triangle: u32);

    /// The sides opposite a vertex in the triangles around it, counter-clockwise from the triangle `first`, those of
    /// ghost triangles left out. No side comes twice, so the walk ends on any list of triangles.
    fn around(&self, vertex: u32, first: u32) -> impl Iterator<Item = Side> + '_ {
        let plane = self.plane();
        let opposite = move |triangle: u32| {
            let record = plane.get(triangle);
            let slot = record.slot_of(vertex);
            (record.vertices[slot] == vertex).then(|| Side::new(triangle, slot))
        };
        let mut left = plane.len();
        let next = move |side: &Side| {
            left = left.checked_sub(1)?;
            let next = plane.across(Side::new(side.triangle(), NEXT[side.slot()])).triangle();
            (next != first).then(|| opposite(next))?
        };
        let all = core::iter::successors(opposite(first), next);
        all.filter(|side| plane.get(side.triangle()).infinite_slot().is_none())
    }

    /// Whether a triangle is a ghost triangle.
    fn is_ghost(&self, triangle: u32) -> bool {
        self.plane().get(triangle).vertices.contains(&INFINITE)
    }

    /// Both ends of an edge in rising order.
    fn edge(&self, side: Side) -> [u32; 2] {
        let [a, b] = self.plane().ends(side);
        [a.min(b), a.max(b)]
    }

    /// Flips edges until the mesh is canonical. All edges that may have to be flipped are on the stack.
    ///
    /// # Errors
    /// A flip would turn a triangle over, which happens in no mesh.
    fn repair(&mut self) -> Result<(), NoMesh> {
        while let Some(side) = self.work().stack.pop() {
            if self.must_flip(side) {
                self.flip(side)?;
            }
        }
        Ok(())
    }

    /// Whether the edge is free, inside the hull, and not one of the canonical mesh.
    #[inline]
    fn must_flip(&self, side: Side) -> bool {
        let plane = self.plane();
        let (apex, triangle) = (plane.apex(plane.across(side)), plane.get(side.triangle()));
        let is_free = !self.is_fixed(side) && apex != INFINITE && triangle.infinite_slot().is_none();
        is_free && Self::Site::conflicts(triangle.vertices.map(|vertex| self.site(vertex)), self.site(apex))
    }

    /// Replaces an edge by the other diagonal, and puts the four edges around both triangles on the stack.
    ///
    /// ```text
    ///      p            p
    ///     / \          /|\
    ///    a---b   ->   a | b
    ///     \ /          \|/
    ///      q            q
    /// ```
    fn flip(&mut self, side: Side) -> Result<(), NoMesh> {
        let plane = self.plane();
        let other = plane.across(side);
        let ([a, b], p, q) = (plane.ends(side), plane.apex(side), plane.apex(other));
        // On the triangles of a mesh this always holds. On any others, flips shrink the sum of the areas or lower the
        // lifted surface, so they end.
        let is_left = |corners: [u32; 3]| {
            let [one, two, three] = corners.map(|vertex| self.site(vertex));
            Self::Site::orient2d(one, two, three).is_gt()
        };
        if !is_left([p, a, q]) || !is_left([q, b, p]) {
            return Err(NoMesh);
        }
        let [bp, pa, aq, qb] = [side.next(), side.last(), other.next(), other.last()]
            .map(|side| (plane.across(side), self.is_fixed(side)));
        let (one, two) = (side.triangle(), other.triangle());
        let (new, back) = (Side::new(one, 1), Side::new(two, 1));
        self.write(one, [p, a, q], [aq, (back, false), pa]);
        self.write(two, [q, b, p], [bp, (new, false), qb]);
        let around = [Side::new(one, 0), Side::new(one, 2), Side::new(two, 0), Side::new(two, 2)];
        self.work().stack.extend(around);
        Ok(())
    }
}
