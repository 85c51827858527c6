//! What the Verilog of blocks, cores and devices passes: lint, synthesis, proofs, and the list of clock crossings.

mod blocks;
mod core;
mod crossings;
mod proofs;
mod refusals;
mod serial;
mod stream;
