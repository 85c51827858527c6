//! The blocks that a visit passes: memories, queue, reader, verdict, attempt and the writes that follow.

use incircle_protocol::{Config, SMALL, TINY};

use crate::exported::block;
use incircle_hdl::engine::{
    Issue, LinkWrite, MovedStar, NearCorner, NearLogic, RecordWrite, SeedWrites, VerdictLogic, VisitJudge,
    VisitPipeline, VisitReader, WritePort,
};
use incircle_hdl::mesh::{LockStore, TriangleStore, VertexStore};

/// Name of the root module and Verilog of each block.
pub(crate) fn blocks() -> Vec<(String, String)> {
    vec![
        block(LockStore::new(4, 2), "lock_store_4_2"),
        block(LockStore::new(15, 5), "lock_store_15_5"),
        block(TriangleStore::new(5, 4, 1), "triangle_store_5_4_1"),
        block(TriangleStore::new(15, 15, 5), "triangle_store_15_15_5"),
        block(VertexStore::new(3), "vertex_store_3"),
        block(VertexStore::new(14), "vertex_store_14"),
        block(Issue::new(5), "issue_5"),
        block(MovedStar::new(Config { contexts: 8, ..TINY }), "moved_star"),
        block(VisitReader::default(), "visit_reader"),
        block(VerdictLogic::default(), "verdict_logic"),
        block(NearCorner::default(), "near_corner"),
        block(NearLogic::default(), "near_logic"),
        block(VisitJudge::default(), "visit_judge"),
        block(VisitPipeline::new(TINY), "visit_pipeline_tiny"),
        block(VisitPipeline::new(SMALL), "visit_pipeline_small"),
        block(SeedWrites::default(), "seed_writes"),
        block(WritePort::default(), "write_port"),
        block(RecordWrite::default(), "record_write"),
        block(LinkWrite::default(), "link_write"),
    ]
}
