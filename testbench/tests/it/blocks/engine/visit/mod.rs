//! Tests of the blocks in `hdl/src/engine/visit`.

mod issue;
mod moved_star;
mod near_corner;
mod near_logic;
mod push_port;
mod verdict_logic;
mod visit_judge;
mod visit_pipeline;
mod visit_reader;
