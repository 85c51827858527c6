//! The blocks of `hdl/src/engine/dispatch`.

mod context_flags;
mod next_point;
mod plan_table;
mod progress;
mod starter;
mod watchdog;
