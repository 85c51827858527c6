//! Tests of each block by itself: its Rust behaviour, its Verilog and plain code must agree.

mod cluster;
mod commands;
mod engine;
mod ethernet;
mod leaf;
mod living;
mod mesh;
mod predicate;
mod serial;
mod stream;
mod udp;
