//! Whole cores beside their model, and the cycles they take.

mod batch;
mod cycles;
mod in_rust;
mod lockstep;
mod netlist;
mod stuck;
