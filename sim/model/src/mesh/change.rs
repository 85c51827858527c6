//! Changes of a standing mesh, vertex by vertex. The vertices have the ids that the host chooses.

use super::hole::{Across, RingEdge};
use super::record::Record;
use super::{Changed, Insertion, Mesh};
use crate::predicate::{finite_conflict, orient2d, Point};
use incircle_protocol::Outcome;

impl Mesh {
    /// Inserts a point as this vertex.
    ///
    /// The outcome is `Done`; or the mesh is as before, and it is `Full` for a vertex at or beyond the capacity,
    /// `InUse` for one that is in the mesh, or `Duplicate` with the vertex that has the point. There must be a mesh to
    /// change ([`can_change`](Self::can_change)).
    pub fn insert_as(&mut self, vertex: u32, p: Point) -> Changed {
        if let Some(refusal) = self.refuses_new(vertex) {
            return (refusal, vertex);
        }
        let root = self.walk_to(p);
        if let Some(other) = self.corner_at(root, p) {
            return (Outcome::Duplicate, other);
        }
        if vertex >= self.counts.arrived {
            self.counts.arrived = vertex + 1;
            self.points.resize(self.counts.arrived as usize, Point::default());
            self.is_vertex.resize(self.counts.arrived as usize, false);
        }
        self.put(vertex, p, root)
    }

    /// Why a vertex cannot be inserted, wherever its point lies.
    pub(crate) fn refuses_new(&self, vertex: u32) -> Option<Outcome> {
        match () {
            () if vertex >= self.capacity => Some(Outcome::Full),
            () if self.has_vertex(vertex) => Some(Outcome::InUse),
            () => None,
        }
    }

    /// Deletes a vertex. Its records but two are used again at once; those two become free.
    ///
    /// The outcome is `Done`; or the mesh is as before, and it is `Missing` for a vertex that is not in the mesh,
    /// `ManyNeighbors` for one with more neighbours than the boundary list has entries, or `Flat` for one without which
    /// all points would lie on one line. There must be a mesh to change. O(k^2) for k neighbours, beside the walk.
    pub fn delete(&mut self, vertex: u32) -> Changed {
        if !self.has_vertex(vertex) {
            return (Outcome::Missing, vertex);
        }
        let root = self.walk_to(self.points[vertex as usize]);
        if !self.collect_ring(vertex, root) {
            return (Outcome::ManyNeighbors, vertex);
        }
        (self.close_star(vertex).unwrap_or(Outcome::Done), vertex)
    }

    /// Moves a vertex to another point. If no edge of the mesh changes, only the point is written; else the vertex is
    /// deleted and inserted.
    ///
    /// The outcome is one of [`delete`](Self::delete), or `Duplicate` with the vertex that has the point: then the
    /// vertex has been deleted. There must be a mesh to change.
    pub fn move_to(&mut self, vertex: u32, p: Point) -> Changed {
        if !self.has_vertex(vertex) {
            return (Outcome::Missing, vertex);
        }
        let root = self.walk_to(self.points[vertex as usize]);
        if !self.collect_ring(vertex, root) {
            return (Outcome::ManyNeighbors, vertex);
        }
        if self.points[vertex as usize] == p {
            return (Outcome::Done, vertex);
        }
        // Each triangle of the star is tested against the next, and each record outside against the place.
        self.counts.tests += 2 * self.hole.ring.len() as u32;
        if self.keeps_edges(p) {
            self.points[vertex as usize] = p;
            return (Outcome::Done, vertex);
        }
        if let Some(refusal) = self.close_star(vertex) {
            return (refusal, vertex);
        }
        let root = self.walk_to(p);
        match self.corner_at(root, p) {
            Some(other) => (Outcome::Duplicate, other),
            None => self.put(vertex, p, root),
        }
    }

    /// Whether a vertex is in the mesh.
    pub fn has_vertex(&self, vertex: u32) -> bool {
        self.is_vertex.get(vertex as usize).is_some_and(|&is_vertex| is_vertex)
    }

    /// Puts a vertex into the mesh, whose point this record holds and no vertex has.
    fn put(&mut self, vertex: u32, p: Point, root: u32) -> Changed {
        self.points[vertex as usize] = p;
        let insertion = self.insert_in(vertex, p, root);
        debug_assert_eq!(insertion, Insertion::Inserted, "no vertex has the point");
        (Outcome::Done, vertex)
    }

    /// Whether the mesh keeps its edges if the vertex inside the ring moves to `p`: all triangles of its star still
    /// turn left, no record outside conflicts with `p`, and no triangle of the star with the next but one vertex of the
    /// ring.
    fn keeps_edges(&self, p: Point) -> bool {
        let ring = &self.hole.ring;
        let points: Option<Vec<Point>> = ring.iter().map(|edge| self.finite_point(edge.from)).collect();
        let Some(points) = points else {
            return false;
        };
        let at = |place: usize| points[place % points.len()];
        let turns = |place: usize| orient2d(p, at(place), at(place + 1)) > 0;
        let is_free = |edge: &RingEdge| !self.in_conflict(&self.records[edge.outside as usize], p);
        let is_edge = |place: usize| {
            let before = at(place + points.len() - 1);
            !finite_conflict([p, before, at(place)], at(place + 1))
        };
        (0..points.len()).all(turns) && ring.iter().all(is_free) && (0..points.len()).all(is_edge)
    }

    /// Takes the vertex inside the ring out of the mesh, or says why not.
    fn close_star(&mut self, vertex: u32) -> Option<Outcome> {
        self.fill_hole();
        if self.hole.is_flat(self.infinite) {
            return Some(Outcome::Flat);
        }
        let hole = std::mem::take(&mut self.hole);
        let (ids, free) = hole.ids();
        for (filling, &id) in hole.fillings.iter().zip(&ids) {
            let link = |across: Across| match across {
                Across::Ring(edge) => hole.ring[usize::from(edge)].outside,
                Across::Filling(other, _) => ids[usize::from(other)],
            };
            let v = filling.corners.map(|corner| hole.ring[usize::from(corner)].from);
            self.records[id as usize] = Record { v, n: filling.across.map(link) };
            for across in filling.across {
                if let Across::Ring(edge) = across {
                    let RingEdge { outside, slot, .. } = hole.ring[usize::from(edge)];
                    self.records[outside as usize].n[usize::from(slot)] = id;
                }
            }
        }
        for id in free {
            self.records[id as usize] = Record { v: [self.infinite; 3], n: [ids[0]; 3] };
            self.free.put(id);
        }
        self.starts[0] = ids[0];
        self.hole = hole;
        self.is_vertex[vertex as usize] = false;
        self.deletions += 1;
        None
    }
}
