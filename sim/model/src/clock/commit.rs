//! The commit: one pass over a complete ring writes the star of the new vertex.
//!
//! Hardware twin: the block `Commit`.

use super::commit_job::CommitJob;
use super::memory::{Entry, Memory, Write};
use super::ring::Head;
use super::wires::Registers;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Idle,
    /// The record of the current entry is written.
    Record,
    /// The neighbour in the record outside the current entry is written.
    Link,
    /// The record of the first entry is written, which needed the id of the last one.
    Close,
}

/// Number of clocks from the place of an inner record to its id.
const INNER_LATENCY: u32 = 3;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Commit {
    pub state: State,
    job: CommitJob,
    first: Entry,
    current: Entry,
    current_id: u32,
    current_is_last: bool,
    /// Whether the current entry is the first, whose record must wait for the id of the last.
    opens: bool,
    before_id: u32,
    second_vertex: u32,
    second_id: u32,
    inner_index: u32,
    /// Number of clocks for which the place of the next inner record has been stable, up to `INNER_LATENCY`.
    inner_age: u32,
    link: Write,
    closes: bool,
    pub write: Write,
    /// The ids that are kept for the vertex of the ring, and how many of them are taken.
    kept: Option<[u32; 2]>,
    kept_used: usize,
    /// The next new id.
    pub fresh: u32,
    /// The numbers below which new ids count as written, two clocks and one clock from now.
    written: [Option<u32>; 2],
    /// Number of records in the mesh. Ids from here on are not written yet.
    pub records: u32,
}

/// The effect of one step.
#[derive(Clone, Copy, Debug)]
struct Step {
    ahead: Entry,
    ahead_id: u32,
    is_inner: bool,
    is_fresh: bool,
}

impl Commit {
    /// The ring whose last record is written at this edge.
    pub(super) fn ends(&self) -> Option<CommitJob> {
        (self.state == State::Close).then_some(self.job)
    }

    /// Whether ids are kept for the vertex whose ring is written.
    pub(super) fn has_kept(&self) -> bool {
        self.kept.is_some()
    }

    /// Whether the head of the ring reader is taken at this edge.
    pub(super) fn takes(&self, head: Option<Head>, memory: &Memory) -> bool {
        match self.state {
            State::Idle | State::Close => head.is_some(),
            State::Record => !self.current_is_last && self.step(head, memory).is_some(),
            State::Link => false,
        }
    }

    /// The next new id: one that is kept for the vertex, or one that no record has had.
    fn new_id(&self) -> u32 {
        match self.kept {
            Some(ids) => ids[self.kept_used],
            None => self.fresh,
        }
    }

    fn step(&self, head: Option<Head>, memory: &Memory) -> Option<Step> {
        if self.current_is_last {
            return Some(Step {
                ahead: self.first,
                ahead_id: self.first.cavity_record,
                is_inner: false,
                is_fresh: false,
            });
        }
        let Head { entry: ahead, shares, .. } = head?;
        let is_inner = shares && self.inner_index != self.job.inners;
        let is_fresh = shares && !is_inner;
        let ahead_id = match (is_inner, is_fresh) {
            (true, _) if self.inner_age < INNER_LATENCY => return None,
            (true, _) => memory.inner[self.job.context][self.inner_index as usize],
            (_, true) => self.new_id(),
            _ => ahead.cavity_record,
        };
        Some(Step { ahead, ahead_id, is_inner, is_fresh })
    }

    pub(super) fn clock(
        &mut self,
        was: &Registers,
        head: Option<Head>,
        memory: &mut Memory,
        solo_ends: bool,
        seeds: bool,
        holds: bool,
    ) {
        self.write.valid = false;
        self.inner_age = (self.inner_age + 1).min(INNER_LATENCY);
        self.records = self.written[1].unwrap_or(self.records);
        self.written = [None, self.written[0]];
        match self.state {
            _ if holds => {}
            State::Idle => self.load(head, memory),
            State::Record => {
                if let Some(step) = was.commit.step(head, memory) {
                    self.advance(&step, head);
                }
            }
            State::Link => {
                self.write = self.link;
                self.state = if self.closes { State::Close } else { State::Record };
            }
            State::Close => {
                let v = [self.job.vertex, self.first.first_vertex, self.second_vertex];
                let n = [self.first.outside_record, self.second_id, self.before_id];
                self.write = Write::record(self.current_id, v, n);
                self.written[0] = Some(self.fresh);
                self.state = State::Idle;
                if self.kept.is_some() {
                    memory.take_kept(self.job.vertex);
                }
                self.load(head, memory);
            }
        }
        let others = 2 * u32::from(solo_ends) + 4 * u32::from(seeds);
        self.records += others;
        self.fresh += others;
        if was.command.clears {
            (self.records, self.fresh) = (0, 0);
        }
    }

    fn load(&mut self, head: Option<Head>, memory: &Memory) {
        if let Some(Head { job, entry, .. }) = head {
            self.job = job;
            self.first = entry;
            self.current = entry;
            self.current_id = entry.cavity_record;
            self.current_is_last = false;
            self.opens = true;
            self.inner_index = 0;
            self.inner_age = 0;
            (self.kept, self.kept_used) = (memory.kept(job.vertex), 0);
            self.state = State::Record;
        }
    }

    /// Writes the record of the current entry, now that the id of the next record is decided, and moves on.
    fn advance(&mut self, step: &Step, head: Option<Head>) {
        let Step { ahead, ahead_id, is_inner, is_fresh } = *step;
        if is_inner {
            self.inner_index += 1;
            self.inner_age = 0;
        }
        if is_fresh && self.kept.is_some() {
            self.kept_used += 1;
        } else {
            self.fresh += u32::from(is_fresh);
        }
        let current = self.current;
        let mut links = false;
        if self.opens {
            self.second_vertex = ahead.first_vertex;
            self.second_id = ahead_id;
        } else {
            let v = [self.job.vertex, current.first_vertex, ahead.first_vertex];
            self.write = Write::record(self.current_id, v, [current.outside_record, ahead_id, self.before_id]);
            self.link = Write::link(current.outside_record, current.slot, self.current_id);
            links = self.current_id != current.cavity_record;
        }
        self.opens = false;
        self.closes = self.current_is_last;
        self.before_id = self.current_id;
        self.current = ahead;
        self.current_id = ahead_id;
        self.current_is_last = !self.closes && head.is_some_and(|head| head.is_last);
        self.state = match (links, self.closes) {
            (true, _) => State::Link,
            (false, true) => State::Close,
            (false, false) => State::Record,
        };
    }
}
