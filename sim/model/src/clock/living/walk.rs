//! Walks, and the visit of a root under its lock.

use super::defect::LivingDefect;
use super::pipeline::Flight;
use super::visit::Ask;
use super::work::Work;
use incircle_protocol::{Outcome, RunKind};

impl Work<'_> {
    /// A step of a walk has completed.
    pub(super) fn walked(&mut self, flight: &Flight) {
        let (id, verdict) = (flight.visit.record, &flight.verdict);
        // M9: the record was being written, or will be.
        if flight.torn {
            return self.ask(Ask::Walk, id);
        }
        // M8: a free record leads on.
        if verdict.is_free {
            return self.ask(Ask::Walk, verdict.next);
        }
        match self.sh.kind {
            RunKind::Locate | RunKind::Interpolate | RunKind::Nearest if verdict.holds => self.arrive(flight),
            RunKind::Delete | RunKind::Move if !self.cx.inserts => {
                if flight.record.v.contains(&self.cx.sight.vertex) {
                    self.reach(id);
                } else if verdict.holds {
                    self.look_again(id);
                } else {
                    self.ask(Ask::Walk, verdict.next);
                }
            }
            kind if kind.is_change() && verdict.corner.is_some() => self.meet_duplicate(flight),
            kind if kind.is_change() && verdict.conflict => self.reach(id),
            _ => self.ask(Ask::Walk, verdict.next),
        }
    }

    /// The walk to a vertex has ended where the vertex is not: its star is being written, or another item has changed
    /// it. The context looks where the vertex is now.
    fn look_again(&mut self, id: u32) {
        let vertex = self.cx.sight.vertex;
        if !self.sh.is_vertex[vertex as usize] {
            return self.end(Outcome::Missing, vertex);
        }
        self.cx.sight.place = self.memory.vertex(vertex);
        if self.sh.kind == RunKind::Delete {
            self.cx.sight.to = self.cx.sight.place;
        }
        self.ask(Ask::Walk, id);
    }

    /// A vertex has the point that would be inserted.
    fn meet_duplicate(&mut self, flight: &Flight) {
        let other = flight.verdict.corner.map_or(0, |corner| flight.record.v[corner]);
        self.cx.hint = flight.visit.record;
        let vertex = self.cx.sight.vertex as usize;
        self.sh.is_vertex[vertex] = false;
        self.end(Outcome::Duplicate, other);
    }

    /// The visit of a root has completed.
    pub(super) fn rooted(&mut self, flight: &Flight) {
        let (id, verdict) = (flight.visit.record, &flight.verdict);
        if flight.took {
            self.cx.log.push(id);
        }
        if flight.torn {
            return self.ask(Ask::Root, id);
        }
        if flight.foreign {
            return self.meet_foreign_root(id);
        }
        // M2: what the walk saw may not be true any more.
        let is_right = match self.cx.inserts {
            true => verdict.conflict,
            false => flight.record.v.contains(&self.cx.sight.vertex),
        };
        if is_right && !verdict.is_free || self.sh.lacks(LivingDefect::TrustsTheWalk) {
            self.cx.root = id;
            self.cx.hint = id;
            return if self.cx.inserts { self.open_cavity(flight) } else { self.open_star(flight) };
        }
        self.release();
        if self.cx.inserts && verdict.corner.is_some() && !verdict.is_free {
            return self.meet_duplicate(flight);
        }
        self.sh.counts.root_retries += 1;
        let goes_on = verdict.is_free || self.cx.inserts;
        self.ask(Ask::Walk, if goes_on { verdict.next } else { id });
    }

    /// M4, M5: another context holds the lock of the root.
    fn meet_foreign_root(&mut self, id: u32) {
        if self.sh.priority == Some(self.x) {
            self.sh.counts.waits += 1;
            return self.ask(Ask::Root, id);
        }
        self.note_abort();
        self.cx.root = id;
        self.cx.drains = false;
        self.end_drained();
    }
}
