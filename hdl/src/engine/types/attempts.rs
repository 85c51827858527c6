//! The state of an attempt, the meaning of a visit for it, and the consequences for the context.

use super::widths::{ContextId, LockCount, RingCount, RingEntry, Slot, TriangleId, VertexId};
use rust_hdl_core::prelude::*;

/// Width of [`Entry`] in bits.
pub const ENTRY_WORD_BITS: usize = Entry::BITS;

/// Width of [`Attempt`] in bits.
pub const ATTEMPT_BITS: usize = Attempt::BITS;

crate::packed! {
    /// The state of an attempt, from the visit that opens its cavity. `half_open` comes last, because a memory stores
    /// only as many of its bits as a ring has entries.
    pub struct Attempt {
        /// The attempt has aborted and waits until its visits in flight complete.
        pub drains: bool,
        /// The number of tests that are pushed and have not completed.
        pub outstanding: RingCount,
        /// The number of ring entries, which is also the number of the next entry.
        pub count: RingCount,
        /// The number of inner records, which have no edge on the boundary any more.
        pub inners: RingCount,
        /// The number of locks in the log of the context.
        pub logged: LockCount,
        /// Bit `y` belongs to the cavity record that allocated entry `y` and so brought two new edges: one of them has
        /// been passed, that is, the record behind the edge has joined the cavity too. The root uses bits 0 and 1.
        pub half_open: Bits<64>,
    }

    /// An edge that stays on the boundary, from `first_vertex` to the `first_vertex` of the next entry.
    pub struct Entry {
        /// The vertex at which the edge begins, counter-clockwise.
        pub first_vertex: VertexId,
        /// The record outside the cavity at this edge; it stays.
        pub outside_record: TriangleId,
        /// The slot in which `outside_record` names `cavity_record` as its neighbour.
        pub slot: Slot,
        /// The cavity record on the inner side of the edge.
        pub cavity_record: TriangleId,
        /// The next entry of the ring; 0 leads back to the first entry.
        pub after: RingEntry,
    }

    /// The meaning of a completed visit for its context. At most one of `looks` to `root_duplicate` is high, except
    /// that `waits` comes with `revisits`.
    pub struct Case {
        /// A visit completes in this clock; one of the next three flags says of which kind, unless `looks` is high.
        pub is_done: bool,
        pub is_walk: bool,
        pub is_root: bool,
        pub is_test: bool,
        /// The visit is the look at the first three points, before a first triangle exists.
        pub looks: bool,
        /// The same visit is made again; with `waits`, because a foreign lock holds up the context with the priority.
        pub revisits: bool,
        pub waits: bool,
        /// The walk goes on to a neighbour (`walks_on`), or its record conflicts and the
        /// root visit follows (`locates`).
        pub walks_on: bool,
        pub locates: bool,
        /// The root is locked and conflicts with the point: the cavity opens with the tests of the three neighbours.
        pub opens: bool,
        /// The root is locked, but no longer conflicts with the point.
        pub root_changed: bool,
        /// The tested record joins the cavity and its entry splits in two; or it stays and its
        /// entry is final (`settles`).
        pub splits: bool,
        pub settles: bool,
        /// The tested record would join the cavity, but the list has no room for another entry.
        pub overflows: bool,
        /// The attempt aborts because another context holds the lock of the root, or of a tested record (`aborts`).
        pub aborts_root: bool,
        pub aborts: bool,
        /// The point equals a vertex, as a visit of the walk or of the root has found.
        pub walk_duplicate: bool,
        pub root_duplicate: bool,
        /// Visits follow: a revisit, the next step of the walk, the root visit or tests. `may_ask` is known sooner, and
        /// is high whenever `asks` is.
        pub asks: bool,
        pub may_ask: bool,
    }

    /// The effect of a test on its attempt.
    pub struct Step {
        /// The test was the last visit of the attempt that was in flight.
        pub is_over: bool,
        /// The attempt is over and has not aborted: its ring is complete.
        pub succeeds: bool,
        /// The cavity record behind the tested edge has lost its last edge on the boundary.
        pub finds_inner: bool,
        /// The second of the root's three edges is passed.
        pub passes_root: bool,
    }

    /// The consequences of a completed visit for its context.
    pub struct Outcome {
        pub context: ContextId,
        /// None of the context's visits is in flight any more.
        pub sleeps: bool,
        /// The context keeps its point and will retry.
        pub will_retry: bool,
        /// A commit or a release of the context becomes due.
        pub hands_over: bool,
        /// The context aborts and wants the priority; or meets a foreign lock while it holds the priority (`waits`); or
        /// returns the priority, if it holds it, because its point is finished or needs a solo insertion.
        pub asks_for_priority: bool,
        pub waits: bool,
        pub returns_priority: bool,
        /// The list of the context has overflowed: the point needs a solo insertion.
        pub overflows: bool,
        /// The point equals a vertex.
        pub duplicate: bool,
        /// The visit was a root visit: a retry starts its walk at `root`.
        pub root_enable: bool,
        pub root: TriangleId,
    }

    /// A final entry for place `place` in the ring of a context.
    pub struct EntryWrite {
        pub valid: bool,
        pub context: ContextId,
        pub place: RingEntry,
        pub entry: Entry,
    }

    /// An inner record for place `place` in the list of a context.
    pub struct InnerWrite {
        pub valid: bool,
        pub context: ContextId,
        pub place: RingEntry,
        pub id: TriangleId,
    }

    /// A lock that was taken, for place `place` in the log of a context.
    pub struct LockWrite {
        pub valid: bool,
        pub context: ContextId,
        pub place: LockCount,
        pub id: TriangleId,
    }
}
