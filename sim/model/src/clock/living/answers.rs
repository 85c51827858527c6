//! The answers of the living engine: heads, parts and read-outs, two words in each clock.

use crate::clock::beat::Beat;
use std::collections::VecDeque;

/// Number of words for which the queue has room.
const ROOM: usize = 512;

#[derive(Clone, Debug, Default)]
pub(super) struct Answers {
    words: VecDeque<u32>,
    /// Number of words of the answer that are still to be loaded.
    left: u64,
    /// The beat that is offered.
    pub offered: Option<Beat>,
}

impl Answers {
    /// Begins an answer with its head and the number of words behind it.
    pub(super) fn begin(&mut self, header: u32, length: u32) {
        self.words.extend([header, length]);
        self.left = 2 + u64::from(length);
    }

    pub(super) fn extend(&mut self, words: &[u32]) {
        self.words.extend(words);
    }

    /// Number of words that wait.
    pub(super) fn waiting(&self) -> usize {
        self.words.len()
    }

    /// Whether there is room for a part of every item that has begun.
    pub(super) fn has_room(&self, parts_to_come: u32, part_words: usize) -> bool {
        self.words.len() + parts_to_come as usize * part_words < ROOM
    }

    /// Whether the last word of the answer has been taken.
    pub(super) fn is_over(&self) -> bool {
        self.left == 0 && self.offered.is_none()
    }

    /// Simulates one edge, at which the offered beat is taken or not. A beat has two words unless it is the last.
    pub(super) fn clock(&mut self, taken: bool) {
        if taken {
            self.offered = None;
        }
        let ready = self.words.len() >= 2 || self.words.len() as u64 == self.left;
        if self.offered.is_some() || self.left == 0 || !ready {
            return;
        }
        let both = self.words.len() >= 2;
        let low = self.words.pop_front().unwrap_or(0);
        let high = if both { self.words.pop_front().unwrap_or(0) } else { 0 };
        self.left -= 1 + u64::from(both);
        self.offered = Some(Beat { low, high, both, last: self.left == 0 });
    }
}
