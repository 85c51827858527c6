//! The answer to a run: its head and its parts, two words in each clock.
//!
//! Hardware twin: the block `PartQueue`.

use crate::clock::beat::Beat;
use incircle_protocol::{part_head, Outcome};
use std::collections::VecDeque;

/// Number of items that may have begun without their parts having left.
const PLACES: usize = 32;

/// The part of the answer for one item.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub number: u32,
    pub outcome: Outcome,
    pub vertices: [u32; 3],
}

/// The head of an answer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Head {
    pub header: u32,
    pub length: u32,
    pub parts: u32,
}

#[derive(Clone, Debug, Default)]
pub(super) struct PartQueue {
    /// The part that joins `parts` at the next edge.
    kept: Option<Part>,
    parts: VecDeque<Part>,
    places: usize,
    head: Option<Head>,
    /// Number of parts that are still to leave.
    left: u32,
    /// Whether the next beat is the second of its part.
    at_second: bool,
    valid: bool,
    offered: Beat,
}

impl PartQueue {
    pub(super) fn has_room(&self) -> bool {
        self.places < PLACES
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
            self.left = head.parts;
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
        let Some(&Part { number, outcome, vertices: [v0, v1, v2] }) = self.parts.front() else {
            return;
        };
        self.valid = true;
        if self.at_second {
            self.offered = Beat { low: v1, high: v2, both: true, last: self.left == 1 };
            self.parts.pop_front();
            self.places -= 1;
            self.left -= 1;
        } else {
            self.offered = Beat { low: part_head(number, outcome), high: v0, both: true, last: false };
        }
        self.at_second = !self.at_second;
    }
}
