//! The items of a run, and the signals that the rest of the core gives to the blocks of questions.

use crate::predicate::Point;
use incircle_protocol::RunKind;

/// An item of a run.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Item {
    pub number: u32,
    pub place: Point,
}

/// The signals of the rest of the core at an edge.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Signals {
    /// A run of this kind begins.
    pub begins: Option<RunKind>,
    /// The word on offer, if it belongs to the run under way.
    pub word: Option<u32>,
    /// Whether the offered beat is taken.
    pub is_taken: bool,
    /// Whether the mesh is forgotten.
    pub clears: bool,
    pub has_mesh: bool,
    /// Number of contexts that work.
    pub contexts: usize,
    /// The low half of a header.
    pub signature: u32,
}
