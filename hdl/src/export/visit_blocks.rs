//! The blocks that a visit passes: memories, queue, reader, verdict, cavity and the writes that follow.

use super::block;
use crate::engine::{LinkWrite, RecordWrite, SeedWrites, VerdictLogic, WritePort};
use crate::mesh::{TriangleStore, VertexStore};

/// The name of each root module, and its Verilog.
pub(super) fn visit_blocks() -> Vec<(String, String)> {
    vec![
        block(TriangleStore::new(5, 4), "triangle_store_5_4"),
        block(TriangleStore::new(15, 15), "triangle_store_15"),
        block(VertexStore::new(3), "vertex_store_3"),
        block(VertexStore::new(14), "vertex_store_14"),
        block(VerdictLogic::default(), "verdict_logic"),
        block(SeedWrites::default(), "seed_writes"),
        block(WritePort::default(), "write_port"),
        block(RecordWrite::default(), "record_write"),
        block(LinkWrite::default(), "link_write"),
    ]
}
