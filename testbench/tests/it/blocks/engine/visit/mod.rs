//! Tests of the blocks in `hdl/src/engine/visit`.

mod issue;
mod push_port;
mod verdict_logic;
mod visit_judge;
mod visit_pipeline;
mod visit_reader;
