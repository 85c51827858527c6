//! Tests of the blocks in `hdl/src/living`.

mod change_ends;
mod item_queues;
mod late_points;
mod near_search;
mod next_item;
mod part_queue;
mod question_step;
mod questions;
mod return_line;
mod run_gate;
mod run_port;
mod standing_view;
mod vertex_check;
