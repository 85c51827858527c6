//! Each block by itself: its Rust behaviour, its Verilog and plain code say the same.

mod commands;
mod engine;
mod leaf;
mod mesh;
mod predicate;
mod serial;
mod stream;
