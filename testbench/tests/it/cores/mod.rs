//! Tests of whole cores beside their model, and of the cycles that they take.

mod batch;
mod changes;
mod chip;
mod cycles;
mod in_rust;
mod lockstep;
mod netlist;
mod questions;
mod stuck;
