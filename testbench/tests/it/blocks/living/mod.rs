//! Tests of the blocks in `hdl/src/living`.

mod item_queues;
mod near_search;
mod part_queue;
mod question_step;
mod questions;
mod run_gate;
mod run_port;
mod standing_view;
