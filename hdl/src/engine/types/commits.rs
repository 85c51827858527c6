//! Complete rings, and locks to release.

use super::attempts::Entry;
use super::widths::{Clocks, ContextId, LockCount, RingCount, TriangleId, VertexId};
use rust_hdl_core::prelude::*;

/// Width of [`CommitJob`] in bits.
pub const COMMIT_JOB_BITS: usize = CommitJob::BITS;

/// Width of [`ReleaseJob`] in bits.
pub const RELEASE_JOB_BITS: usize = ReleaseJob::BITS;

crate::packed! {
    /// A complete ring that waits for its commit.
    pub struct CommitJob {
        /// The context that dug the cavity.
        pub context: ContextId,
        /// The new vertex, around which the star is written.
        pub vertex: VertexId,
        /// The number of inner records, whose ids the star takes first.
        pub inners: RingCount,
        /// The number of locks in the log of the context.
        pub locks: LockCount,
        /// The clock count when the context took the point.
        pub since: Clocks,
    }

    /// The locks of one attempt, which are to be released.
    pub struct ReleaseJob {
        /// The context that holds the locks.
        pub context: ContextId,
        /// The number of locks in the log of the context, at least one.
        pub locks: LockCount,
    }

    /// Asks for the commit of a ring that is complete at this edge.
    pub struct CommitRequest {
        pub valid: bool,
        pub job: CommitJob,
    }

    /// Asks for the release of locks at this edge.
    pub struct ReleaseRequest {
        pub valid: bool,
        pub job: ReleaseJob,
    }

    /// The ring entry that the ring reader offers to the commit.
    pub struct RingHead {
        pub valid: bool,
        pub entry: Entry,
        /// The entry is the last one of its ring.
        pub is_last: bool,
        /// The entry has the same cavity record behind it as the entry before it or as the first entry of its ring, so
        /// it needs another id for its star record.
        pub shares: bool,
    }

    /// The last write of a commit is requested at this edge.
    pub struct Committed {
        pub valid: bool,
        pub job: CommitJob,
    }

    /// The lock of record `id` is cleared at this edge.
    pub struct LockClear {
        pub valid: bool,
        pub id: TriangleId,
    }

    /// The last lock of a context is cleared at this edge.
    pub struct Released {
        pub valid: bool,
        pub context: ContextId,
    }
}
