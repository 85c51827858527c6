//! The items of a run, and the signals that the rest of the core gives to the blocks of runs.

use crate::predicate::Point;
use incircle_protocol::{Outcome, RunKind};

/// An item of a run.
#[derive(Clone, Copy, Debug, Default)]
pub(in super::super) struct Item {
    pub number: u32,
    pub place: Point,
    /// The vertex of an item of a change.
    pub vertex: u32,
    /// The place to which a `Move` takes the vertex; then `place` is the one that the vertex leaves.
    pub target: Point,
}

/// An item of a change that begins, and the record at which its walk begins.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Launch {
    pub context: usize,
    pub item: Item,
    pub record: u32,
    /// Whether the point has to be stored.
    pub stores: bool,
    /// Whether a vertex goes back into the mesh that its item has taken out of it.
    pub returns: bool,
}

/// The end of the item of a context, with the vertex that the context inserts.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct ItemEnd {
    pub context: usize,
    pub vertex: u32,
    /// The vertex that has the point of the item.
    pub duplicate: Option<u32>,
    /// The outcome of an item that ends with its star or its hole: why its vertex stays, or `Done` for a move in place.
    pub early: Option<Outcome>,
}

/// The events of the insertion engine at an edge. The blocks of runs see the events that end items or that
/// take vertices one clock later.
#[derive(Clone, Copy, Debug, Default)]
pub(in super::super) struct Events {
    /// The completed visit ends the item of its context: its attempt hands its ring over, or a vertex has the point.
    pub ends: Option<ItemEnd>,
    /// The hole of a deleted vertex is full, or the vertex cannot be deleted.
    pub fill_ends: Option<ItemEnd>,
    /// A solo insertion has ended.
    pub solo_ends: Option<ItemEnd>,
    /// A root visit has completed, for this context and record.
    pub root: Option<(usize, u32)>,
    /// The last write of a commit is requested; its context and its new vertex.
    pub committed: Option<(usize, u32)>,
    /// A vertex is out of the mesh and goes back into it: the context of its item.
    pub put_out: Option<usize>,
    /// The vertex that a context takes without an item.
    pub taken: Option<u32>,
    /// The vertex memory is asked for a point of a hole.
    pub fetches: bool,
    /// The item that begins.
    pub launch: Option<Launch>,
    /// Whether no visit is in flight and no lock is held.
    pub all_rest: bool,
    /// A point of an `Insert` that comes.
    pub arrival: Option<(u32, Point)>,
    /// Number of ids that are in use.
    pub arrived: u32,
}

impl Events {
    /// These events, but with those of an earlier clock that end items or take vertices.
    pub(super) fn with_ends_of(&self, earlier: &Self) -> Self {
        let Self { ends, fill_ends, solo_ends, committed, put_out, taken, .. } = *earlier;
        Self { ends, fill_ends, solo_ends, committed, put_out, taken, ..*self }
    }
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
