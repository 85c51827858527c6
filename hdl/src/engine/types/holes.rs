//! The star of a vertex that is deleted or moved, and the hole that it leaves.

use super::widths::{ContextId, LockCount, RingCount, RingEntry, Slot, TriangleId, VertexId};
use crate::predicate::Point;
use rust_hdl_core::prelude::*;

/// Width of [`Star`] in bits.
pub const STAR_BITS: usize = Star::BITS;
/// Width of [`Hole`] in bits.
pub const HOLE_BITS: usize = Hole::BITS;
/// Width of [`HoleOf`] in bits.
pub const HOLE_OF_BITS: usize = HoleOf::BITS;
/// Width of [`FillJob`] in bits.
pub const FILL_JOB_BITS: usize = FillJob::BITS;
/// Width of [`MovedItem`] in bits.
pub const MOVED_ITEM_BITS: usize = MovedItem::BITS;
/// Width of [`RingWord`] in bits.
pub const RING_WORD_BITS: usize = RingWord::BITS;

crate::packed! {
    /// A star whose records are being visited, from its root on.
    pub struct Star {
        /// The record of each chain that is being visited, or was visited last.
        pub left_head: TriangleId,
        pub right_head: TriangleId,
        /// The last place of the chain to the right, and of that to the left.
        pub first: RingEntry,
        pub last: RingEntry,
        /// The ring has the infinite vertex, at this place.
        pub has_infinite: bool,
        pub infinite: RingEntry,
        /// Some record outside is a triangle and no ghost triangle.
        pub has_triangle: bool,
        /// The attempt waits until its visits in flight complete: it has aborted, or the ring is too long for the list.
        pub drains: bool,
        pub is_too_long: bool,
        /// In a move: all edges stay that have been looked at.
        pub keeps: bool,
        /// Number of visits in flight, of records of the star that were asked for, and of locks.
        pub outstanding: RingCount,
        pub count: RingCount,
        pub logged: LockCount,
        /// One visit is in flight; the list has no room for another record. Both follow from the numbers, and are kept
        /// beside them because a comparison takes long.
        pub is_one: bool,
        pub is_full: bool,
    }

    /// A hole that is being filled. Its interval of the ring runs from `i` to `j`.
    pub struct Hole {
        pub i: RingEntry,
        pub j: RingEntry,
        /// The other side of the base: 0 for the ring edge from `j` on, 1 for the triangle with its apex at `j`, 2 for
        /// that with its apex at `i`.
        pub base: Bits<2>,
        /// The best apex so far, which is the apex if `is_ready`, and the vertex that is tested against it.
        pub best: RingEntry,
        pub challenger: RingEntry,
        pub is_ready: bool,
        /// The end of the first interval; first and last place of the ring.
        pub end: RingEntry,
        pub first: RingEntry,
        pub last: RingEntry,
        /// Number of intervals that wait, at most 14. Each has a vertex of its own between its ends, and begins at an
        /// apex of its own. The interval at work has a vertex, too, and a ring of 32 has 30 between its ends.
        pub depth: Bits<4>,
        /// Nothing may be written, because perhaps no triangle is left.
        pub is_dry: bool,
        /// Number of locks of the attempt.
        pub locks: LockCount,
        /// The hole has just opened: of its interval, the whole ring, only the end is known.
        pub is_new: bool,
    }

    /// The hole of a context.
    pub struct HoleOf {
        pub context: ContextId,
        pub hole: Hole,
    }

    /// The next apex of a hole is known, or the hole opens.
    pub struct HoleCame {
        pub valid: bool,
        pub hole: HoleOf,
    }

    /// A triangle for a hole, or the end of a deletion (`ends`).
    pub struct FillJob {
        pub context: ContextId,
        /// Beginning, apex and end of the interval, and its base as in [`Hole`].
        pub i: RingEntry,
        pub m: RingEntry,
        pub j: RingEntry,
        pub base: Bits<2>,
        /// The ring edge from `i` to `m` is a side of the triangle.
        pub mends: bool,
        pub ends: bool,
        /// The vertex and the number of locks of a deletion that ends.
        pub vertex: VertexId,
        pub locks: LockCount,
    }

    /// A job that comes at this edge.
    pub struct FillRequest {
        pub valid: bool,
        pub job: FillJob,
    }

    /// An edge of a ring: its first vertex, the record outside with the slot that names the record of the star, and the
    /// latter.
    pub struct RingWord {
        pub vertex: VertexId,
        pub outside: TriangleId,
        pub slot: Slot,
        pub record: TriangleId,
    }

    /// The vertices of a test: those of the base, the best apex, and the challenger.
    pub struct TestVertices {
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        pub challenger: VertexId,
    }

    /// The item of a context ends: its hole is full, or no triangle would be left (`is_flat`).
    pub struct FillEnd {
        pub valid: bool,
        pub context: ContextId,
        pub is_flat: bool,
        pub vertex: VertexId,
        pub locks: LockCount,
    }

    /// The item of a move that begins, while a run of them is under way (`runs`): its vertex goes back into the mesh;
    /// or has its new place already; and that place.
    pub struct Moving {
        pub runs: bool,
        pub returns: bool,
        pub stays: bool,
        pub target: Point,
    }

    /// The item of a move at work: its vertex, its new place, and the flags of [`Moving`].
    pub struct MovedItem {
        pub vertex: VertexId,
        pub target: Point,
        pub returns: bool,
        pub stays: bool,
    }

    /// The vertices opposite the last records of the chains of a star, each if it is new.
    pub struct Carried {
        pub context: ContextId,
        pub sets_left: bool,
        pub sets_right: bool,
        pub left: VertexId,
        pub right: VertexId,
    }

    /// Two ids that are free, the vertex that keeps them, and the context that has deleted it.
    pub struct KeptWrite {
        pub valid: bool,
        pub context: ContextId,
        pub vertex: VertexId,
        pub first: TriangleId,
        pub second: TriangleId,
    }
}
