//! The states of the command port.

use rust_hdl_core::prelude::*;

/// What the next word means, or what is awaited.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum CommandState {
    /// A command.
    Command,
    /// The first id of a read.
    First,
    /// The number of records or points.
    Count,
    /// Points.
    Points,
    /// The engine finishes.
    Settle,
    /// The answer is sent.
    Answer,
}
