//! Lock-step, end-to-end and gate tests of incircle.
//!
//! The library holds what several tests share: [`gate`], which the Verilog of every block passes, [`blocks`], every exported
//! block as a model that runs, [`card`], the driver of PCIe cards before simulated ones, [`crossings`], what passes between two clocks, [`lockstep`], the core beside its model, [`cycles`], what a job takes, [`peers`], what others take, and
//! [`link`], the driver of the serial link before simulated boards.

pub mod blocks;
pub mod card;
pub mod crossings;
pub mod cycles;
pub mod gate;
pub mod link;
pub mod lockstep;
pub mod peers;
