//! Going through the mesh: vertices, edges, triangles, the hull, and what is around a vertex.

use super::error::Error;
use super::level::Level;
use super::plane::{Side, INFINITE};
use super::triangulation::Triangulation;
use crate::mesh::smallest_first;
use crate::plane_point::PlanePoint;

impl<P: PlanePoint> Triangulation<P> {
    /// The places that have points, each by the lowest living index there, in no order that is promised.
    pub fn vertices(&self) -> impl Iterator<Item = u32> + '_ {
        self.base().iter().map(|vertex| self.name(vertex))
    }

    /// All triangles, each counter-clockwise with its smallest index first, in no order that is promised.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let finite = self.shown().plane.iter().filter(|(_, triangle)| triangle.infinite_slot().is_none());
        finite.map(|(_, triangle)| smallest_first(triangle.vertices.map(|vertex| self.name(vertex))))
    }

    /// All edges, each once with the smaller index first, in no order that is promised. While all points lie on one
    /// line, neighbours on the line have an edge.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from([[0, 0], [4, 0], [2, 0]])?;
    /// assert!(mesh.edges().eq([[0, 2], [1, 2]]));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let base = self.shown();
        let sides = base.plane.iter().flat_map(|(triangle, _)| (0..3).map(move |slot| Side::new(triangle, slot)));
        let ends = sides.map(|side| base.plane.ends(side)).filter(|&[from, to]| from < to && to != INFINITE);
        let line = base.line.values().zip(base.line.values().skip(1)).map(|(&one, &other)| [one, other]);
        ends.chain(line).map(|ends| {
            let [one, other] = ends.map(|vertex| self.name(vertex));
            [one.min(other), one.max(other)]
        })
    }

    /// The vertices of the hull, counter-clockwise, the smallest index first; points in the middle of a hull edge are
    /// among them. While all points lie on one line, all places in lexicographic order. O(h) for `h` of them, beside
    /// the iteration.
    pub fn hull(&self) -> impl Iterator<Item = u32> + '_ {
        let base = self.shown();
        let ghosts = || base.ghosts(base.plane.ghost);
        let first = ghosts().min_by_key(|&ghost| self.name(base.hull_vertex(ghost)));
        let corners = first.into_iter().flat_map(|first| base.ghosts(first)).map(|ghost| base.hull_vertex(ghost));
        corners.chain(base.line.values().copied()).map(|vertex| self.name(vertex))
    }

    /// The vertices that have an edge to the place of a point, counter-clockwise. The first is the next one on the
    /// hull, or the smallest index if the place is inside the hull. While all points lie on one line: the neighbours on
    /// the line, in lexicographic order.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from([[0, 0], [4, 0], [4, 4], [0, 4], [2, 1]])?;
    /// assert!(mesh.neighbors(4)?.eq([0, 1, 2, 3]));
    /// assert!(mesh.neighbors(0)?.eq([1, 4, 3]));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    ///
    /// # Errors
    /// No living point has the index.
    pub fn neighbors(&self, index: u32) -> Result<impl Iterator<Item = u32> + '_, Error> {
        let vertex = self.vertex(index)?;
        let base = self.shown();
        let ring = self.star_from_first(vertex).map(|side| base.plane.ends(side)[0]);
        let (before, after) = base.beside_on_line(vertex);
        let all = before.into_iter().chain(after).chain(ring.filter(|&vertex| vertex != INFINITE));
        Ok(all.map(|vertex| self.name(vertex)))
    }

    /// The triangles around the place of a point, counter-clockwise, each with the place first. They begin as
    /// [`neighbors`](Self::neighbors) does.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from([[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// assert!(mesh.star(2)?.eq([[2, 3, 0], [2, 0, 1]]));
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    ///
    /// # Errors
    /// No living point has the index.
    pub fn star(&self, index: u32) -> Result<impl Iterator<Item = [u32; 3]> + '_, Error> {
        let vertex = self.vertex(index)?;
        let ends = self.star_from_first(vertex).map(|side| self.shown().plane.ends(side));
        let finite = ends.filter(|ends| !ends.contains(&INFINITE));
        Ok(finite.map(move |[from, to]| [vertex, from, to].map(|vertex| self.name(vertex))))
    }

    /// The sides opposite a vertex, counter-clockwise, from the one at which the answers about the vertex begin. None
    /// while all vertices lie on one line.
    fn star_from_first(&self, vertex: u32) -> impl Iterator<Item = Side> + '_ {
        let base = self.shown();
        let rank = |&side: &Side| match base.plane.ends(side) {
            // The ghost triangle before the first triangle of a vertex on the hull.
            [INFINITE, _] => None,
            [from, _] => Some(self.name(from)),
        };
        let is_on_hull = |side: &Side| rank(side).is_none();
        let all = || base.is_plane().then(|| base.star(vertex)).into_iter().flatten();
        let first = match all().find(is_on_hull) {
            Some(ghost) => Some(base.plane.across(ghost.next()).next()),
            None => all().min_by_key(rank),
        };
        first.into_iter().flat_map(|first| base.star_from(first))
    }
}

impl<P: PlanePoint> Level<P> {
    /// All vertices.
    pub(super) fn iter(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.vertices.len() as u32).filter(|&vertex| self.is_vertex(vertex))
    }

    /// The ghost triangles, counter-clockwise, from one of them; none while there are no triangles.
    pub(super) fn ghosts(&self, first: u32) -> impl Iterator<Item = u32> + '_ {
        core::iter::successors(self.is_plane().then_some(first), move |&ghost| {
            Some(self.plane.next_ghost(ghost)).filter(|&next| next != first)
        })
    }

    /// The vertex at which the hull edge of a ghost triangle begins.
    pub(super) fn hull_vertex(&self, ghost: u32) -> u32 {
        self.plane.hull_edge(ghost, self.plane.get(ghost).slot_of(INFINITE))[0]
    }

    /// The neighbours of a vertex on the line of all vertices; none while there are triangles.
    pub(super) fn beside_on_line(&self, vertex: u32) -> (Option<u32>, Option<u32>) {
        if self.is_plane() {
            return (None, None);
        }
        let site = self.site(vertex);
        let before = self.line.range(..site).next_back();
        let after = self.line.range(site..).nth(1);
        (before.map(|entry| *entry.1), after.map(|entry| *entry.1))
    }

    /// The vertices that have an edge to this one.
    pub(super) fn adjacent(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let (before, after) = self.beside_on_line(vertex);
        let ring = self.is_plane().then(|| self.link(vertex)).into_iter().flatten();
        before.into_iter().chain(after).chain(ring.filter(|&vertex| vertex != INFINITE))
    }
}
