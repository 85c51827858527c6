//! Filling the hole that the star of a deleted vertex leaves: gift wrapping.
//!
//! The triangle on an edge of the hole is the one whose circle holds no other vertex of the ring, with the tie rule.
//! That triangle cuts the hole in two, and each part is filled in the same way. The infinite vertex is a member of the
//! ring like others: a ghost triangle stands on an edge from which no vertex lies to the left. A vertex of a uniform
//! set takes 6 tests in the mean; cutting ears off would take 13.

use super::hole::{Across, Corner, Filling, Hole, RingEdge};
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
            let slot = self.records[outside as usize].slot_of(id) as u8;
            self.hole.ring.push(RingEdge { from: turned.v[1], record: id, outside, slot });
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
        hole.fillings.clear();
        hole.parts.push((0..hole.ring.len() as u8).map(|edge| (edge, Across::Ring(edge))).collect());
        while let Some(part) = hole.parts.pop() {
            self.fill_part(&mut hole, part);
        }
        self.hole = hole;
    }

    /// Puts one triangle into a part of the hole, and adds what is left of the part to the parts.
    fn fill_part(&mut self, hole: &mut Hole, mut part: Vec<Corner>) {
        let vertex = |&(edge, _): &Corner| hole.ring[usize::from(edge)].from;
        // The infinite vertex is on two edges, and a part has at least three.
        let is_finite = |pair: &[Corner]| pair.iter().all(|corner| vertex(corner) != self.infinite);
        let base = part.windows(2).position(is_finite).unwrap_or(part.len() - 1);
        part.rotate_left(base);
        let vertices: Vec<u32> = part.iter().map(vertex).collect();
        let apex = self.apex_of(&vertices);
        let number = hole.fillings.len() as u8;
        let corners = [0, 1, apex].map(|place| part[place].0);
        let mut across = [part[1].1, part[part.len() - 1].1, part[0].1];
        let ahead = apex > 2;
        let behind = apex < part.len() - 1;
        if behind {
            across[1] = Across::Filling(number, 1);
            let rest = part[apex..].iter().copied().chain([(part[0].0, across[1])]);
            hole.parts.push(rest.collect());
        }
        if ahead {
            across[0] = Across::Filling(number, 0);
            let rest = part[1..apex].iter().copied().chain([(part[apex].0, across[0])]);
            hole.parts.push(rest.collect());
        }
        // A side that is open for now is corrected by the triangle that is put there later.
        for (slot, side) in (0..).zip(across) {
            match side {
                Across::Filling(other, theirs) if other != number => {
                    hole.fillings[usize::from(other)].across[usize::from(theirs)] = Across::Filling(number, slot);
                }
                _ => {}
            }
        }
        hole.fillings.push(Filling { corners, across });
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

    /// Whether no finite triangle is left beside the star and the hole is filled by ghost triangles alone, so that all
    /// other points lie on one line.
    pub(super) fn is_flat_without_star(&self) -> bool {
        let is_ghost = |filling: &Filling| {
            filling.corners.iter().any(|&corner| self.hole.ring[usize::from(corner)].from == self.infinite)
        };
        let ring = &self.hole.ring;
        let is_lonely = |(place, edge): (usize, &RingEdge)| {
            let ends = [edge.from, ring[(place + 1) % ring.len()].from];
            ends.contains(&self.infinite) || self.records[edge.outside as usize].v.contains(&self.infinite)
        };
        self.hole.fillings.iter().all(is_ghost) && ring.iter().enumerate().all(is_lonely)
    }
}
