//! Lock-step, end-to-end and gate tests of incircle.
//!
//! The library holds what several tests share: [`gate`], which the Verilog of every block passes, [`blocks`], every exported
//! block as a model that runs, [`lockstep`], the core beside its model, [`cycles`], what a job takes, and [`peers`], what others take.

pub mod blocks;
pub mod cycles;
pub mod gate;
pub mod lockstep;
pub mod peers;
