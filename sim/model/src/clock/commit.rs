//! The commit: one pass over the finished ring writes the star of the new point.

use super::context::Phase;
use super::memory::{Entry, Memory, Write};
use super::Registers;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Idle,
    /// The first entry is there; the second is fetched.
    Load,
    /// The record of the current entry is written.
    Record,
    /// The link of the triangle outside it is written.
    Link,
    /// The record of the first entry, which needed the last one's id, is written.
    Close,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Commit {
    pub state: State,
    pointer: usize,
    first: Entry,
    current: Entry,
    current_id: u32,
    /// The entry after the current one, and whether the ring has closed there.
    ahead: Entry,
    ahead_is_first: bool,
    /// The current entry is the first, before the last one's id is known.
    opens: bool,
    before_id: u32,
    second_a: u32,
    second_id: u32,
    inner_index: u32,
    link: Write,
    closes: bool,
    pub write: Write,
}

impl Commit {
    pub(super) fn ends(&self) -> bool {
        self.state == State::Close
    }

    /// The entry ahead shares its cavity triangle with the one before or with the first: its record takes another id.
    fn shares(&self) -> bool {
        !self.ahead_is_first && (self.ahead.f == self.current.f || self.ahead.f == self.first.f)
    }

    /// A new id is taken at this edge: the inner triangles' ids have been given back.
    pub(super) fn takes_fresh(&self, was: &Registers) -> bool {
        self.state == State::Record && self.shares() && self.inner_index == was.cavity.inner_count
    }

    pub(super) fn clock(&mut self, was: &Registers, memory: &Memory) {
        let fetched = memory.entries[self.pointer];
        self.write.valid = false;
        match self.state {
            State::Idle if was.context.phase == Phase::Commit => {
                self.ahead = fetched;
                self.pointer = fetched.next;
                self.inner_index = 0;
                self.state = State::Load;
            }
            State::Idle => {}
            State::Load => {
                self.first = self.ahead;
                self.current = self.ahead;
                self.current_id = self.ahead.f;
                self.opens = true;
                self.fetch(fetched);
                self.state = State::Record;
            }
            State::Record => self.step(was, memory, fetched),
            State::Link => {
                self.write = self.link;
                self.state = if self.closes { State::Close } else { State::Record };
            }
            State::Close => {
                let v = [was.context.id, self.first.a, self.second_a];
                let n = [self.first.u, self.second_id, self.before_id];
                self.write = Write::record(self.current_id, v, n);
                self.pointer = 0;
                self.state = State::Idle;
            }
        }
    }

    /// Writes the current entry's record, now that the id of the one ahead is decided, and moves on.
    fn step(&mut self, was: &Registers, memory: &Memory, fetched: Entry) {
        let ahead_id = match (self.ahead_is_first, self.shares()) {
            (true, _) => self.first.f,
            (false, false) => self.ahead.f,
            (false, true) if self.takes_fresh(was) => was.context.records,
            (false, true) => {
                self.inner_index += 1;
                memory.inner[was.commit.inner_index as usize]
            }
        };
        let current = self.current;
        let mut links = false;
        if self.opens {
            self.second_a = self.ahead.a;
            self.second_id = ahead_id;
        } else {
            let v = [was.context.id, current.a, self.ahead.a];
            self.write = Write::record(self.current_id, v, [current.u, ahead_id, self.before_id]);
            self.link = Write::link(current.u, current.slot, self.current_id);
            links = self.current_id != current.f;
        }
        self.opens = false;
        self.closes = self.ahead_is_first;
        self.before_id = self.current_id;
        self.current = self.ahead;
        self.current_id = ahead_id;
        self.fetch(fetched);
        self.state = match (links, self.closes) {
            (true, _) => State::Link,
            (false, true) => State::Close,
            (false, false) => State::Record,
        };
    }

    fn fetch(&mut self, fetched: Entry) {
        self.ahead = fetched;
        self.ahead_is_first = self.pointer == 0;
        self.pointer = fetched.next;
    }
}
