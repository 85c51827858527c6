//! The triangles that a straight line crosses.

use alloc::vec::Vec;

use super::plane::{Side, INFINITE};
use super::triangulation::Triangulation;
use super::walk::Place;
use crate::mesh::smallest_first;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// The position of a walk along a segment.
#[derive(Clone, Copy)]
enum At {
    /// At a vertex before the end of the segment.
    Vertex(u32),
    /// Before the inside of a triangle.
    Triangle(u32),
}

impl<P: PlanePoint> Triangulation<P> {
    /// The triangles whose inside the straight line from `a` to `b` crosses, in the order in which it does; each
    /// counter-clockwise with its smallest index first. Both ends may lie anywhere.
    ///
    /// A stretch along an edge crosses neither of the triangles beside it. None while all points lie on one line, or if
    /// a coordinate is infinite or not a number. O(t) for the triangles that the line touches, beside the search for
    /// `a`, and O(h) for the hull if `a` is outside.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from([[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// assert_eq!(mesh.segment([-1, 2], [5, 2]), [[0, 2, 3], [0, 1, 2]]);
    /// assert!(mesh.segment([0, 0], [4, 4]).is_empty());
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn segment(&self, a: P, b: P) -> Vec<[u32; 3]> {
        let (a, b, base) = (a.site(), b.site(), self.shown());
        let mut crossed = Vec::new();
        if !a.is_finite() || !b.is_finite() || !base.is_plane() {
            return crossed;
        }
        let walk = Crossing { mesh: self, a, b };
        let mut at = walk.start();
        while let Some(now) = at {
            at = match now {
                At::Vertex(vertex) => walk.leave_vertex(vertex),
                At::Triangle(triangle) => {
                    let vertices = base.plane.get(triangle).vertices;
                    crossed.push(smallest_first(vertices.map(|vertex| self.name(vertex))));
                    walk.leave_triangle(triangle)
                }
            };
        }
        crossed
    }
}

/// A walk from `a` to `b`.
struct Crossing<'m, P: PlanePoint> {
    mesh: &'m Triangulation<P>,
    a: P::Site,
    b: P::Site,
}

impl<P: PlanePoint> Crossing<'_, P> {
    fn site(&self, vertex: u32) -> P::Site {
        self.mesh.shown().site(vertex)
    }

    /// The side of the line on which a vertex lies.
    fn turn(&self, vertex: u32) -> core::cmp::Ordering {
        P::Site::orient2d(self.a, self.b, self.site(vertex))
    }

    /// The turn from one vertex over the other to `b`.
    fn turn_to_end(&self, [from, to]: [u32; 2]) -> core::cmp::Ordering {
        P::Site::orient2d(self.site(from), self.site(to), self.b)
    }

    /// A vertex on the line, if it lies before `b`.
    fn at_vertex(&self, vertex: u32) -> Option<At> {
        let site = self.site(vertex);
        (site != self.b && (site == self.a || P::Site::is_between(self.a, site, self.b))).then_some(At::Vertex(vertex))
    }

    /// The triangle of a side, unless it is a ghost triangle.
    fn at_triangle(&self, side: Side) -> Option<At> {
        let is_ghost = self.mesh.shown().plane.get(side.triangle()).infinite_slot().is_some();
        (!is_ghost).then_some(At::Triangle(side.triangle()))
    }

    fn start(&self) -> Option<At> {
        let plane = &self.mesh.shown().plane;
        match self.mesh.find_shown(self.a) {
            Place::Triangle(triangle) => Some(At::Triangle(triangle)),
            Place::Vertex(vertex) => self.at_vertex(vertex),
            // A segment without length that lies in an edge crosses nothing.
            Place::Edge(_) if self.a == self.b => None,
            Place::Edge(side) => {
                let ends = plane.ends(side);
                match self.turn_to_end(ends) {
                    core::cmp::Ordering::Greater => self.at_triangle(side),
                    core::cmp::Ordering::Less => self.at_triangle(plane.across(side)),
                    core::cmp::Ordering::Equal => ends.into_iter().find_map(|end| self.at_vertex(end)),
                }
            }
            Place::Outside(ghost) => self.enter(ghost),
            Place::Between(..) | Place::Nowhere => None,
        }
    }

    /// Enters the hull from outside, given the first of the hull edges that are visible from `a`.
    fn enter(&self, first: u32) -> Option<At> {
        let base = self.mesh.shown();
        for ghost in base.ghosts(first).take_while(|&ghost| base.is_beyond(ghost, self.a)) {
            let slot = base.plane.get(ghost).slot_of(INFINITE);
            let ends = base.plane.hull_edge(ghost, slot);
            let turns = ends.map(|end| self.turn(end));
            if let Some(on) = (0..2).find(|&k| turns[k].is_eq() && self.at_vertex(ends[k]).is_some()) {
                return self.at_vertex(ends[on]);
            }
            if turns[0].is_gt() && turns[1].is_lt() {
                let goes_in = self.turn_to_end(ends).is_gt();
                return goes_in.then(|| At::Triangle(base.plane.across(Side::new(ghost, slot)).triangle()));
            }
        }
        None
    }

    /// Goes on from a triangle whose inside is crossed; `None` if the segment ends in it or on its border.
    fn leave_triangle(&self, triangle: u32) -> Option<At> {
        let plane = &self.mesh.shown().plane;
        for side in (0..3).map(|slot| Side::new(triangle, slot)) {
            let ends = plane.ends(side);
            let turns = ends.map(|end| self.turn(end));
            if turns[0].is_gt() || turns[1].is_lt() || !self.turn_to_end(ends).is_lt() {
                continue;
            }
            return match turns.map(core::cmp::Ordering::is_eq) {
                [true, _] => self.at_vertex(ends[0]),
                [_, true] => self.at_vertex(ends[1]),
                _ => self.at_triangle(plane.across(side)),
            };
        }
        None
    }

    /// Goes on from a vertex: through one of the triangles around it, or along an edge.
    fn leave_vertex(&self, vertex: u32) -> Option<At> {
        let (base, site) = (self.mesh.shown(), self.site(vertex));
        for side in base.star(vertex) {
            let [from, to] = base.plane.ends(side);
            if from == INFINITE {
                continue;
            }
            let turn = self.turn_to_end([vertex, from]);
            if turn.is_eq() && (site < self.site(from)) == (site < self.b) {
                return self.at_vertex(from);
            }
            if turn.is_gt() && to != INFINITE && self.turn_to_end([vertex, to]).is_lt() {
                return Some(At::Triangle(side.triangle()));
            }
        }
        None
    }
}
