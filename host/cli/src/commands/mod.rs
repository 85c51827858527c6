//! The subcommands, a file each.

pub mod bench;
pub mod bench_batch;
mod bench_sets;
mod clip;
pub mod completions;
pub mod devices;
pub mod generate;
pub mod info;
pub mod interpolate;
mod interpolate_device;
pub mod lloyd;
pub mod man;
mod plan_files;
pub mod replay;
pub mod tile;
pub mod triangulate;
mod triangulate_large;
mod verdict;
pub mod verify;
pub mod verify_large;
pub mod voronoi;
