//! The visit pipeline: queue of bundles, issue, reads of record and vertices, predicates, verdict. One visit enters in
//! each clock, and visits complete in the order of issue.
//!
//! Hardware twin: the block `VisitPipeline`.

use super::defect::Defect;
use super::holes::{keeps_edges, replaces};
use super::memory::Memory;
use super::visit::{Bundle, Completion, Visit};
use super::wires::{Registers, Wires};
use crate::mesh::Record;
use crate::predicate::{finite_conflict, ghost_conflict, incircle, orient2d, takes_tie};
use std::collections::VecDeque;

/// Number of clocks from the issue register, which addresses the triangle memory, to the completion register: record 2,
/// vertices 2 (slot and rotation beside and behind them), corner registers 1, predicates 10, completion register 1.
const STAGES: usize = 16;

/// Number of clocks from the issue register to the record.
const RECORD_STAGES: usize = 2;

#[derive(Clone, Debug, Default)]
pub(super) struct Pipeline {
    queue: VecDeque<Bundle>,
    /// Number of visits of the first bundle that have been issued.
    place: u32,
    issued: Option<Visit>,
    stages: [Option<Completion>; STAGES],
    /// Place of the completion register in `stages`, which are used as a ring.
    head: usize,
    reads: [Option<u32>; RECORD_STAGES + 1],
}

impl Pipeline {
    pub(super) fn reset(&mut self) {
        *self = Self::default();
    }

    pub(super) fn completion(&self) -> Option<Completion> {
        self.stages[self.head]
    }

    /// The visits in stages, issue register and queue, in the order in which they complete.
    pub(super) fn visits(&self) -> impl Iterator<Item = Visit> + '_ {
        let waiting = self.queue.iter().enumerate().flat_map(|(number, bundle)| {
            let issued = if number == 0 { self.place } else { 0 };
            bundle.visits().skip(issued as usize)
        });
        let (older, newer) = self.stages.split_at(self.head);
        newer.iter().chain(older).flatten().map(|done| done.visit).chain(self.issued).chain(waiting)
    }

    /// Whether the vertex memory is asked for a fourth point of a visit in this clock: that of a test of four vertices,
    /// or the one opposite the record before in the star of a vertex that moves.
    pub(super) fn fetches(&self) -> bool {
        let read = self.stages[(self.head + STAGES - RECORD_STAGES) % STAGES];
        read.is_some_and(|done| done.fetches())
    }

    /// Whether a visit reads the memories in this clock.
    pub(super) fn reads(&self) -> bool {
        self.issued.is_some()
    }

    /// The record whose words a read-out gets at this edge.
    pub(super) fn record_read(&self) -> Option<u32> {
        self.reads[RECORD_STAGES]
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, memory: &mut Memory, defect: Option<Defect>) {
        self.expect_no_collision(was);
        let at_vertices = (self.head + STAGES - RECORD_STAGES) % STAGES;
        if let Some(done) = &mut self.stages[at_vertices] {
            judge(done, wires, memory, defect);
        }
        let visited = self.issued.map(|visit| read(visit, was, wires, memory, defect));
        self.stages[self.head] = visited;
        self.head = (self.head + 1) % STAGES;
        self.reads = [wires.read, self.reads[0], self.reads[1]];
        self.queue.extend(was.push);
        self.issued = None;
        if let Some(&bundle) = self.queue.front() {
            self.issued = Some(bundle.visit(self.place));
            self.place += 1;
            if self.place == bundle.count {
                self.place = 0;
                self.queue.pop_front();
            }
        }
    }

    /// Panics if a read-out meets a write. A read-out comes only when nothing else is in progress.
    fn expect_no_collision(&self, was: &Registers) {
        if let Some(id) = self.reads[0].filter(|&id| was.write.valid && was.write.id == id) {
            panic!("record {id} is read out and written at one edge");
        }
    }
}

/// Reads a record, and takes its lock if asked to. The vertices are read later.
fn read(visit: Visit, was: &Registers, wires: &Wires, memory: &mut Memory, defect: Option<Defect>) -> Completion {
    // L7: a record that is read while it is being written is torn, and a new record counts only when
    // its commit has ended.
    let is_torn = was.write.valid && was.write.id == visit.record;
    let is_written =
        visit.record < was.commit.records || was.commit.records == 0 || defect == Some(Defect::ReadsTheUnwritten);
    let stored = if is_torn { Record::default() } else { memory.record(visit.record) };
    let is_out = memory.inserts[visit.context] || was.solo.is_at_work();
    let finds = wires.deletes || wires.moves && !is_out;
    // M3: the records outside a star are locked, as those outside a cavity are.
    let is_open = defect == Some(Defect::LeavesTheRingOpen) && finds && visit.is_outside_star();
    let (took, foreign) = match visit.locks && !is_open {
        true => memory.take_lock(visit.record, visit.context, wires.clear, defect),
        false => (false, false),
    };
    let slot = if visit.rotates { stored.slot_of(visit.cavity_record) } else { 0 };
    Completion {
        visit,
        stored,
        record: stored.rotated(slot),
        slot,
        took,
        foreign,
        again: is_torn && defect != Some(Defect::ReadsTheTorn) || !is_written,
        finds,
        moves: finds && wires.moves,
        names: stored.v.iter().position(|&v| v == memory.point_id[visit.context]),
        // M8: all three vertices of a free record are infinite.
        is_free: stored.v == [memory.infinite; 3],
        ..Completion::default()
    }
}

/// Evaluates the predicates of a visit for the vertices of its record.
fn judge(done: &mut Completion, wires: &Wires, memory: &Memory, defect: Option<Defect>) {
    let Completion { visit, record, .. } = *done;
    // M14: the point of a vertex that is read while it is being written is torn, too.
    let written = wires.new_point.map(|(vertex, _)| vertex).filter(|vertex| done.stored.v.contains(vertex));
    assert!(
        written.is_none() || !visit.locks || done.foreign,
        "{visit:?} has the lock of a record whose point changes"
    );
    // Fetches and writes of points share a port.
    let is_torn = written.is_some() || wires.new_point.is_some() && done.fetches();
    done.again |= is_torn && defect != Some(Defect::ReadsTheTornPoint);
    // The star of a vertex that moves is judged for its new place.
    let is_moved = done.moves && (visit.locks || visit.is_last_edge());
    let p = if is_moved { memory.target[visit.context] } else { memory.position[visit.context] };
    let infinite = record.v.map(|v| v == memory.infinite);
    // A memory may give any word for a torn point, also the place that the visit looks for.
    let r = record.v.map(|v| if Some(v) == written { p } else { memory.vertex(v) });
    let sides = [orient2d(r[1], r[2], p), orient2d(r[2], r[0], p), orient2d(r[0], r[1], p)];
    let first_two = usize::from(sides[1] < sides[0]);
    let lowest = if sides[2] < sides[first_two] { 2 } else { first_two };
    let ghost = infinite.iter().position(|&is| is);
    let (conflict, located, walk_next) = match ghost {
        Some(g) => (ghost_conflict(r[(g + 1) % 3], r[(g + 2) % 3], p), sides[g] > 0, record.n[g]),
        None => {
            // L10: the side that faces the point decides a tie, not the edge across which the record was reached.
            let by_entry = defect == Some(Defect::TiesByTheWayIn) && incircle(r, p) == 0;
            let conflict = if by_entry { takes_tie(r, 0, p) } else { finite_conflict(r, p) };
            (conflict, sides[lowest] >= 0, record.n[lowest])
        }
    };
    let corner = r.iter().position(|&corner| corner == p).filter(|_| ghost.is_none());
    done.falls_onto_corner = corner.is_some();
    done.corner = corner.map_or(0, |slot| record.v[slot]);
    done.turn = sides[2].signum() as i32;
    done.conflict = conflict && !done.is_free;
    (done.located, done.walk_next) = (located, walk_next);
    done.replaces = done.finds && visit.is_hole_test() && !visit.is_last_edge() && replaces(&visit, memory);
    done.keeps = done.moves && keeps_edges(done, p, memory);
}
