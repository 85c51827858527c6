//! Decides whether the core takes the word that the command stream offers.
//!
//! 1. The fourth point waits until the core knows whether the first three span a triangle. In a batch, the point behind
//!    the first three of each job waits.
//! 2. A word of zeros in place of a command is taken and ignored.
//!
//! Latency: none (combinational) from a word to `taken`.

use super::channels::CommandSink;
use super::types::{CommandState, TakenWord};
use crate::engine::EngineState;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct CommandGate {
    pub command: CommandSink,
    /// Meaning of the next word.
    pub state: Signal<In, CommandState>,
    /// The core is clearing memories and is not ready for commands.
    pub sweeps: Signal<In, Bit>,
    /// All points of the command have come.
    pub none_is_left: Signal<In, Bit>,
    /// The point before is being stored at this edge.
    pub came: Signal<In, Bit>,
    pub engine: Signal<In, EngineState>,
    /// The word that the core takes at this edge.
    pub taken: Signal<Out, TakenWord>,
    /// The next word may be a point.
    pub awaits_point: Signal<Out, Bit>,
    /// In a core with changes: the last point still waits for its context.
    pub point_waits: Vec<Signal<In, Bit>>,
    is_held: Signal<Local, Bit>,
    may_be_point: Signal<Local, Bit>,
    takes_command: Signal<Local, Bit>,
    takes_argument: Signal<Local, Bit>,
    takes_point: Signal<Local, Bit>,
    is_some: Signal<Local, Bit>,
}

impl CommandGate {
    /// The gate of a core with changes.
    pub fn with_changes() -> Self {
        Self { point_waits: vec![Signal::default()], ..Self::default() }
    }
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
        for i in 0..self.point_waits.len() {
            if self.point_waits[i].val() {
                self.takes_point.next = false;
            }
        }
        self.command.ready.next = self.takes_argument.val() | self.takes_command.val() | self.takes_point.val();
        self.is_some.next = self.command.data.val().any();
        self.taken.next.is_command = self.command.valid.val() & self.takes_command.val() & self.is_some.val();
        self.taken.next.is_point = self.command.valid.val() & self.takes_point.val();
        self.taken.next.word = self.command.data.val();
    }
}
