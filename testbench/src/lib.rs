//! Lock-step tests, end-to-end tests and gate tests of incircle.
//!
//! The library holds what several tests share:
//!
//! - [`gate`]: lint and synthesis, which the Verilog of every block has to pass;
//! - [`blocks`]: every exported block as a model that runs;
//! - [`card`]: the driver of PCIe cards in front of simulated cards;
//! - [`crossings`]: what passes between two clocks;
//! - [`lockstep`]: the core beside its model;
//! - [`cycles`]: the clocks that a job takes;
//! - [`peers`]: the time that other triangulators take;
//! - [`link`]: the driver of the serial link in front of simulated boards.

pub mod blocks;
pub mod card;
pub mod crossings;
pub mod cycles;
pub mod gate;
pub mod link;
pub mod lockstep;
pub mod peers;
