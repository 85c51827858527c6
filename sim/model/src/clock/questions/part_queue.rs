//! The answer to a run: its head and its parts, two words in each clock.
//!
//! Hardware twin: the block `PartQueue`.

use crate::clock::beat::Beat;
use incircle_protocol::{part_head, Located, Outcome};
use std::collections::VecDeque;

/// Number of items that may have begun without their parts having left.
const PLACES: usize = 32;

/// The part of the answer for one item.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub number: u32,
    pub outcome: Outcome,
    pub located: Located,
}

impl Part {
    /// The two words of a beat of the part, which is numbered from 0.
    fn beat(&self, number: usize) -> [u32; 2] {
        let words = self.located.to_words();
        match number {
            0 => [part_head(self.number, self.outcome), words[0]],
            _ => [words[2 * number - 1], words[2 * number]],
        }
    }
}

/// The head of an answer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Head {
    pub header: u32,
    pub length: u32,
    pub parts: u32,
    /// Number of beats of a part.
    pub beats: usize,
}

#[derive(Clone, Debug, Default)]
pub(super) struct PartQueue {
    /// The part that joins `parts` at the next edge.
    kept: Option<Part>,
    parts: VecDeque<Part>,
    places: usize,
    head: Option<Head>,
    /// Number of parts that are still to leave, and of beats of a part.
    left: u32,
    beats: usize,
    /// Number of the next beat in its part.
    beat: usize,
    valid: bool,
    offered: Beat,
}

impl PartQueue {
    pub(super) fn has_room(&self) -> bool {
        self.places < PLACES
    }

    pub(super) fn has_two_places(&self) -> bool {
        self.places + 1 < PLACES
    }

    pub(super) fn offered(&self) -> Option<Beat> {
        self.valid.then_some(self.offered)
    }

    /// Whether the last word of the last answer has been taken.
    pub(super) fn is_over(&self) -> bool {
        self.head.is_none() && self.left == 0 && !self.valid
    }

    /// Simulates one edge.
    pub(super) fn clock(&mut self, head: Option<Head>, begins: bool, came: Option<Part>, is_taken: bool) {
        self.parts.extend(self.kept.take());
        self.kept = came;
        self.places += usize::from(begins);
        if is_taken {
            self.valid = false;
        }
        if !self.valid {
            self.load();
        }
        if let Some(head) = head {
            (self.left, self.beats) = (head.parts, head.beats);
            self.head = Some(head);
        }
    }

    /// Puts the next beat on offer, if there is one.
    fn load(&mut self) {
        if let Some(Head { header, length, .. }) = self.head.take() {
            self.valid = true;
            self.offered = Beat { low: header, high: length, both: true, last: self.left == 0 };
            return;
        }
        let Some(part) = self.parts.front() else {
            return;
        };
        let [low, high] = part.beat(self.beat);
        self.valid = true;
        self.beat += 1;
        let ends_part = self.beat == self.beats;
        self.offered = Beat { low, high, both: true, last: ends_part && self.left == 1 };
        if ends_part {
            self.parts.pop_front();
            self.beat = 0;
            self.places -= 1;
            self.left -= 1;
        }
    }
}
