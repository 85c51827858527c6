//! Visits on their way through the pipeline.

use super::widths::{ContextId, RingEntry, Slot, TriangleId, VertexId};
use crate::predicate::Point;
use rust_hdl_core::prelude::*;

/// Bits of [`Visit`].
pub const VISIT_BITS: usize = Visit::BITS;

/// Bits of [`Bundle`].
pub const BUNDLE_BITS: usize = Bundle::BITS;

/// Bits of [`Turned`].
pub const TURNED_BITS: usize = Turned::BITS;

crate::packed! {
    /// One visit of a record.
    pub struct Visit {
        /// The context it belongs to.
        pub context: ContextId,
        /// The record is turned so that its link to `cavity_record` comes first.
        pub rotates: bool,
        /// The record's lock is taken.
        pub locks: bool,
        /// Ring entry whose edge is tested.
        pub entry: RingEntry,
        /// The entry after it.
        pub after: RingEntry,
        /// The entry that was allocated when `cavity_record` joined the cavity; 0 for the root.
        pub cavity_entry: RingEntry,
        /// The cavity triangle behind the edge.
        pub cavity_record: TriangleId,
        /// The record visited.
        pub record: TriangleId,
    }

    /// One to three visits that one completion asks for. The second visit has `entry = after` of the first, and the third `entry =
    /// second_after` and `after = 0`; all other fields are those of the first.
    pub struct Bundle {
        /// There is a second visit.
        pub is_pair: bool,
        /// There are a second and a third visit; `is_pair` is set too.
        pub is_triple: bool,
        pub context: ContextId,
        pub rotates: bool,
        pub locks: bool,
        pub entry: RingEntry,
        pub after: RingEntry,
        pub cavity_entry: RingEntry,
        pub cavity_record: TriangleId,
        pub record: TriangleId,
        /// `after` of the second visit.
        pub second_after: RingEntry,
        /// `record` of the second visit.
        pub second_record: TriangleId,
        /// `record` of the third visit.
        pub third_record: TriangleId,
    }

    /// A record that has been read and turned.
    pub struct Turned {
        /// Vertices, counter-clockwise.
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        /// Links; `n0` is opposite `v0`.
        pub n0: TriangleId,
        pub n1: TriangleId,
        pub n2: TriangleId,
        /// The stored slot that now comes first.
        pub slot: Slot,
        /// The visit took the record's lock.
        pub took: bool,
        /// It would have, but another context holds it, or it was being cleared.
        pub foreign: bool,
        /// The record was not written yet, or being written: a walk must look again.
        pub again: bool,
        /// That vertex is the infinite one.
        pub infinite0: bool,
        pub infinite1: bool,
        pub infinite2: bool,
    }

    /// What a visit found out. Fields that a visit does not need hold what came out all the same.
    pub struct Verdict {
        /// The record goes when the point comes.
        pub conflict: bool,
        /// The point lies in this triangle, or strictly beyond this hull edge.
        pub located: bool,
        /// The point falls onto a corner.
        pub falls_onto_corner: bool,
        /// The point lies left of `v0 v1`.
        pub is_left: bool,
        /// The point lies on the line `v0 v1`.
        pub is_straight: bool,
        /// Where a walk goes on.
        pub walk_next: TriangleId,
    }

    /// A visit that completes in the next clock, and its record turned.
    pub struct Upcoming {
        /// There is one.
        pub done: bool,
        pub visit: Visit,
        pub turned: Turned,
    }

    /// A visit that completes.
    pub struct Completion {
        /// There is one.
        pub done: bool,
        pub visit: Visit,
        pub turned: Turned,
        pub verdict: Verdict,
    }

    /// Visits to make.
    pub struct Push {
        /// There are some.
        pub valid: bool,
        pub bundle: Bundle,
    }

    /// The visits that follow one that completes.
    pub struct Follow {
        /// There are some.
        pub asks: bool,
        /// There may be some, as far as is known soon. Whoever asks also may ask.
        pub may_ask: bool,
        pub bundle: Bundle,
    }

    /// A record that a read-out wants.
    pub struct RecordRead {
        pub valid: bool,
        pub id: TriangleId,
    }

    /// The point that a context inserts from now on.
    pub struct Position {
        pub valid: bool,
        pub context: ContextId,
        pub point: Point,
    }
}
