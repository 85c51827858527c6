//! The visit pipeline: bundle queue, issue, record and vertex reads, predicates, verdict. One visit a clock, in order.

use super::defect::Defect;
use super::memory::Memory;
use super::wires::{Registers, Wires};
use crate::mesh::Record;
use crate::predicate::{finite_conflict, ghost_conflict, orient2d};
use std::collections::VecDeque;

/// Clocks from the issue register, which addresses the triangle memory, to the completion register:
/// record 2, vertices 2, with slot and rotation beside and behind them, corner registers 1, predicates 10, completion register 1.
const STAGES: usize = 16;

/// Clocks from the issue register to the record.
const RECORD_STAGES: usize = 2;

/// One visit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Visit {
    pub context: usize,
    /// The record is turned so that its link to `cavity_record` comes first.
    pub rotates: bool,
    /// The record's lock is taken.
    pub locks: bool,
    /// Ring entry, the entry after it, and the entry that names `cavity_record`.
    pub entry: usize,
    pub after: usize,
    pub cavity_entry: usize,
    pub cavity_record: u32,
    /// The record visited.
    pub record: u32,
}

/// One to three visits that one completion asks for.
///
/// The second is from the entry after the first one's, the third from the entry after that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Bundle {
    pub first: Visit,
    /// Visits.
    pub count: u32,
    /// The entry after the second visit's.
    second_after: usize,
    second_record: u32,
    third_record: u32,
}

impl Bundle {
    pub(super) fn one(first: Visit) -> Self {
        Self { first, count: 1, ..Self::default() }
    }

    /// A plain look at a record.
    pub(super) fn look(context: usize, record: u32) -> Self {
        Self::one(Visit { context, record, ..Visit::default() })
    }

    /// The visit that locks a root.
    pub(super) fn root(context: usize, record: u32) -> Self {
        Self::one(Visit { context, record, locks: true, ..Visit::default() })
    }

    /// A visit without a lock, turned to the link to `cavity_record`.
    pub(super) fn turned(context: usize, cavity_record: u32, record: u32) -> Self {
        Self::one(Visit { context, rotates: true, cavity_record, record, ..Visit::default() })
    }

    /// The tests of the three neighbours of a root.
    pub(super) fn tests(root: &Completion) -> Self {
        let Visit { context, record, .. } = root.visit;
        let n = root.record.n;
        let first = Visit {
            context,
            rotates: true,
            locks: true,
            entry: 0,
            after: 1,
            cavity_entry: 0,
            cavity_record: record,
            record: n[0],
        };
        Self { first, count: 3, second_after: 2, second_record: n[1], third_record: n[2] }
    }

    /// The bundle of a conflict: both halves of the edge go on to the triangles behind, the second as the new entry `y`.
    pub(super) fn split(done: &Completion, y: usize) -> Self {
        let [_, n1, n2] = done.record.n;
        let first = Visit { after: y, cavity_entry: y, cavity_record: done.visit.record, record: n1, ..done.visit };
        Self { first, count: 2, second_after: done.visit.after, second_record: n2, third_record: 0 }
    }

    /// The visit with this place in the bundle.
    fn visit(&self, place: u32) -> Visit {
        match place {
            0 => self.first,
            1 => Visit { entry: self.first.after, after: self.second_after, record: self.second_record, ..self.first },
            _ => Visit { entry: self.second_after, after: 0, record: self.third_record, ..self.first },
        }
    }
}

/// A visit that has been made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Completion {
    pub visit: Visit,
    /// The record, turned if the visit says so.
    pub record: Record,
    /// How far it was turned.
    pub slot: usize,
    /// It took the lock.
    pub took: bool,
    /// Another context holds the lock.
    pub foreign: bool,
    /// The record was not written yet, or being written: a walk looks again.
    pub again: bool,
    /// It goes when the context's point comes.
    pub conflict: bool,
    /// The point lies here, or falls onto a corner.
    pub located: bool,
    pub falls_onto_corner: bool,
    /// Where a walk goes on.
    pub walk_next: u32,
    /// The sign of `orient2d(r[0], r[1], p)`.
    pub turn: i32,
}

impl Completion {
    /// It may ask for other visits: all do but tests that find their edge final.
    pub(super) fn may_ask(&self) -> bool {
        !self.visit.rotates || self.conflict || self.foreign
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Pipeline {
    queue: VecDeque<Bundle>,
    /// Visits of the bundle at the head that have been issued.
    place: u32,
    issued: Option<Visit>,
    stages: [Option<Completion>; STAGES],
    /// Place of the completion register in `stages`, which turns round.
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

    /// A visit reads the memories in this clock.
    pub(super) fn reads(&self) -> bool {
        self.issued.is_some()
    }

    /// The record id whose words a read-out gets at this edge.
    pub(super) fn record_read(&self) -> Option<u32> {
        self.reads[RECORD_STAGES]
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, memory: &mut Memory, defect: Option<Defect>) {
        self.expect_no_collision(was);
        let visited = self.issued.map(|visit| complete(visit, was, wires, memory, defect));
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

    /// A read-out meets no write: it comes when nothing is at work.
    fn expect_no_collision(&self, was: &Registers) {
        if let Some(id) = self.reads[0].filter(|&id| was.write.valid && was.write.id == id) {
            panic!("record {id} is read out and written at one edge");
        }
    }
}

/// Reads a record, takes its lock if asked to, and evaluates the predicates.
fn complete(visit: Visit, was: &Registers, wires: &Wires, memory: &mut Memory, defect: Option<Defect>) -> Completion {
    // L7: a record that is written while it is read comes out torn, and a new one counts once its commit has ended.
    let is_torn = was.write.valid && was.write.id == visit.record;
    let is_written =
        visit.record < was.commit.records || was.commit.records == 0 || defect == Some(Defect::ReadsTheUnwritten);
    let stored = if is_torn { Record::default() } else { memory.record(visit.record) };
    let (took, foreign) = match visit.locks {
        true => memory.take_lock(visit.record, visit.context, wires.clear, defect),
        false => (false, false),
    };
    let p = memory.position[visit.context];
    let slot = if visit.rotates { stored.slot_of(visit.cavity_record) } else { 0 };
    let record = stored.rotated(slot);
    let infinite = record.v.map(|v| v == memory.infinite);
    let r = record.v.map(|v| memory.vertex(v));
    let sides = [orient2d(r[1], r[2], p), orient2d(r[2], r[0], p), orient2d(r[0], r[1], p)];
    let first_two = usize::from(sides[1] < sides[0]);
    let lowest = if sides[2] < sides[first_two] { 2 } else { first_two };
    let ghost = infinite.iter().position(|&is| is);
    let (conflict, located, walk_next) = match ghost {
        Some(g) => (ghost_conflict(r[(g + 1) % 3], r[(g + 2) % 3], p), sides[g] > 0, record.n[g]),
        None => (finite_conflict(r, p), sides[lowest] >= 0, record.n[lowest]),
    };
    let falls_onto_corner = ghost.is_none() && r.contains(&p);
    let turn = sides[2].signum() as i32;
    let again = is_torn && defect != Some(Defect::ReadsTheTorn) || !is_written;
    Completion { visit, record, slot, took, foreign, again, conflict, located, falls_onto_corner, walk_next, turn }
}
