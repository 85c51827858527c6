//! Moving vertices in place: as long as all triangles still turn left, flips lead back to the one canonical mesh.
//!
//! Source: Lawson, *Software for C1 surface interpolation*, 1977. The mesh is the lower hull of the lifted points, and
//! each flip lowers the lifted surface, so flips end at that hull, in whatever order they are made.

use super::level::Level;
use super::plane::{Side, INFINITE};
use crate::plane_point::PlanePoint;
use crate::site::Site;

impl<P: PlanePoint> Level<P> {
    /// Moves a vertex if its star stays a star and it is not on the hull; says whether it has moved.
    pub(super) fn shift(&mut self, vertex: u32, point: P) -> bool {
        let has_moved = self.shift_in_star(vertex, point);
        if has_moved {
            self.repair();
        }
        has_moved
    }

    /// The same without the flips: the edges that may have to be flipped are then on the stack.
    pub(super) fn shift_in_star(&mut self, vertex: u32, point: P) -> bool {
        if !self.is_plane() {
            return false;
        }
        self.collect_star(vertex);
        let q = point.site();
        let turns_left = |edge: usize| {
            let ends = [edge, (edge + 1) % self.border.len()];
            let is_finite = ends.iter().all(|&place| self.border[place].from != INFINITE);
            is_finite && P::Site::orient2d(self.ring[ends[0]], self.ring[ends[1]], q).is_gt()
        };
        if !(0..self.border.len()).all(turns_left) {
            return false;
        }
        self.vertices[vertex as usize].point = point;
        self.stack.clear();
        for edge in &self.border {
            let inside = self.plane.across(edge.outside);
            self.stack.extend([inside, inside.next()]);
        }
        true
    }

    /// Flips edges until the mesh is canonical. All edges that may have to be flipped are on the stack.
    pub(super) fn repair(&mut self) {
        while let Some(side) = self.stack.pop() {
            if self.must_flip(side) {
                self.flip(side);
            }
        }
    }

    /// Whether the edge is inside the hull and not one of the canonical mesh.
    #[inline]
    pub(super) fn must_flip(&self, side: Side) -> bool {
        let other = self.plane.across(side);
        let (apex, triangle) = (self.plane.apex(other), self.plane.get(side.triangle()));
        let is_inside = apex != INFINITE && triangle.infinite_slot().is_none();
        is_inside && P::Site::conflicts(triangle.vertices.map(|vertex| self.site(vertex)), self.site(apex))
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
    pub(super) fn flip(&mut self, side: Side) {
        let other = self.plane.across(side);
        let ([a, b], p, q) = (self.plane.ends(side), self.plane.apex(side), self.plane.apex(other));
        let [bp, pa] = [side.next(), side.last()].map(|side| self.plane.across(side));
        let [aq, qb] = [other.next(), other.last()].map(|side| self.plane.across(side));
        let (one, two) = (side.triangle(), other.triangle());
        let (new, back) = (Side::new(one, 1), Side::new(two, 1));
        self.plane.set(one, [p, a, q], [aq, back, pa]);
        self.plane.set(two, [q, b, p], [bp, new, qb]);
        let around = [Side::new(one, 0), Side::new(one, 2), Side::new(two, 0), Side::new(two, 2)];
        for (inside, outside) in around.into_iter().zip([aq, pa, bp, qb]) {
            self.plane.link(inside, outside);
        }
        // Both apexes are still in the triangle that they had.
        self.note(a, one);
        self.note(b, two);
        self.stack.extend(around);
    }
}
