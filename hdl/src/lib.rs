//! The incircle core in rust-hdl, and its export to Verilog.

pub mod committed;
pub mod engine;
pub mod export;
pub mod leaf;
pub mod link;
pub mod mesh;
pub mod predicate;
pub mod serial;
pub mod top;
