//! The visit pipeline: queue of bundles, issue, reads of record and vertices, predicates, verdict. One visit enters in
//! each clock, and visits complete in the order of issue.
//!
//! Hardware twin: the block `VisitPipeline`.

use super::defect::Defect;
use super::holes::replaces;
use super::memory::Memory;
use super::wires::{Registers, Wires};
use crate::mesh::Record;
use crate::predicate::{finite_conflict, ghost_conflict, incircle, orient2d, takes_tie};
use std::collections::VecDeque;

/// Number of clocks from the issue register, which addresses the triangle memory, to the completion register: record 2,
/// vertices 2 (slot and rotation beside and behind them), corner registers 1, predicates 10, completion register 1.
const STAGES: usize = 16;

/// Number of clocks from the issue register to the record.
const RECORD_STAGES: usize = 2;

/// The mark, in `after`, of the visit of a record outside a star.
pub(super) const OUTSIDE: usize = 32;

/// One visit of a record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Visit {
    pub context: usize,
    /// Whether the record is rotated so that its neighbour `cavity_record` comes first.
    pub rotates: bool,
    /// Whether the visit takes the lock of the record.
    pub locks: bool,
    /// The entry of the ring, the entry after it, and the entry that stands for `cavity_record`.
    pub entry: usize,
    pub after: usize,
    pub cavity_entry: usize,
    pub cavity_record: u32,
    /// Id of the visited record.
    pub record: u32,
}

impl Visit {
    /// Whether this is the visit of a record outside a star, in a run of deletions.
    pub(super) fn is_outside_star(&self) -> bool {
        self.locks && self.rotates && (self.entry == 0 || self.after == OUTSIDE)
    }

    /// Whether this is a root visit, which takes a lock and turns no record.
    pub(super) fn is_root(&self) -> bool {
        self.locks && !self.rotates
    }
}

/// One to three visits that one completion asks for.
///
/// The second visit is for the entry after that of the first, and the third for the entry after that of the second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Bundle {
    pub first: Visit,
    /// Number of visits, 1 to 3.
    pub count: u32,
    /// The entry after that of the second visit.
    second_after: usize,
    second_record: u32,
    third_record: u32,
}

impl Bundle {
    pub(super) fn one(first: Visit) -> Self {
        Self { first, count: 1, ..Self::default() }
    }

    /// Two visits. The second one is for the entry after that of the first.
    pub(super) fn pair(first: Visit, second_after: usize, second_record: u32) -> Self {
        Self { first, count: 2, second_after, second_record, third_record: 0 }
    }

    /// Three visits, each but the first for the entry after that of the one before.
    pub(super) fn three(first: Visit, second_after: usize, second_record: u32, third_record: u32) -> Self {
        Self { first, count: 3, second_after, second_record, third_record }
    }

    /// A visit that only reads a record.
    pub(super) fn look(context: usize, record: u32) -> Self {
        Self::one(Visit { context, record, ..Visit::default() })
    }

    /// A root visit, which takes the lock of the root.
    pub(super) fn root(context: usize, record: u32) -> Self {
        Self::one(Visit { context, record, locks: true, ..Visit::default() })
    }

    /// A visit without a lock, with the record rotated so that its neighbour `cavity_record` comes first.
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

    /// The tests after a conflict: both halves of the edge move on to the neighbours behind it, the second half as
    /// the new entry `y`.
    pub(super) fn split(done: &Completion, y: usize) -> Self {
        let [_, n1, n2] = done.record.n;
        let first = Visit { after: y, cavity_entry: y, cavity_record: done.visit.record, record: n1, ..done.visit };
        Self { first, count: 2, second_after: done.visit.after, second_record: n2, third_record: 0 }
    }

    /// The visits of the bundle, in the order of their issue.
    pub(super) fn visits(&self) -> impl Iterator<Item = Visit> + '_ {
        (0..self.count).map(|place| self.visit(place))
    }

    /// The visit at this place of the bundle.
    fn visit(&self, place: u32) -> Visit {
        match place {
            0 => self.first,
            1 => Visit { entry: self.first.after, after: self.second_after, record: self.second_record, ..self.first },
            _ => Visit { entry: self.second_after, after: 0, record: self.third_record, ..self.first },
        }
    }
}

/// A completed visit, with what it found out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Completion {
    pub visit: Visit,
    /// The record, rotated if the visit asked for it.
    pub record: Record,
    /// The slot by which the record was rotated.
    pub slot: usize,
    /// Whether the visit took the lock.
    pub took: bool,
    /// Whether another context holds the lock.
    pub foreign: bool,
    /// Whether the record was not written yet, or being written, so that a walk must revisit it.
    pub again: bool,
    /// Whether the record conflicts with the context's point.
    pub conflict: bool,
    /// Whether the record holds the point, which only a solo insertion asks; and whether the point equals one of the
    /// record's vertices.
    pub located: bool,
    pub falls_onto_corner: bool,
    /// The record at which a walk goes on.
    pub walk_next: u32,
    /// The sign of `orient2d(r[0], r[1], p)`.
    pub turn: i32,
    /// In a run of deletions: the slot of the context's vertex, if the record names it; and for a test of four vertices
    /// of a ring, whether the last one replaces the best apex.
    pub names: Option<usize>,
    pub replaces: bool,
    /// Whether the record is free, so that its links lead on.
    pub is_free: bool,
}

impl Completion {
    /// Whether the completion may ask for other visits, as all do but tests that find their edge final and visits
    /// outside a star.
    pub(super) fn may_ask(&self, deletes: bool) -> bool {
        match deletes {
            true => !self.visit.is_outside_star() || self.foreign,
            false => !self.visit.rotates || self.conflict || self.foreign,
        }
    }
}

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

    /// Whether the vertex memory is asked for the point of a test of four vertices in this clock.
    pub(super) fn fetches(&self) -> bool {
        let read = self.stages[(self.head + STAGES - RECORD_STAGES) % STAGES];
        read.is_some_and(|done| done.visit.rotates && !done.visit.locks)
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

    /// Panics if a read-out meets a write. A read-out comes only when nothing else is in progress.
    fn expect_no_collision(&self, was: &Registers) {
        if let Some(id) = self.reads[0].filter(|&id| was.write.valid && was.write.id == id) {
            panic!("record {id} is read out and written at one edge");
        }
    }
}

/// Reads a record, takes its lock if asked to, and evaluates the predicates.
fn complete(visit: Visit, was: &Registers, wires: &Wires, memory: &mut Memory, defect: Option<Defect>) -> Completion {
    // L7: a record that is read while it is being written is torn, and a new record counts only when
    // its commit has ended.
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
        None => {
            // L10: the side that faces the point decides a tie, not the edge across which the record was reached.
            let by_entry = defect == Some(Defect::TiesByTheWayIn) && incircle(r, p) == 0;
            let conflict = if by_entry { takes_tie(r, 0, p) } else { finite_conflict(r, p) };
            (conflict, sides[lowest] >= 0, record.n[lowest])
        }
    };
    let falls_onto_corner = ghost.is_none() && r.contains(&p);
    let turn = sides[2].signum() as i32;
    let again = is_torn && defect != Some(Defect::ReadsTheTorn) || !is_written;
    // M8: all three vertices of a free record are infinite.
    let is_free = infinite == [true; 3];
    let names = stored.v.iter().position(|&v| v == memory.point_id[visit.context]);
    let replaces = wires.deletes && visit.rotates && !visit.locks && replaces(&visit, memory);
    Completion {
        visit,
        record,
        slot,
        took,
        foreign,
        again,
        conflict: conflict && !is_free,
        located,
        falls_onto_corner,
        walk_next,
        turn,
        names,
        replaces,
        is_free,
    }
}
