//! The straight walk to a place. It ends in every triangulation, also where constraints keep a mesh from being a
//! Delaunay triangulation and a visibility walk could run in circles: each step leads along the line to the place.

use core::cmp::Ordering;

use super::level::Level;
use super::plane::{Side, INFINITE};
use super::walk::Place;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// The first step of the line from a vertex to a place.
enum Step {
    /// Along this edge, to this vertex.
    Along(Side, u32),
    /// Through the triangle whose edge opposite the vertex this is.
    Through(Side),
    /// Out of the hull; the hull edge of this ghost triangle is visible.
    Out(u32),
}

/// The end of a part of the walk.
enum Reached {
    Place(Place),
    /// A vertex on the line, before the place.
    Vertex(u32),
}

impl<P: PlanePoint> Level<P> {
    /// Finds a place, from a vertex if there is one near.
    pub(super) fn find_straight(&self, q: P::Site, from: Option<u32>) -> Place {
        let Some(mut vertex) = from.or_else(|| self.any_vertex()).filter(|_| self.is_plane()) else {
            return self.find(q, None);
        };
        loop {
            let site = self.site(vertex);
            if site == q {
                return Place::Vertex(vertex);
            }
            let reached = match self.first_step(vertex, q) {
                Step::Along(side, next) if P::Site::is_between(site, q, self.site(next)) => {
                    Reached::Place(Place::Edge(side))
                }
                Step::Along(_, next) => Reached::Vertex(next),
                Step::Through(side) => self.walk_through(site, side, q),
                Step::Out(ghost) => Reached::Place(Place::Outside(self.first_visible(ghost, q))),
            };
            match reached {
                Reached::Place(place) => return place,
                Reached::Vertex(next) => vertex = next,
            }
        }
    }

    fn first_step(&self, vertex: u32, q: P::Site) -> Step {
        let site = self.site(vertex);
        let mut out = None;
        for side in self.star(vertex) {
            let [b, c] = self.plane.ends(side);
            if (b == INFINITE || c == INFINITE) && self.is_beyond(side.triangle(), q) {
                out = Some(side.triangle());
            }
            let turn = |end: u32| P::Site::orient2d(site, self.site(end), q);
            if b == INFINITE {
                continue;
            }
            match turn(b) {
                Ordering::Equal if (site < self.site(b)) == (site < q) => {
                    return Step::Along(self.finite_side(side.last()), b);
                }
                Ordering::Greater if c != INFINITE && turn(c).is_lt() => return Step::Through(side),
                _ => {}
            }
        }
        // A direction through no triangle around the vertex and along no edge leaves the hull, so one of the hull edges
        // at the vertex is visible.
        Step::Out(out.unwrap_or(self.plane.ghost))
    }

    /// Walks on from a vertex at `start` through the triangle whose edge opposite the vertex is given.
    fn walk_through(&self, start: P::Site, mut edge: Side, q: P::Site) -> Reached {
        loop {
            let [right, left] = self.plane.ends(edge).map(|vertex| self.site(vertex));
            match P::Site::orient2d(right, left, q) {
                Ordering::Greater => return Reached::Place(Place::Triangle(edge.triangle())),
                Ordering::Equal => return Reached::Place(Place::Edge(edge)),
                Ordering::Less => {}
            }
            let beyond = self.plane.across(edge);
            let apex = self.plane.apex(beyond);
            if apex == INFINITE {
                return Reached::Place(Place::Outside(self.first_visible(beyond.triangle(), q)));
            }
            let site = self.site(apex);
            edge = match P::Site::orient2d(start, q, site) {
                Ordering::Less => beyond.last(),
                Ordering::Greater => beyond.next(),
                Ordering::Equal if P::Site::is_between(start, q, site) => {
                    return Reached::Place(Place::Triangle(beyond.triangle()));
                }
                Ordering::Equal => return Reached::Vertex(apex),
            };
        }
    }
}
