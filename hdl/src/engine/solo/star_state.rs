//! What an insertion alone knows of the star that it turns round.

use crate::engine::types::{TriangleId, VertexId};
use rust_hdl_core::prelude::*;

crate::packed! {
    /// What is done; at most one.
    pub struct SoloPhase {
        pub is_locate: bool,
        pub is_split: bool,
        pub is_mend: bool,
        pub is_fetch: bool,
        pub is_test: bool,
        pub is_flip: bool,
    }

    /// What is written; at most one.
    pub struct SoloTurn {
        /// The split writes its first, second, third record.
        pub split1: bool,
        pub split2: bool,
        pub split3: bool,
        /// The flip writes its first, second record.
        pub flip1: bool,
        pub flip2: bool,
        /// A link is mended, the first or second after the split.
        pub mend1: bool,
        pub mend2: bool,
    }

    /// The star triangle at work.
    pub struct StarTriangle {
        pub id: TriangleId,
        /// Its edge against the triangle outside.
        pub a: VertexId,
        pub b: VertexId,
        /// The triangle outside, and the link by which that one leads back.
        pub outer: TriangleId,
        pub back: TriangleId,
        /// The star triangles after and before it.
        pub after: TriangleId,
        pub preceding: TriangleId,
    }

    /// The triangle outside the star triangle at work: its apex, and its links beyond `a` and `b`, which the flip hands on.
    pub struct Beyond {
        pub apex: VertexId,
        pub apex_after_a: TriangleId,
        pub apex_before_b: TriangleId,
    }
}
