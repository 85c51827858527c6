//! The items of a run, and the parts of its answer.

use crate::predicate::Point;
use incircle_protocol::{part_head, Located, Outcome, RunKind};

/// An item of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Item {
    /// The number of the item in its run.
    pub number: u32,
    /// The vertex; without meaning for a question.
    pub vertex: u32,
    /// The point; without meaning for a deletion.
    pub point: Point,
}

/// Most words of a part.
const PART_WORDS: usize = 10;

/// The part of the answer for one item.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    words: [u32; PART_WORDS],
    count: usize,
}

impl Part {
    pub(super) fn new(kind: RunKind, number: u32, outcome: Outcome, located: &Located) -> Self {
        let mut words = [part_head(number, outcome); PART_WORDS];
        words[1..].copy_from_slice(&located.to_words());
        Self { words, count: kind.part_words() }
    }

    /// A part that names one vertex.
    pub(super) fn of_vertex(kind: RunKind, number: u32, outcome: Outcome, vertex: u32) -> Self {
        Self::new(kind, number, outcome, &Located { vertices: [vertex, 0, 0], weights: [0; 3] })
    }

    pub(super) fn words(&self) -> &[u32] {
        &self.words[..self.count]
    }
}

/// What the answers of an engine are signed with.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::clock) struct Signature {
    pub engine: u8,
    pub tag: u8,
}
