//! What visits make of an attempt, and what becomes of its context.

use super::widths::{ContextId, LockCount, RingCount, RingEntry, Slot, TriangleId, VertexId};
use rust_hdl_core::prelude::*;

/// Bits of [`Entry`].
pub const ENTRY_WORD_BITS: usize = Entry::BITS;

/// Bits of [`Attempt`].
pub const ATTEMPT_BITS: usize = Attempt::BITS;

crate::packed! {
    /// The state of a context's cavity, from the visit that locks its root. `half_open` comes last: a memory keeps as many of its
    /// bits as a ring has entries.
    pub struct Attempt {
        /// It has failed: its visits run out.
        pub drains: bool,
        /// Visits pushed and not completed.
        pub outstanding: RingCount,
        /// Ring entries.
        pub count: RingCount,
        /// Cavity triangles without a boundary edge.
        pub inners: RingCount,
        /// Locks in the log.
        pub logged: LockCount,
        /// Bit `y`: one of the two edges that entry `y`'s cavity triangle brought has been passed. The root brought three and uses
        /// bits 0 and 1.
        pub half_open: Bits<64>,
    }

    /// A final edge of the boundary, from `first_vertex` to that of the next entry.
    pub struct Entry {
        /// Its first vertex.
        pub first_vertex: VertexId,
        /// The triangle outside.
        pub outside_record: TriangleId,
        /// The slot of `outside_record` that leads to `cavity_record`.
        pub slot: Slot,
        /// The cavity triangle behind the edge.
        pub cavity_record: TriangleId,
        /// The entry after this one.
        pub after: RingEntry,
    }

    /// What a visit that completes means for its context. At most one of `looks` to `root_duplicate` is high.
    pub struct Case {
        /// A visit completes.
        pub is_done: bool,
        /// Which kind of visit it is.
        pub is_walk: bool,
        pub is_root: bool,
        pub is_test: bool,
        /// The look at the first three points.
        pub looks: bool,
        /// The same visit is made again; because another context holds the lock.
        pub revisits: bool,
        pub waits: bool,
        /// The walk goes on; it has found the point's triangle.
        pub walks_on: bool,
        pub locates: bool,
        /// The root is locked and holds the point: its neighbours are tested.
        pub opens: bool,
        /// The root no longer holds the point.
        pub root_changed: bool,
        /// A test passes through its edge; its edge is final.
        pub splits: bool,
        pub settles: bool,
        /// A test would pass, and the list is full.
        pub overflows: bool,
        /// Another context holds the lock, of the root or of a tested triangle.
        pub aborts_root: bool,
        pub aborts: bool,
        /// The point falls onto a corner.
        pub walk_duplicate: bool,
        pub root_duplicate: bool,
        /// Visits follow: it repeats, walks on, locates, opens or splits; they may.
        pub asks: bool,
        pub may_ask: bool,
    }

    /// What a test makes of its attempt.
    pub struct Step {
        /// No visit of the attempt is out any more.
        pub is_over: bool,
        /// And it has not failed: the ring is finished.
        pub succeeds: bool,
        /// The cavity triangle behind the edge has no boundary edge left.
        pub finds_inner: bool,
        /// The second edge of the root is passed.
        pub passes_root: bool,
    }

    /// What becomes of the context whose visit completes.
    pub struct Outcome {
        pub context: ContextId,
        /// None of its visits is out any more.
        pub sleeps: bool,
        /// It will try its point again.
        pub will_retry: bool,
        /// A commit or a release of it is due.
        pub hands_over: bool,
        /// It wants the priority; meets a foreign lock with it; needs it no more.
        pub asks_for_priority: bool,
        pub waits: bool,
        pub returns_priority: bool,
        /// Its list has overflowed.
        pub overflows: bool,
        /// Its point is one already.
        pub duplicate: bool,
        /// A root's visit says where a walk for the same point would start next.
        pub root_enable: bool,
        pub root: TriangleId,
    }

    /// A final edge of a boundary, for the list of its context.
    pub struct EntryWrite {
        pub valid: bool,
        pub context: ContextId,
        pub place: RingEntry,
        pub entry: Entry,
    }

    /// An inner triangle, for the list of its context.
    pub struct InnerWrite {
        pub valid: bool,
        pub context: ContextId,
        pub place: RingEntry,
        pub id: TriangleId,
    }

    /// A lock that was taken, for the log of its context.
    pub struct LockWrite {
        pub valid: bool,
        pub context: ContextId,
        pub place: LockCount,
        pub id: TriangleId,
    }
}
