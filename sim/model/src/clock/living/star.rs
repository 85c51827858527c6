//! The star of a vertex that is deleted or moved: two chains of visits go round it, and each visit asks for the record
//! outside.

use super::commit::{Job, Step};
use super::defect::LivingDefect;
use super::pipeline::Flight;
use super::visit::Ask;
use super::work::Work;
use crate::mesh::Record;
use incircle_protocol::{Outcome, RunKind};

impl Work<'_> {
    /// The root names the vertex: both chains begin.
    pub(super) fn open_star(&mut self, root: &Flight) {
        (self.cx.drains, self.cx.overflows) = (false, false);
        let id = root.visit.record;
        let slot = self.slot_of_vertex(&root.record);
        let record = root.record.rotated(slot);
        self.cx.star.start(id, &record);
        self.cx.star.keeps = root.verdict.ghost.is_none() && root.verdict.sides[slot] > 0;
        self.note_near(&root.record, id, 1);
        let [_, a, b] = record.v;
        self.ask_across(Ask::Star { left: true, carried: a }, record.n[1], id);
        self.ask_across(Ask::Star { left: false, carried: b }, record.n[2], id);
        self.ask_across(Ask::Outside { place: 0 }, record.n[0], id);
    }

    fn slot_of_vertex(&self, record: &Record) -> usize {
        let vertex = self.cx.sight.vertex;
        usize::from(record.v[1] == vertex) | usize::from(record.v[2] == vertex) << 1
    }

    /// Notes a record that names the vertex of the next item, so that no walk need look for it.
    fn note_near(&mut self, record: &Record, id: u32, place: usize) {
        let names_next = self.cx.items.front().is_some_and(|item| record.v.contains(&item.vertex));
        if names_next {
            self.cx.near[place] = Some(id);
        }
    }

    /// A visit of the star has completed.
    pub(super) fn star_visited(&mut self, flight: &Flight, left: bool) {
        if self.counts(flight) {
            self.go_round(flight, left);
        }
        self.close_star_if_complete();
    }

    fn go_round(&mut self, flight: &Flight, left: bool) {
        let id = flight.visit.record;
        if !flight.record.v.contains(&self.cx.sight.vertex) {
            // No lock allows this. A model with a defect tries again.
            return self.abort();
        }
        let record = flight.record.rotated(self.slot_of_vertex(&flight.record));
        let place = self.cx.star.add(left, id, &record);
        self.cx.star.keeps &= flight.verdict.keeps;
        self.note_near(&record, id, 1);
        if self.cx.star.len() > self.sh.config.ring as usize {
            (self.cx.drains, self.cx.overflows) = (true, true);
            return;
        }
        self.ask_across(Ask::Outside { place }, record.n[0], id);
        let [_, a, b] = record.v;
        let (next, carried) = if left { (record.n[1], a) } else { (record.n[2], b) };
        let chains = &mut self.cx.star.chains;
        (chains[usize::from(left)].target, chains[usize::from(left)].last) = (None, id);
        if !chains[usize::from(!left)].is_met_at(next) {
            chains[usize::from(left)].target = Some(next);
            self.ask_across(Ask::Star { left, carried }, next, id);
        }
    }

    /// The visit of a record outside the ring has completed.
    pub(super) fn outside_visited(&mut self, flight: &Flight, place: i8) {
        if self.counts(flight) {
            let slot = flight.record.slot_of(flight.visit.from) as u8;
            let is_ghost = flight.verdict.ghost.is_some();
            self.cx.star.keeps &= !flight.verdict.conflict;
            self.note_near(&flight.record, flight.visit.record, 0);
            if let Some(edge) = self.cx.star.edge_mut(place) {
                (edge.slot, edge.ghost_outside) = (slot, is_ghost);
            }
        }
        self.close_star_if_complete();
    }

    fn close_star_if_complete(&mut self) {
        match (self.cx.in_flight, self.cx.drains) {
            (0, true) => self.end_drained(),
            (0, false) => self.close_star(),
            _ => {}
        }
    }

    /// All visits of the star have completed.
    fn close_star(&mut self) {
        let ring: Vec<u32> = self.cx.star.ring().map(|edge| edge.from).collect();
        let moves = self.sh.kind == RunKind::Move;
        if moves && self.cx.sight.place == self.cx.sight.to {
            self.release();
            let vertex = self.cx.sight.vertex;
            return self.end(Outcome::Done, vertex);
        }
        let is_inside = !ring.contains(&self.memory.infinite);
        if moves && self.sh.lacks(LivingDefect::MovesWithoutLook) && is_inside {
            return self.move_in_place();
        }
        if moves && self.cx.star.keeps && is_inside {
            // The edge at which the two chains met is left.
            let corners = [ring[ring.len() - 1], ring[0], ring[1]];
            let (other, root) = (self.cx.sight.vertex, self.cx.root);
            return self.ask_across(Ask::Corners { corners, other }, root, root);
        }
        self.open_hole(self.cx.star.ring().collect());
    }

    /// The last edge of a star that moves has been tested.
    pub(super) fn last_edge_tested(&mut self, flight: &Flight) {
        self.cx.in_flight -= 1;
        if flight.verdict.keeps {
            self.move_in_place();
        } else {
            self.open_hole(self.cx.star.ring().collect());
        }
    }

    /// No edge changes: the point alone is written.
    fn move_in_place(&mut self) {
        self.sh.counts.moved_in_place += 1;
        let mut job = Job::new(self.x, self.cx.since);
        job.steps.push_back(Step::Point);
        job.point = Some((self.cx.sight.vertex, self.cx.sight.to));
        self.hand_over(job);
    }
}
