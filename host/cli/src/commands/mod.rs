//! The subcommands.

pub mod bench;
pub mod bench_batch;
pub mod completions;
pub mod devices;
pub mod generate;
pub mod info;
pub mod triangulate;
pub mod verify;
