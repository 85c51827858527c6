//! The incircle core in rust-hdl, and its export to Verilog.

pub mod export;
pub mod leaf;
