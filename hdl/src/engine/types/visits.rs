//! Visits on their way through the pipeline.

use super::widths::{ContextId, RingEntry, Slot, TriangleId, VertexId};
use crate::predicate::Point;
use rust_hdl_core::prelude::*;

/// Width of [`Visit`] in bits.
pub const VISIT_BITS: usize = Visit::BITS;

/// Width of [`Bundle`] in bits.
pub const BUNDLE_BITS: usize = Bundle::BITS;

/// Width of [`Turned`] in bits.
pub const TURNED_BITS: usize = Turned::BITS;

crate::packed! {
    /// One visit of a record. A visit of a walk has neither `rotates` nor `locks`, a root visit has `locks` alone, and
    /// a test has both. Visits of a solo insertion never lock.
    pub struct Visit {
        /// The context that the visit belongs to.
        pub context: ContextId,
        /// The record is rotated so that its neighbour `cavity_record` comes first.
        pub rotates: bool,
        /// The visit takes the lock of the record.
        pub locks: bool,
        /// The ring entry whose edge is tested.
        pub entry: RingEntry,
        /// The ring entry that follows `entry`.
        pub after: RingEntry,
        /// The ring entry that was allocated when `cavity_record` joined the cavity; 0 for the root.
        pub cavity_entry: RingEntry,
        /// The cavity record from which the tested edge was reached.
        pub cavity_record: TriangleId,
        /// The record that is visited.
        pub record: TriangleId,
    }

    /// One to three visits that one completed visit asks for. The second visit has `entry = after` of the first, and
    /// the third has `entry = second_after` and `after = 0`. Each visit has a record of its own, and all other fields
    /// are those of the first visit; see [`Visit`].
    pub struct Bundle {
        /// The bundle has a second visit.
        pub is_pair: bool,
        /// The bundle has a third visit; `is_pair` is set too.
        pub is_triple: bool,
        pub context: ContextId,
        pub rotates: bool,
        pub locks: bool,
        pub entry: RingEntry,
        pub after: RingEntry,
        pub cavity_entry: RingEntry,
        pub cavity_record: TriangleId,
        pub record: TriangleId,
        /// The fields of the second visit that differ from the first: its `after` and its `record`.
        pub second_after: RingEntry,
        pub second_record: TriangleId,
        /// The record of the third visit.
        pub third_record: TriangleId,
    }

    /// A record that has been read and rotated.
    pub struct Turned {
        /// The three vertices, counter-clockwise.
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        /// The three neighbours; `n0` lies opposite `v0`.
        pub n0: TriangleId,
        pub n1: TriangleId,
        pub n2: TriangleId,
        /// The stored slot that has become slot 0.
        pub slot: Slot,
        /// The visit took the lock of the record, which was clear before.
        pub took: bool,
        /// The visit wanted the lock and did not get it: another context holds it, or it was being
        /// cleared in that clock.
        pub foreign: bool,
        /// The record was not written yet, or was being written: vertices, neighbours and slot are arbitrary, and a
        /// walk must visit the record again.
        pub again: bool,
        /// Flags of the vertices `v0` to `v2`: the infinite vertex.
        pub infinite0: bool,
        pub infinite1: bool,
        pub infinite2: bool,
    }

    /// The findings of a visit. Fields that its kind of visit does not need are arbitrary.
    pub struct Verdict {
        /// The record conflicts with the point.
        pub conflict: bool,
        /// The record holds the point: the point lies in the triangle, or strictly beyond the hull edge
        /// of the ghost triangle.
        pub located: bool,
        /// The point equals a corner of the triangle.
        pub falls_onto_corner: bool,
        /// The point lies left of the line from `v0` to `v1`.
        pub is_left: bool,
        /// The point lies on the line through `v0` and `v1`.
        pub is_straight: bool,
        /// The neighbour to which a walk goes on.
        pub walk_next: TriangleId,
    }

    /// The corner of a visited record that is nearest to the place of a question, and the search round it: see
    /// [`NearLogic`](crate::engine::NearLogic).
    pub struct NearVerdict {
        /// The slot of the corner in the record as rotated.
        pub slot: Slot,
        /// A search that begins in the record has a chain to the right, and one to the left.
        pub begins_right: bool,
        pub begins_left: bool,
        /// A chain to the right that has come to the record goes on, and one to the left.
        pub goes_right: bool,
        pub goes_left: bool,
    }

    /// A visit that completes in the next clock, with its record; its verdict is not known yet.
    pub struct Upcoming {
        /// A visit completes in the next clock; without it the rest is arbitrary.
        pub done: bool,
        pub visit: Visit,
        pub turned: Turned,
    }

    /// A visit that completes in this clock.
    pub struct Completion {
        /// A visit completes in this clock; without it the rest is arbitrary.
        pub done: bool,
        pub visit: Visit,
        pub turned: Turned,
        pub verdict: Verdict,
    }

    /// Visits for the queue.
    pub struct Push {
        /// A bundle enters the queue at this edge.
        pub valid: bool,
        pub bundle: Bundle,
    }

    /// The visits that follow a completed visit.
    pub struct Follow {
        /// The completed visit asks for the bundle.
        pub asks: bool,
        /// The completed visit may ask for the bundle, as far as is known early. Whenever `asks` is
        /// high, so is `may_ask`.
        pub may_ask: bool,
        pub bundle: Bundle,
    }

    /// A read-out wants the record `id`.
    pub struct RecordRead {
        pub valid: bool,
        pub id: TriangleId,
    }

    /// The coordinates of the point that a context inserts from now on.
    pub struct Position {
        pub valid: bool,
        pub context: ContextId,
        pub point: Point,
    }
}
