//! Writes into the triangle memory.

use super::widths::{TriangleId, VertexId};
use rust_hdl_core::prelude::*;

crate::packed! {
    /// A write into the triangle memory: a record, or one link.
    pub struct Write {
        /// There is a write.
        pub valid: bool,
        /// The record written.
        pub id: TriangleId,
        /// The vertex columns are written.
        pub vertices: bool,
        /// Link column 0 is written.
        pub link0: bool,
        /// Link column 1 is written.
        pub link1: bool,
        /// Link column 2 is written.
        pub link2: bool,
        /// Data of the columns.
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        pub n0: TriangleId,
        pub n1: TriangleId,
        pub n2: TriangleId,
    }

    /// What of a [`Write`] is written into the memories, and where.
    pub struct WriteEnables {
        /// The vertex columns.
        pub vertices: bool,
        /// Link column 0.
        pub link0: bool,
        /// Link column 1.
        pub link1: bool,
        /// Link column 2.
        pub link2: bool,
        /// The record, for the vertex columns.
        pub vertices_id: TriangleId,
        /// The record, for the link columns.
        pub links_id: TriangleId,
    }
}
