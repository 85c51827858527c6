//! The incircle core in rust-hdl, and its export to Verilog.
