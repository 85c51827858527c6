//! The events that the counters count.

use super::widths::{Clocks, RingCount};
use rust_hdl_core::prelude::*;

crate::packed! {
    /// The events of visits at one edge; each flag counts one event.
    pub struct VisitEvents {
        /// A visit of this kind completes: walk, root visit or test. Tests of a solo insertion count too.
        pub walk_visit: bool,
        pub root_visit: bool,
        pub test: bool,
        /// The visit that completes is made again.
        pub revisit: bool,
        /// A test would need one more ring entry than the list of its context has.
        pub overflows: bool,
        /// A solo insertion has finished a flip.
        pub flip: bool,
        /// An attempt aborts at a foreign lock; or (`root_changed`) a root visit finds that the root no
        /// longer conflicts with the point.
        pub aborts: bool,
        pub root_changed: bool,
        /// A context takes the priority.
        pub takes_priority: bool,
        /// A ring is complete, and its cavity has this many records.
        pub cavity_ends: bool,
        pub cavity_triangles: RingCount,
    }

    /// The events of the engine at one edge.
    pub struct Events {
        pub visits: VisitEvents,
        /// A first triangle is complete, which inserts three points.
        pub seeds: bool,
        /// A commit is complete; its context took the point when the clock count was `since`.
        pub commit_ends: bool,
        pub since: Clocks,
        /// A solo insertion has ended: its point is inserted, or the point equals a vertex.
        pub solo_inserts: bool,
        pub solo_duplicate: bool,
        /// A walk or a root visit finds that the point equals a vertex.
        pub duplicate: bool,
        /// The engine does this in this clock: issue a visit, write a record or a link, work on a commit, clear a lock.
        pub is_issuing: bool,
        pub is_writing: bool,
        pub is_committing: bool,
        pub is_releasing: bool,
    }
}
