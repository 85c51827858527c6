//! Tests of the blocks in `hdl/src/engine/attempt`.

mod attempt_lists;
mod attempt_points;
mod attempt_step;
mod attempt_store;
mod attempts;
mod next_visits;
mod visit_case;
