//! What is read from the memories of the mesh.

use crate::engine::types::{TriangleId, VertexId};
use rust_hdl_core::prelude::*;

crate::packed! {
    /// A record as it is stored, and its lock.
    pub struct Record {
        /// Vertices, counter-clockwise.
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        /// Links; `n0` is opposite `v0`.
        pub n0: TriangleId,
        pub n1: TriangleId,
        pub n2: TriangleId,
        /// The lock was set.
        pub was_set: bool,
    }

    /// A record that has been read out.
    pub struct ReadRecord {
        /// There is one.
        pub valid: bool,
        pub record: Record,
    }
}
