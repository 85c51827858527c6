//! The state of a solo insertion: its phase, and the part of the star that is at work.

use crate::engine::types::{TriangleId, VertexId};
use rust_hdl_core::prelude::*;

crate::packed! {
    /// The phase of a solo insertion; at most one bit is high.
    pub struct SoloPhase {
        pub is_locate: bool,
        pub is_split: bool,
        pub is_mend: bool,
        pub is_fetch: bool,
        pub is_test: bool,
        pub is_flip: bool,
    }

    /// The write of a solo insertion; at most one bit is high.
    pub struct SoloTurn {
        /// The split writes its first, second or third record.
        pub split1: bool,
        pub split2: bool,
        pub split3: bool,
        /// The flip writes its first or second record.
        pub flip1: bool,
        pub flip2: bool,
        /// The first or the second link is mended after the split.
        pub mend1: bool,
        pub mend2: bool,
    }

    /// The star record at work.
    pub struct StarTriangle {
        pub id: TriangleId,
        /// The edge against the record outside, from `a` to `b`.
        pub a: VertexId,
        pub b: VertexId,
        /// The record outside; and the record to which that one leads back as its neighbour (`back`).
        pub outer: TriangleId,
        pub back: TriangleId,
        /// The star records after and before this one.
        pub after: TriangleId,
        pub preceding: TriangleId,
    }

    /// The record outside the star record at work: its apex, and its neighbours beyond `a` and `b`, which
    /// the flip hands on.
    pub struct Beyond {
        pub apex: VertexId,
        pub apex_after_a: TriangleId,
        pub apex_before_b: TriangleId,
    }
}
