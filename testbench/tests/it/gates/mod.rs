//! Tests of the gate that the Verilog of blocks, cores and devices has to pass: lint, synthesis, proofs,
//! and the list of clock crossings.

mod blocks;
mod core;
mod crossings;
mod ethernet;
mod proofs;
mod refusals;
mod serial;
mod stream;
mod udp;
