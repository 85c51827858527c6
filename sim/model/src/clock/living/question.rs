//! Questions: what a place is, the weights there, and the vertex nearest to it.

use super::context::Chain;
use super::pipeline::Flight;
use super::visit::{Ask, Visit};
use super::work::Work;
use crate::mesh::Record;
use incircle_protocol::{Located, Outcome, RunKind};

impl Work<'_> {
    /// The walk of a question has reached the record that holds the place.
    pub(super) fn arrive(&mut self, flight: &Flight) {
        self.cx.hint = flight.visit.record;
        if self.sh.kind == RunKind::Nearest {
            let nearest = flight.verdict.nearest;
            return self.search_around(flight.visit.record, &flight.record, nearest, flight.verdict.passes);
        }
        if let Some(slot) = flight.verdict.ghost {
            self.cx.hull = hull_edge(&flight.record, slot);
            return self.ask(Ask::Hull, flight.record.n[(slot + 1) % 3]);
        }
        let mut located = Located::default();
        let mut count = 0;
        for (slot, side) in flight.verdict.sides.into_iter().enumerate() {
            if side != 0 {
                located.vertices[count] = flight.record.v[slot];
                located.weights[count] = side.unsigned_abs();
                count += 1;
            }
        }
        let outcome = match count {
            1 => Outcome::Vertex,
            2 => Outcome::Edge,
            _ => Outcome::Triangle,
        };
        self.end_with(outcome, &located);
    }

    /// The ghost triangle before one that sees the place has been visited.
    pub(super) fn hull_visited(&mut self, flight: &Flight) {
        let slot = flight.verdict.ghost.unwrap_or(0);
        if flight.verdict.sides[slot] > 0 {
            self.cx.hull = hull_edge(&flight.record, slot);
            return self.ask(Ask::Hull, flight.record.n[(slot + 1) % 3]);
        }
        let [from, to] = self.cx.hull;
        self.end_with(Outcome::Outside, &Located { vertices: [from, to, 0], weights: [0; 3] });
    }

    /// Begins to look around the corner of a record that is the nearest so far: two chains of visits leave the record
    /// across its edges at that corner, and each ends at a spoke more than 90 degrees past the place.
    fn search_around(&mut self, id: u32, record: &Record, slot: usize, passes: [bool; 2]) {
        let record = record.rotated(slot);
        self.cx.sight.vertex = record.v[0];
        self.cx.hint = id;
        self.cx.closer = None;
        let is_there = self.memory.vertex(record.v[0]) == self.cx.sight.place;
        // The next corner ends the edge to the right, the one after it the edge to the left.
        let [right, left] = [!passes[0] && !is_there, !passes[1] && !is_there];
        let chain = |goes: bool, target: u32| Chain { target: Some(target).filter(|_| goes), last: id };
        self.cx.chains = [chain(right, record.n[2]), chain(left, record.n[1])];
        for (goes, left, target) in [(left, true, record.n[1]), (right, false, record.n[2])] {
            if goes {
                self.ask_across(Ask::Around { left }, target, id);
            }
        }
        self.end_search_if_complete();
    }

    /// A record around the nearest vertex so far has been visited.
    pub(super) fn around_visited(&mut self, flight: &Flight, left: bool) {
        self.cx.in_flight -= 1;
        let (id, verdict, center) = (flight.visit.record, &flight.verdict, self.cx.sight.vertex);
        self.cx.chains[usize::from(left)] = Chain { target: None, last: id };
        let slot = flight.record.v.iter().position(|&v| v == center).unwrap_or(0);
        if verdict.nearest != slot {
            self.cx.closer = self.cx.closer.or(Some((id, flight.record, verdict.nearest, verdict.passes)));
        } else if self.cx.closer.is_none() && !verdict.passes[usize::from(left)] {
            let record = flight.record.rotated(slot);
            let next = if left { record.n[1] } else { record.n[2] };
            if !self.cx.chains[usize::from(!left)].is_met_at(next) {
                self.cx.chains[usize::from(left)].target = Some(next);
                self.cx.in_flight += 1;
                self.asked.add(Visit::across(self.x, Ask::Around { left }, next, id));
            }
        }
        self.end_search_if_complete();
    }

    fn end_search_if_complete(&mut self) {
        if self.cx.in_flight > 0 {
            return;
        }
        match self.cx.closer.take() {
            Some((id, record, slot, passes)) => self.search_around(id, &record, slot, passes),
            None => {
                let vertex = self.cx.sight.vertex;
                self.end(Outcome::Vertex, vertex);
            }
        }
    }
}

/// The ends of the hull edge of a ghost triangle, counter-clockwise on the hull.
fn hull_edge(record: &Record, slot: usize) -> [u32; 2] {
    [record.v[(slot + 2) % 3], record.v[(slot + 1) % 3]]
}
