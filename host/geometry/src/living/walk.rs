//! The visibility walk to a place, from a vertex near it.
//!
//! The walk goes from triangle to triangle across an edge that has the place strictly on its far side. It ends in every
//! Delaunay triangulation, in whatever order the edges are looked at, because the power of the place with respect to
//! the circumcircles falls at each step (De Floriani, Falcidieno, Nagy and Pienovi, *On sorting triangles in a Delaunay
//! tessellation*, 1991).

use core::cmp::Ordering;

use super::level::Level;
use super::plane::{Side, INFINITE, LAST, NEXT};
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// The vertex, edge or triangle at a place of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A vertex.
    Vertex(u32),
    /// In the middle of an edge, on the side of a triangle that is no ghost triangle.
    Edge(Side),
    /// Inside a triangle.
    Triangle(u32),
    /// Outside the hull. The hull edge of the ghost triangle is visible, and the one before it is not.
    Outside(u32),
    /// Between two neighbours on the line of all vertices.
    Between(u32, u32),
    /// Elsewhere, while there are no triangles.
    Nowhere,
}

impl<P: PlanePoint> Level<P> {
    /// Finds a place, from a vertex if there is one near.
    #[inline]
    pub fn find(&self, q: P::Site, from: Option<u32>) -> Place {
        match from.or_else(|| self.any_vertex()) {
            Some(vertex) if self.is_plane() => self.walk(q, vertex),
            _ => self.find_on_line(q),
        }
    }

    fn walk(&self, q: P::Site, from: u32) -> Place {
        let start = self.finite_side(self.side_opposite(from));
        let [left, right] = self.plane.ends(start).map(|vertex| self.site(vertex));
        let turn = P::Site::orient2d(left, right, q);
        if turn.is_lt() {
            return self.walk_on(self.plane.across(start), [right, left], q, Ordering::Greater);
        }
        self.walk_on(start, [left, right], q, turn)
    }

    /// A side of a triangle that is no ghost triangle, near the given one.
    #[inline]
    pub(super) fn finite_side(&self, side: Side) -> Side {
        match self.plane.get(side.triangle()).infinite_slot() {
            Some(slot) => self.plane.across(Side::new(side.triangle(), slot)),
            None => side,
        }
    }

    /// Walks on from a triangle that was entered across the edge of `side`. `left` and `right` are the ends of that
    /// edge, as the walk sees them on its way in. `turn` is `Equal` if the place lies on the line of that edge.
    #[inline]
    fn walk_on(&self, mut side: Side, [mut left, mut right]: [P::Site; 2], q: P::Site, mut turn: Ordering) -> Place {
        loop {
            let triangle = self.plane.get(side.triangle());
            let slot = side.slot();
            let apex = triangle.vertices[slot];
            if apex == INFINITE {
                return Place::Outside(self.first_visible(side.triangle(), q));
            }
            let top = self.site(apex);
            let right_turn = P::Site::orient2d(right, top, q);
            if right_turn.is_lt() {
                (side, left, turn) = (triangle.across[NEXT[slot]], top, Ordering::Greater);
                continue;
            }
            let left_turn = P::Site::orient2d(top, left, q);
            if left_turn.is_lt() {
                (side, right, turn) = (triangle.across[LAST[slot]], top, Ordering::Greater);
                continue;
            }
            return self.end(side, [turn, right_turn, left_turn]);
        }
    }

    /// The place in the triangle of `side`, given whether it lies on the line of each edge, that of `side` first.
    fn end(&self, side: Side, turns: [Ordering; 3]) -> Place {
        let sides = [side, side.next(), side.last()];
        match turns.map(Ordering::is_eq) {
            [false, false, false] => Place::Triangle(side.triangle()),
            [true, false, false] => Place::Edge(sides[0]),
            [false, true, false] => Place::Edge(sides[1]),
            [false, false, true] => Place::Edge(sides[2]),
            // On the lines of two edges: the vertex opposite the third.
            [false, ..] => Place::Vertex(self.plane.apex(sides[0])),
            [_, false, _] => Place::Vertex(self.plane.apex(sides[1])),
            [..] => Place::Vertex(self.plane.apex(sides[2])),
        }
    }

    /// The first ghost triangle, counter-clockwise, of those whose edges are visible, given one of them.
    pub(super) fn first_visible(&self, mut ghost: u32, q: P::Site) -> u32 {
        loop {
            let before = self.plane.last_ghost(ghost);
            if !self.is_beyond(before, q) {
                return ghost;
            }
            ghost = before;
        }
    }

    fn find_on_line(&self, q: P::Site) -> Place {
        if let Some(&vertex) = self.line.get(&q) {
            return Place::Vertex(vertex);
        }
        let (before, after) = (self.line.range(..q).next_back(), self.line.range(q..).next());
        match (before, after) {
            (Some((&a, &one)), Some((&b, &other))) if P::Site::orient2d(a, b, q).is_eq() => Place::Between(one, other),
            _ => Place::Nowhere,
        }
    }

    /// A vertex near a place, given what it is there. Any answer would be right.
    pub fn vertex_near(&self, q: P::Site, place: Place) -> Option<u32> {
        let nearest = |vertices: &[u32]| {
            let distance = |&vertex: &u32| self.site(vertex).rough_distance(q);
            vertices.iter().copied().min_by(|one, other| distance(one).total_cmp(&distance(other)))
        };
        match place {
            Place::Vertex(vertex) | Place::Between(vertex, _) => Some(vertex),
            Place::Triangle(triangle) => nearest(&self.plane.get(triangle).vertices),
            Place::Edge(side) => nearest(&self.plane.ends(side)),
            Place::Outside(ghost) => nearest(&self.plane.hull_edge(ghost, self.plane.get(ghost).slot_of(INFINITE))),
            Place::Nowhere => self.line.range(..q).next_back().map(|(_, &vertex)| vertex).or_else(|| self.any_vertex()),
        }
    }
}
