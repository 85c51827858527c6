//! Writes into the triangle memory.

use super::widths::{TriangleId, VertexId};
use rust_hdl_core::prelude::*;

crate::packed! {
    /// A write into the triangle memory: a whole record, or one *link*, the id of one neighbour in a record.
    pub struct Write {
        /// A write is made; without it all other fields are arbitrary.
        pub valid: bool,
        /// The record that is written.
        pub id: TriangleId,
        /// The three vertices are written.
        pub vertices: bool,
        /// The neighbour in this slot is written, for slots 0 to 2.
        pub link0: bool,
        pub link1: bool,
        pub link2: bool,
        /// The vertices, and the neighbours: `n0` lies opposite `v0`.
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        pub n0: TriangleId,
        pub n1: TriangleId,
        pub n2: TriangleId,
    }

    /// The part of a [`Write`] that concerns the memories, from registers of its own.
    pub struct WriteEnables {
        /// The three vertices are written.
        pub vertices: bool,
        /// The neighbour in this slot is written, for slots 0 to 2.
        pub link0: bool,
        pub link1: bool,
        pub link2: bool,
        /// The record that is written: once for the memories of the vertices, once for those of the neighbours.
        pub vertices_id: TriangleId,
        pub links_id: TriangleId,
    }
}
