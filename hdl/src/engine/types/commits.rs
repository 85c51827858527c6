//! Finished rings and locks to release.

use super::attempts::Entry;
use super::widths::{Clocks, ContextId, LockCount, RingCount, TriangleId, VertexId};
use rust_hdl_core::prelude::*;

/// Bits of [`CommitJob`].
pub const COMMIT_JOB_BITS: usize = CommitJob::BITS;

/// Bits of [`ReleaseJob`].
pub const RELEASE_JOB_BITS: usize = ReleaseJob::BITS;

crate::packed! {
    /// A finished ring, to be committed.
    pub struct CommitJob {
        /// Its context.
        pub context: ContextId,
        /// The new vertex.
        pub vertex: VertexId,
        /// Inner triangles.
        pub inners: RingCount,
        /// Locks in the log.
        pub locks: LockCount,
        /// When the point was taken.
        pub since: Clocks,
    }

    /// The locks of an attempt, to be released.
    pub struct ReleaseJob {
        /// Its context.
        pub context: ContextId,
        /// Locks in the log, at least one.
        pub locks: LockCount,
    }

    /// A ring is finished.
    pub struct CommitRequest {
        pub valid: bool,
        pub job: CommitJob,
    }

    /// Locks are due.
    pub struct ReleaseRequest {
        pub valid: bool,
        pub job: ReleaseJob,
    }

    /// The entry at the head of the ring reader.
    pub struct RingHead {
        pub valid: bool,
        pub entry: Entry,
        /// It ends its ring.
        pub is_last: bool,
        /// The same cavity triangle lies behind the entry before it, or behind the first of its ring.
        pub shares: bool,
    }

    /// A ring is written.
    pub struct Committed {
        pub valid: bool,
        pub job: CommitJob,
        /// A record of its star.
        pub hint: TriangleId,
    }

    /// A lock to clear.
    pub struct LockClear {
        pub valid: bool,
        pub id: TriangleId,
    }

    /// The last lock of a context is released.
    pub struct Released {
        pub valid: bool,
        pub context: ContextId,
    }
}
