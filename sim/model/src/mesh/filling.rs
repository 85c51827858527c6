//! Filling the hole that the star of a deleted vertex leaves: gift wrapping.
//!
//! The triangle on an edge of the hole is the one whose circle holds no other vertex of the ring, with the tie rule.
//! That triangle cuts the hole in two, and each part is filled in the same way. The infinite vertex is a member of the
//! ring like others: a ghost triangle stands on an edge from which no vertex lies to the left. A vertex of a uniform
//! set takes 6 tests in the mean; cutting ears off would take 13.

use super::hole::RingEdge;
use super::Mesh;
use crate::predicate::{finite_conflict, orient2d, Point};

impl Mesh {
    /// Collects the ring around a vertex, which `record` names. Returns false if it has more edges than the list.
    pub(super) fn collect_ring(&mut self, vertex: u32, record: u32) -> bool {
        self.hole.ring.clear();
        let mut id = record;
        loop {
            let slot = self.corner_slot(id, vertex);
            let turned = self.records[id as usize].rotated(slot);
            if self.hole.ring.len() == self.cavity.capacity() {
                return false;
            }
            let outside = turned.n[0];
            let across = self.records[outside as usize];
            let (slot, ghost_outside) = (across.slot_of(id) as u8, across.v.contains(&self.infinite));
            self.hole.ring.push(RingEdge { from: turned.v[1], record: id, outside, slot, ghost_outside });
            id = turned.n[1];
            if id == record {
                return true;
            }
        }
    }

    /// The slot of a vertex that the record names.
    pub(super) fn corner_slot(&self, record: u32, vertex: u32) -> usize {
        let v = self.records[record as usize].v;
        usize::from(v[1] == vertex) | usize::from(v[2] == vertex) << 1
    }

    /// Fills the hole inside the ring with two triangles fewer than it has edges.
    pub(super) fn fill_hole(&mut self) {
        let mut hole = std::mem::take(&mut self.hole);
        hole.open();
        while let Some(part) = hole.next_part(self.infinite) {
            let vertices: Vec<u32> = part.iter().map(|corner| hole.vertex(corner)).collect();
            let apex = self.apex_of(&vertices);
            hole.put(&part, apex);
        }
        self.hole = hole;
    }

    /// The place of the apex over the edge between the first two of these vertices, which are finite if there are
    /// more than three.
    fn apex_of(&mut self, vertices: &[u32]) -> usize {
        let mut best = 2;
        for place in 3..vertices.len() {
            self.counts.tests += 1;
            if self.replaces([vertices[0], vertices[1]], vertices[best], vertices[place]) {
                best = place;
            }
        }
        best
    }

    /// Whether `other` is a better apex over the edge than `best`.
    fn replaces(&self, edge: [u32; 2], best: u32, other: u32) -> bool {
        let [a, b] = edge.map(|vertex| self.points[vertex as usize]);
        let left = |vertex: u32| self.finite_point(vertex).filter(|&p| orient2d(a, b, p) > 0);
        match (left(best), left(other)) {
            (Some(best), Some(other)) => finite_conflict([a, b, best], other),
            (None, Some(_)) => true,
            // The infinite vertex is an apex where no vertex lies to the left.
            (None, None) => other == self.infinite,
            (Some(_), None) => false,
        }
    }

    /// The point of a vertex; `None` for the infinite one.
    pub(super) fn finite_point(&self, vertex: u32) -> Option<Point> {
        (vertex != self.infinite).then(|| self.points[vertex as usize])
    }
}
