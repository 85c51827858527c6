//! The blocks that a visit passes: memories, queue, reader, verdict, cavity and the writes that follow.

use incircle_protocol::{Config, MAX_RING, SMALL, TINY};

use super::block;
use crate::engine::{
    Cavity, Issue, LinkWrite, RecordWrite, RootBundle, SeedWrites, VerdictLogic, VisitPipeline, VisitReader, WritePort,
};
use crate::mesh::{TriangleStore, VertexStore};

/// The name of each root module, and its Verilog.
pub(super) fn visit_blocks() -> Vec<(String, String)> {
    let longest_list = Config { ring: MAX_RING, ..TINY };
    vec![
        block(TriangleStore::new(5, 4), "triangle_store_5_4"),
        block(TriangleStore::new(15, 15), "triangle_store_15"),
        block(VertexStore::new(3), "vertex_store_3"),
        block(VertexStore::new(14), "vertex_store_14"),
        block(Issue::new(3), "issue_3"),
        block(VisitReader::default(), "visit_reader"),
        block(VerdictLogic::default(), "verdict_logic"),
        block(VisitPipeline::new(TINY), "visit_pipeline_tiny"),
        block(VisitPipeline::new(SMALL), "visit_pipeline_small"),
        block(Cavity::new(TINY), "cavity_6"),
        block(Cavity::new(longest_list), "cavity_64"),
        block(RootBundle::default(), "root_bundle"),
        block(SeedWrites::default(), "seed_writes"),
        block(WritePort::default(), "write_port"),
        block(RecordWrite::default(), "record_write"),
        block(LinkWrite::default(), "link_write"),
    ]
}
