//! The visit pipeline: bundle queue, issue, record and vertex reads, predicates, verdict. One visit a clock, in order.

use super::memory::Memory;
use super::wires::Wires;
use super::Registers;
use crate::mesh::Record;
use crate::predicate::{finite_conflict, ghost_conflict, orient2d, Point};
use std::collections::VecDeque;

/// Clocks from the issue register, which addresses the triangle memory, to the completion register:
/// record 2, slot and rotation 2, vertices in between, corner registers 1, predicates 9, verdict 1.
const STAGES: usize = 15;

/// Clocks from the issue register to the record.
const RECORD_STAGES: usize = 2;

/// One visit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Token {
    /// The record is turned so that its link to `f` comes first.
    pub rotates: bool,
    /// The record's lock bit is set.
    pub locks: bool,
    /// Ring entry, the entry after it, and the entry that names `f`.
    pub x: usize,
    pub next: usize,
    pub f_entry: usize,
    pub f: u32,
    /// The record visited.
    pub u: u32,
}

/// One or two visits that one completion asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Bundle {
    pub first: Token,
    /// The second visits this record, from entry `y`; its entry comes after the first one's.
    pub second: Option<(u32, usize, usize)>,
}

impl Bundle {
    /// A plain look at a record.
    pub(super) fn look(u: u32) -> Self {
        Self { first: Token { u, ..Token::default() }, second: None }
    }

    /// The number of visits.
    pub(super) fn len(&self) -> u32 {
        1 + u32::from(self.second.is_some())
    }

    fn second_token(&self) -> Token {
        let (u, x, next) = self.second.unwrap_or_default();
        Token { u, x, next, ..self.first }
    }
}

/// A visit that has been made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Completion {
    pub token: Token,
    /// The record, turned if the token says so.
    pub record: Record,
    /// How far it was turned.
    pub slot: usize,
    /// Its lock bit had been set.
    pub was_set: bool,
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

#[derive(Clone, Debug, Default)]
pub(super) struct Pipeline {
    queue: VecDeque<Bundle>,
    /// The first visit of the bundle at the head has been issued.
    issues_second: bool,
    issued: Option<Token>,
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

    /// The record id whose words a read-out gets at this edge.
    pub(super) fn record_read(&self) -> Option<u32> {
        self.reads[RECORD_STAGES]
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, memory: &mut Memory) {
        self.expect_no_collision(was);
        let visited = self.issued.map(|token| visit(token, was.context.position, memory));
        self.stages[self.head] = visited;
        self.head = (self.head + 1) % STAGES;
        self.reads = [wires.read, self.reads[0], self.reads[1]];
        self.queue.extend(was.context.push);
        self.issued = None;
        if let Some(&bundle) = self.queue.front() {
            self.issued = Some(if self.issues_second { bundle.second_token() } else { bundle.first });
            let more = bundle.second.is_some() && !self.issues_second;
            self.issues_second = more;
            if !more {
                self.queue.pop_front();
            }
        }
    }

    /// Holds what the memories demand: in silicon a record that is written while it is read, and a lock that is set while it is
    /// cleared, are undefined. Verilator and this model have an order for both, so they must never happen.
    fn expect_no_collision(&self, was: &Registers) {
        let read = self.issued.map(|token| token.u).or(self.reads[0]);
        if let Some(id) = read.filter(|&id| was.write.valid && was.write.id == id) {
            panic!("record {id} is read and written at one edge");
        }
        let locked = self.issued.filter(|token| token.locks);
        if let Some(token) = locked.filter(|token| was.release.clear == Some(token.u)) {
            panic!("lock {} is set and cleared at one edge", token.u);
        }
    }
}

/// Reads a record, sets its lock if asked to, and evaluates the predicates.
fn visit(token: Token, p: Point, memory: &mut Memory) -> Completion {
    let stored = memory.record(token.u);
    let place = token.u as usize % memory.locks.len();
    let was_set = memory.locks[place];
    memory.locks[place] |= token.locks;
    let slot = if token.rotates { stored.slot_of(token.f) } else { 0 };
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
    Completion { token, record, slot, was_set, conflict, located, falls_onto_corner, walk_next, turn }
}
