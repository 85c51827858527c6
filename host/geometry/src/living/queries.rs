//! Questions about places.

use super::plane::{Side, INFINITE};
use super::triangulation::Triangulation;
use super::walk::Place;
use crate::mesh::smallest_first;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// The vertex, edge or triangle at a place of a triangulation, by the indices that name the vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Location {
    /// The place has a point. The index is the lowest of the living points there.
    Vertex(u32),
    /// The place lies in the middle of the edge between two vertices, the smaller index first. On a line of points
    /// without triangles, two neighbours have an edge.
    Edge([u32; 2]),
    /// The place lies inside the triangle of these vertices: counter-clockwise, the smallest index first.
    Triangle([u32; 3]),
    /// The place lies outside the hull. The edge is the first, counter-clockwise, of the hull edges that are visible
    /// from there, and runs counter-clockwise.
    Outside([u32; 2]),
    /// There are no triangles, and the place lies on no edge; or it is no place, because a coordinate is infinite or
    /// not a number.
    None,
}

impl<P: PlanePoint> Triangulation<P> {
    /// Says what a place is: a vertex, or in an edge, a triangle, or outside the hull.
    ///
    /// The place may have any coordinates of its type. O(log n) expected; a few steps if the place is near that of the
    /// last call, so ask for places along a curve. Source: Devillers, *The Delaunay hierarchy*, 2002.
    ///
    /// ```
    /// use incircle_geometry::living::{Location, Triangulation};
    ///
    /// let mesh = Triangulation::from([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])?;
    /// assert_eq!(mesh.locate([0.2, 0.2]), Location::Triangle([0, 1, 2]));
    /// assert_eq!(mesh.locate([0.0, 0.5]), Location::Edge([0, 2]));
    /// assert_eq!(mesh.locate([0.5, -1.0]), Location::Outside([0, 1]));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn locate(&self, point: P) -> Location {
        let q = point.site();
        if !q.is_finite() {
            return Location::None;
        }
        let (base, name) = (self.shown(), |vertex| self.name(vertex));
        let sorted = |[one, other]: [u32; 2]| [one.min(other), one.max(other)];
        match self.find_shown(q) {
            Place::Vertex(vertex) => Location::Vertex(name(vertex)),
            Place::Edge(side) => Location::Edge(sorted(base.plane.ends(side).map(name))),
            Place::Between(one, other) => Location::Edge(sorted([one, other].map(name))),
            Place::Triangle(triangle) => {
                Location::Triangle(smallest_first(base.plane.get(triangle).vertices.map(name)))
            }
            Place::Outside(ghost) => {
                let slot = base.plane.get(ghost).slot_of(INFINITE);
                Location::Outside(base.plane.hull_edge(ghost, slot).map(name))
            }
            Place::Nowhere => Location::None,
        }
    }

    /// The index of the living point nearest to a place; of points at the same distance, the one with the smaller x,
    /// then y. `None` if there are no points, or if a coordinate is infinite or not a number.
    ///
    /// O(log n) expected. While all points lie on one line, up to O(n) for a place off the line.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from([[5, 5], [0, 5], [9, 9]])?;
    /// assert_eq!(mesh.nearest([6, 6]), Some(0));
    /// assert_eq!(mesh.nearest([-4, 7]), Some(1));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn nearest(&self, point: P) -> Option<u32> {
        self.nearest_vertex(point.site()).map(|vertex| self.name(vertex))
    }

    /// The vertex nearest to a place.
    pub(super) fn nearest_vertex(&self, q: P::Site) -> Option<u32> {
        if !q.is_finite() {
            return None;
        }
        let (place, near) = self.find_with_vertex(q);
        let (base, near) = (self.base(), near?);
        let start = match place {
            Place::Vertex(_) => return Some(near),
            Place::Triangle(triangle) => Side::new(triangle, base.plane.get(triangle).slot_of(near)),
            _ if base.is_plane() => base.side_opposite(near),
            _ => return Some(base.nearest(q, near)),
        };
        base.climb(q, start).or_else(|| Some(base.nearest(q, near)))
    }
}
