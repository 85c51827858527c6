//! What the counters count.

use super::widths::{Clocks, RingCount};
use rust_hdl_core::prelude::*;

crate::packed! {
    /// What visits do at an edge, for the counters.
    pub struct VisitEvents {
        /// A visit of a walk, of a root, a test; of an insertion alone, too.
        pub walk_visit: bool,
        pub root_visit: bool,
        pub test: bool,
        /// It is made again.
        pub revisit: bool,
        /// A list overflows.
        pub overflows: bool,
        /// A flip of an insertion alone is finished.
        pub flip: bool,
        /// An attempt is given up for a foreign lock; a root had changed.
        pub aborts: bool,
        pub root_changed: bool,
        /// The priority is taken.
        pub takes_priority: bool,
        /// A ring is finished; its cavity's triangles.
        pub cavity_ends: bool,
        pub cavity_triangles: RingCount,
    }

    /// What happens in the engine at an edge, for the counters.
    pub struct Events {
        pub visits: VisitEvents,
        /// The first triangle is finished: three points are inserted.
        pub seeds: bool,
        /// A commit is finished; when its point was taken.
        pub commit_ends: bool,
        pub since: Clocks,
        /// An insertion alone is finished; it finds a duplicate.
        pub solo_inserts: bool,
        pub solo_duplicate: bool,
        /// A duplicate is found.
        pub duplicate: bool,
        /// A visit is issued; a record or a link is written; a commit is at work; a lock is released.
        pub is_issuing: bool,
        pub is_writing: bool,
        pub is_committing: bool,
        pub is_releasing: bool,
    }
}
