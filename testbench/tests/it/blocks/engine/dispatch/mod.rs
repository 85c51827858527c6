//! Tests of the blocks in `hdl/src/engine/dispatch`.

mod context_flags;
mod finished_points;
mod next_point;
mod plan_table;
mod priorities;
mod starter;
mod watchdog;
