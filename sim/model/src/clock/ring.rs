//! Reads finished boundary rings in their order, an entry a clock, one ring after the other.

use super::attempts::Outcome;
use super::memory::{Entry, Memory};
use std::collections::VecDeque;

/// A finished ring, to be committed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CommitJob {
    pub context: usize,
    /// The new vertex.
    pub p: u32,
    /// Inner triangles.
    pub inners: u32,
    /// Locks in the log.
    pub locks: u32,
    /// When the point was taken.
    pub since: u32,
}

/// An entry on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub job: CommitJob,
    pointer: usize,
    pub is_last: bool,
}

/// The queue of rings and the three stages: pointer, list memory, its output register.
#[derive(Clone, Debug, Default)]
pub(super) struct RingReader {
    queue: VecDeque<CommitJob>,
    pointer: Option<Link>,
    array: Option<Link>,
    head: Option<Link>,
}

impl RingReader {
    /// The entry at the head.
    pub(super) fn head(&self, memory: &Memory) -> Option<(Link, Entry)> {
        self.head.map(|link| (link, memory.entries[link.job.context][link.pointer]))
    }

    /// All stages move if the head is free or taken.
    pub(super) fn clock(&mut self, taken: bool, outcome: Option<&Outcome>, memory: &Memory) {
        if self.head.is_none() || taken {
            self.head = self.array;
            self.array = self.pointer.map(|link| Link { is_last: after(&link, memory) == 0, ..link });
            self.pointer = match self.array {
                Some(link) if !link.is_last => Some(Link { pointer: after(&link, memory), ..link }),
                _ => self.queue.pop_front().map(|job| Link { job, pointer: 0, is_last: false }),
            };
        }
        self.queue.extend(outcome.and_then(|outcome| outcome.commit));
    }

    pub(super) fn reset(&mut self) {
        *self = Self::default();
    }
}

fn after(link: &Link, memory: &Memory) -> usize {
    memory.entries[link.job.context][link.pointer].next
}
