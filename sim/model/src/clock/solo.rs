//! Solo insertion, in constant memory: splits the root, then flips once round the star.
//!
//! Hardware twin: the block `Solo`.

use super::attempts::Tables;
use super::memory::{Memory, Write};
use super::visit::{Bundle, Completion};
use super::wires::{Registers, Wires};
use crate::mesh::Record;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Idle,
    /// The point is located again, since the mesh has changed since its attempt.
    Locate,
    /// Three records replace the root.
    Split,
    /// The outer neighbours of the second and third record learn the new ids.
    Mend,
    /// The current triangle of the star is read.
    Fetch,
    /// The record outside that triangle is tested.
    Test,
    /// The edge between the two is flipped.
    Flip,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Solo {
    pub state: State,
    /// The clock within `Split` and `Flip`, or the number of the neighbour within `Mend`.
    step: u32,
    /// Whether a visit is in flight.
    awaits: bool,
    /// The context that started at the last edge, and the visit that completed in the clock before. The block acts on
    /// all its inputs one clock after they come.
    started: Option<usize>,
    done: Option<Completion>,
    context: usize,
    vertex: u32,
    /// The record that holds the point.
    root_id: u32,
    root: Record,
    /// The current triangle of the star: `v = (p, a, b)`, `n = (outer, after, before)`.
    id: u32,
    a: u32,
    b: u32,
    outer: u32,
    after: u32,
    before: u32,
    /// The neighbour that `outer` names across this edge.
    back: u32,
    /// The apex of `outer`, and the neighbours that the flip passes on.
    apex: u32,
    apex_after_a: u32,
    apex_before_b: u32,
    pub write: Write,
}

impl Solo {
    /// The visit that is asked for at this edge.
    pub(super) fn push_request(&self, was: &Registers) -> Option<Bundle> {
        if self.awaits {
            return None;
        }
        let (context, root_id, root) = (self.context, self.root_id, was.solo.root);
        match self.state {
            State::Locate => Some(Bundle::look(context, root_id)),
            State::Mend if self.step == 0 => Some(Bundle::turned(context, root_id, root.n[1])),
            State::Mend => Some(Bundle::turned(context, root_id, root.n[2])),
            State::Fetch => Some(Bundle::look(context, self.id)),
            State::Test => Some(Bundle::turned(context, self.back, self.outer)),
            State::Idle | State::Split | State::Flip => None,
        }
    }

    /// Whether a test finds no conflict at the last edge of the star, which ends the insertion.
    pub(super) fn inserts(&self) -> bool {
        let rests = self.done.is_some_and(|done| !done.conflict);
        self.state == State::Test && rests && self.b == self.root.v[1]
    }

    /// Whether the point turns out to be a duplicate.
    pub(super) fn finds_duplicate(&self) -> bool {
        self.state == State::Locate && self.done.is_some_and(|done| done.located && done.falls_onto_corner)
    }

    /// Whether the visits that complete belong to a solo insertion.
    pub(super) fn is_at_work(&self) -> bool {
        self.state != State::Idle
    }

    /// The visit that completed in the clock before.
    pub(super) fn last_visit(&self) -> Option<Completion> {
        self.done
    }

    /// The vertex that is inserted.
    pub(super) fn vertex(&self) -> u32 {
        self.vertex
    }

    /// The context whose point is inserted.
    pub(super) fn context(&self) -> usize {
        self.context
    }

    /// Whether a flip ends at this edge.
    pub(super) fn flips(&self) -> bool {
        self.state == State::Flip && self.step == 2
    }

    /// Whether a test completes at this edge.
    pub(super) fn tests(&self) -> bool {
        self.state == State::Test && self.done.is_some()
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, tables: &Tables, memory: &Memory) {
        self.write.valid = false;
        self.started = wires.solo_starts;
        self.done = wires.done;
        self.awaits |= wires.solo_push.is_some();
        match (was.solo.state, was.solo.done) {
            (State::Idle, _) => {
                if let Some(context) = was.solo.started {
                    self.context = context;
                    self.vertex = memory.point_id[context];
                    self.root_id = tables.root[context];
                    self.state = State::Locate;
                }
            }
            (State::Split, _) => self.split(was, memory),
            (State::Flip, _) => self.flip(was),
            (State::Locate, Some(done)) => self.locate(wires, &done),
            (State::Mend, Some(done)) => self.mend(was, &done, memory),
            (State::Fetch, Some(done)) => self.take_star(&done),
            (State::Test, Some(done)) => self.take_test(was, wires, &done),
            (State::Locate | State::Mend | State::Fetch | State::Test, None) => {}
        }
    }

    fn locate(&mut self, wires: &Wires, done: &Completion) {
        self.awaits = false;
        self.step = 0;
        self.root = done.record;
        if !done.located {
            self.root_id = done.walk_next;
        } else if wires.solo_ends {
            self.state = State::Idle;
        } else {
            self.state = State::Split;
        }
    }

    /// The ids of the two records that come to the mesh.
    fn new_ids(&self, was: &Registers, memory: &Memory) -> [u32; 2] {
        let fresh = was.commit.records;
        memory.kept(self.vertex).unwrap_or([fresh, fresh + 1])
    }

    fn split(&mut self, was: &Registers, memory: &Memory) {
        let (id, root) = (was.solo.root_id, was.solo.root);
        let p = was.solo.vertex;
        let [second, third] = self.new_ids(was, memory);
        let [v0, v1, v2] = root.v;
        self.write = match was.solo.step {
            0 => Write::record(id, [p, v1, v2], [root.n[0], second, third]),
            1 => Write::record(second, [p, v2, v0], [root.n[1], third, id]),
            _ => Write::record(third, [p, v0, v1], [root.n[2], id, second]),
        };
        self.step += 1;
        if was.solo.step == 2 {
            self.step = 0;
            self.state = State::Mend;
        }
    }

    fn mend(&mut self, was: &Registers, done: &Completion, memory: &Memory) {
        self.awaits = false;
        let id = self.new_ids(was, memory)[was.solo.step as usize];
        self.write = Write::link(done.visit.record, done.slot, id);
        self.step = 1;
        if was.solo.step == 1 {
            self.id = was.solo.root_id;
            self.state = State::Fetch;
        }
    }

    fn take_star(&mut self, done: &Completion) {
        self.awaits = false;
        let [_, a, b] = done.record.v;
        let [outer, after, before] = done.record.n;
        (self.a, self.b, self.outer, self.after, self.before) = (a, b, outer, after, before);
        self.back = self.id;
        self.state = State::Test;
    }

    fn take_test(&mut self, was: &Registers, wires: &Wires, done: &Completion) {
        self.awaits = false;
        self.apex = done.record.v[0];
        self.apex_after_a = done.record.n[1];
        self.apex_before_b = done.record.n[2];
        if done.conflict {
            self.step = 0;
            self.state = State::Flip;
            return;
        }
        if self.back != self.id {
            self.write = Write::link(was.solo.outer, done.slot, was.solo.id);
        }
        self.id = was.solo.after;
        self.state = if wires.solo_ends { State::Idle } else { State::Fetch };
    }

    fn flip(&mut self, was: &Registers) {
        let solo = &was.solo;
        let p = was.solo.vertex;
        self.write = match solo.step {
            0 => Write::record(solo.id, [p, solo.a, solo.apex], [solo.apex_after_a, solo.outer, solo.before]),
            1 => Write::record(solo.outer, [p, solo.apex, solo.b], [solo.apex_before_b, solo.after, solo.id]),
            _ => Write::link(solo.after, 2, solo.outer),
        };
        self.step += 1;
        if solo.step == 2 {
            self.b = solo.apex;
            self.after = solo.outer;
            self.back = solo.outer;
            self.outer = solo.apex_after_a;
            self.state = State::Test;
        }
    }
}
