//! Reads complete rings in their order, one entry in each clock, one ring after the other.
//!
//! Hardware twin: the block `RingReader`.

use super::commit_job::CommitJob;
use super::memory::{Entry, Memory};
use super::outcome::Outcome;
use std::collections::VecDeque;

/// An entry on its way through the stages.
#[derive(Clone, Copy, Debug)]
struct Link {
    job: CommitJob,
    pointer: usize,
    is_last: bool,
}

/// The entry at the head.
#[derive(Clone, Copy, Debug)]
pub(super) struct Head {
    pub job: CommitJob,
    pub entry: Entry,
    /// Whether the entry is the last of its ring.
    pub is_last: bool,
    /// Whether the entry before it, or the first entry of its ring, has the same cavity record behind it.
    pub shares: bool,
}

/// The queue of rings and the five stages: pointer, list memory, output register of that memory, a register
/// away from it, head.
#[derive(Clone, Debug, Default)]
pub(super) struct RingReader {
    queue: VecDeque<CommitJob>,
    pointer: Option<Link>,
    array: Option<Link>,
    output: Option<Link>,
    arrival: Option<Link>,
    pub head: Option<Head>,
    /// The cavity records behind the entry that came to the head last, and behind the first entry of its ring.
    last_cavity_record: u32,
    first_cavity_record: u32,
}

impl RingReader {
    /// Simulates one edge. All stages move if the head is free or taken.
    pub(super) fn clock(&mut self, taken: bool, outcome: Option<&Outcome>, memory: &Memory) {
        if self.head.is_none() || taken {
            self.head = self.arrival.map(|link| self.next_head(&link, memory));
            self.arrival = self.output;
            self.output = self.array;
            self.array = self.pointer.map(|link| Link { is_last: entry_of(&link, memory).after == 0, ..link });
            // The last entry is recognised only when the pointer has left it, so one place stays empty between rings.
            self.pointer = match self.array {
                Some(link) if link.is_last => None,
                Some(link) => Some(Link { pointer: entry_of(&link, memory).after, ..link }),
                None => self.queue.pop_front().map(|job| Link { job, pointer: 0, is_last: false }),
            };
        }
        self.queue.extend(outcome.and_then(|outcome| outcome.commit));
    }

    /// The entry that comes to the head, compared with the entries before it.
    fn next_head(&mut self, link: &Link, memory: &Memory) -> Head {
        let entry = entry_of(link, memory);
        let is_first = link.pointer == 0;
        let shares = !is_first
            && (entry.cavity_record == self.last_cavity_record || entry.cavity_record == self.first_cavity_record);
        self.last_cavity_record = entry.cavity_record;
        if is_first {
            self.first_cavity_record = entry.cavity_record;
        }
        Head { job: link.job, entry, is_last: link.is_last, shares }
    }

    pub(super) fn reset(&mut self) {
        *self = Self::default();
    }
}

fn entry_of(link: &Link, memory: &Memory) -> Entry {
    memory.entries[link.job.context][link.pointer]
}
