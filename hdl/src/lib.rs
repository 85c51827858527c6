//! The incircle core in rust-hdl, its export to Verilog, and the boards on which it runs.

pub mod board;
pub mod cluster;
pub mod commands;
pub mod committed;
pub mod engine;
pub mod ethernet;
pub mod export;
mod files;
pub mod leaf;
pub mod living;
pub mod mesh;
pub mod predicate;
mod prelude;
pub mod serial;
pub mod stream;
pub mod top;
pub mod udp;
