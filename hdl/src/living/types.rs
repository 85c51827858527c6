//! Signals between the blocks of runs.

use crate::engine::types::{ContextId, VertexId, CONTEXT_BITS};
use crate::predicate::Point;
use rust_hdl_core::prelude::*;

/// The number of an item in its run, modulo 2^24: the low bits of the first word of a part.
pub type ItemNumber = Bits<24>;
/// The number of a beat in its part.
pub type BeatNumber = Bits<3>;
/// Number of bits that number the items which wait for a context: 32 at most. With 16, contexts that meet a run of long
/// walks hold up the stream of items: `Locate` at 8,000 uniform points takes 6 % more cycles.
pub const DEPTH_BITS: usize = 5;
/// Number of bits of the address of an item that waits for a context.
pub const QUEUE_ADDRESS_BITS: usize = CONTEXT_BITS + DEPTH_BITS;
/// Number of bits of a count of the items that wait for a context, modulo twice the depth.
pub const QUEUE_COUNT_BITS: usize = DEPTH_BITS + 1;
/// Number of bits that number the parts of an answer that are kept: 32, which is more than there are contexts, so that
/// a context seldom has to wait for room.
pub const PART_ADDRESS_BITS: usize = 5;

crate::packed! {
    /// An item of a run: its place, and for a change its vertex, and whether ids are kept for that. The place of a move
    /// is the one that its vertex leaves, and `target` the new one. The `target` of an `InsertAs` has the ids that are
    /// kept for its vertex, see [`KeptIds`](crate::engine::KeptIds).
    pub struct Item {
        pub number: Bits<24>,
        pub place: Point,
        pub vertex: VertexId,
        pub owns: bool,
        pub target: Point,
    }

    /// An item for a context.
    pub struct DealtItem {
        /// An item is on offer; if not, the other fields are arbitrary.
        pub valid: bool,
        pub context: ContextId,
        pub item: Item,
    }

    /// An item that begins.
    pub struct Launch {
        pub context: ContextId,
        pub item: Item,
    }

    /// A context whose item ends at this edge.
    pub struct ContextEnd {
        pub valid: bool,
        pub context: ContextId,
    }

    /// A vertex that is in the mesh, and the number of its item, whose part is due.
    pub struct DoneItem {
        pub number: Bits<24>,
        pub vertex: VertexId,
    }

    /// The outcome of an item and the vertices that it names, each with its weight. Vertices that it does not name
    /// are 0, and so are their weights and all weights outside the hull. With the outcomes `Missing` and `Full`, the
    /// vertex of the item stands in `w0`, because it can be any word.
    pub struct Finding {
        pub outcome: Bits<4>,
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        pub w0: Bits<32>,
        pub w1: Bits<32>,
        pub w2: Bits<32>,
    }

    /// The part of an answer for one item.
    pub struct Part {
        pub number: Bits<24>,
        pub finding: Finding,
    }

    /// A part that comes at this edge.
    pub struct PartCame {
        pub valid: bool,
        pub part: Part,
    }

    /// The state of a core and of its mesh, as far as runs depend on it.
    pub struct Standing {
        /// The next word is a command.
        pub awaits_command: bool,
        /// The mesh is forgotten at this edge.
        pub clears: bool,
        /// The tag of the last `Clear` and the number of the engine, which stand in the head of each answer.
        pub tag: Bits<8>,
        pub engine: Bits<8>,
        /// Number of contexts that work.
        pub contexts: Bits<5>,
        /// The core has a mesh that runs can ask or change.
        pub has_mesh: bool,
    }

    /// The head of the answer to a run.
    pub struct RunHead {
        /// The answer begins at this edge.
        pub valid: bool,
        pub header: Bits<32>,
        /// Number of words behind the head, and of parts.
        pub length: Bits<32>,
        pub parts: Bits<32>,
        /// Number of the last beat of a part, counted from 0.
        pub last_beat: BeatNumber,
    }
}

/// Number of bits of an [`Item`].
pub const ITEM_BITS: usize = Item::BITS;
/// Number of bits of a [`Launch`].
pub const LAUNCH_BITS: usize = Launch::BITS;
/// Number of bits of a [`DoneItem`].
pub const DONE_BITS: usize = DoneItem::BITS;
/// Number of bits of a [`Part`].
pub const PART_BITS: usize = Part::BITS;
