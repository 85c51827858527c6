//! The unfinished work of the model by commands: a command, a range that is read, a run.

use incircle_protocol::{RunKind, ShortIds, Status};

/// The meaning of the next word. The model reads commands with code of its own and not with the protocol's
/// `CommandReader`, because the core's reading is compared with the model's, which must share no code with a
/// host that writes commands.
#[derive(Clone, Copy, Debug)]
pub(super) enum Awaited {
    Command,
    InsertCount,
    Points { left: u32 },
    ReadFirst(Range),
    ReadCount(Range, u32),
    RunCount(RunKind),
    Items(Run),
}

/// The part of the records that a command reads.
#[derive(Clone, Copy, Debug)]
pub(super) enum Range {
    /// Whole records by their ids, the free ones included.
    Records,
    /// The vertices of the records that are not free, counted in the order of their ids.
    Vertices,
    /// The same, with short ids.
    ShortVertices(ShortIds),
}

/// A range that is being read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub(super) range: Range,
    /// Id of the next record that has not been turned into words yet.
    pub(super) next: u32,
    /// Number of records to come.
    pub(super) left: u32,
}

impl Reading {
    pub(super) const NONE: Self = Self { range: Range::Records, next: 0, left: 0 };
}

/// Largest number of words of an item.
pub(super) const MOST_ITEM_WORDS: usize = 3;

/// A run whose items are being taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) kind: RunKind,
    /// Number of items done, and still to come.
    pub(super) done: u32,
    pub(super) left: u32,
    /// Why the items are taken and nothing is done.
    pub(super) refusal: Option<Status>,
    /// The words of the item of which only a part has come, and their number.
    pub(super) words: [u32; MOST_ITEM_WORDS],
    pub(super) filled: usize,
}
