//! Binding to Verilator: build-time translation of Verilog and a run-time handle with ports by name.
