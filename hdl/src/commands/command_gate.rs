//! When a command word is taken.
//!
//! 1. The fourth point waits until the first three are known to span a triangle; in a batch so does the one behind the three of each job.
//! 2. A word of zeros in place of a command is taken and forgotten.
//!
//! Latency: none (combinational).

use super::channels::CommandSink;
use super::types::{CommandState, TakenWord};
use crate::engine::EngineState;
use rust_hdl_core::prelude::*;

/// When a command word is taken; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct CommandGate {
    pub command: CommandSink,
    /// The meaning of the next word.
    pub state: Signal<In, CommandState>,
    /// The core is not ready for commands yet.
    pub sweeps: Signal<In, Bit>,
    /// All points of the command have come.
    pub none_is_left: Signal<In, Bit>,
    /// The point before is being stored.
    pub came: Signal<In, Bit>,
    pub engine: Signal<In, EngineState>,
    /// A word that is taken.
    pub taken: Signal<Out, TakenWord>,
    /// A point may come.
    pub awaits_point: Signal<Out, Bit>,
    is_held: Signal<Local, Bit>,
    may_be_point: Signal<Local, Bit>,
    takes_command: Signal<Local, Bit>,
    takes_argument: Signal<Local, Bit>,
    takes_point: Signal<Local, Bit>,
    is_some: Signal<Local, Bit>,
}

impl Logic for CommandGate {
    #[hdl_gen]
    fn update(&mut self) {
        self.is_held.next = self.engine.val().start_is_open & (!self.engine.val().stuck);
        self.may_be_point.next = (self.state.val() == CommandState::Points) & (!self.none_is_left.val());
        self.awaits_point.next = self.may_be_point.val();
        self.takes_command.next = (self.state.val() == CommandState::Command) & (!self.sweeps.val());
        self.takes_argument.next =
            (self.state.val() == CommandState::First) | (self.state.val() == CommandState::Count);
        self.takes_point.next = self.may_be_point.val() & (!self.came.val()) & (!self.is_held.val());
        self.command.ready.next = self.takes_argument.val() | self.takes_command.val() | self.takes_point.val();
        self.is_some.next = self.command.data.val().any();
        self.taken.next.is_command = self.command.valid.val() & self.takes_command.val() & self.is_some.val();
        self.taken.next.is_point = self.command.valid.val() & self.takes_point.val();
        self.taken.next.word = self.command.data.val();
    }
}
