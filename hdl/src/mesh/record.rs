//! The records that come out of the memories of the mesh.

use crate::engine::types::{TriangleId, VertexId};
use rust_hdl_core::prelude::*;

crate::packed! {
    /// A record as stored, with its lock.
    pub struct Record {
        /// The three vertices, counter-clockwise.
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        /// Ids of the three neighbours; `n0` is opposite `v0`.
        pub n0: TriangleId,
        pub n1: TriangleId,
        pub n2: TriangleId,
        /// The lock was set when the record was read.
        pub was_set: bool,
    }

    /// A record that comes from the memory for the read-out.
    pub struct ReadRecord {
        /// A record has come; otherwise `record` is arbitrary.
        pub valid: bool,
        pub record: Record,
    }
}
