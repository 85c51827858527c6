//! When a command word is taken.
//!
//! 1. The fourth point waits until the first three are known to span a triangle; in a batch so does the one behind the three of each job.
//!
//! Latency: none (combinational).

use super::types::EngineState;
use rust_hdl_core::prelude::*;

/// When a command word is taken; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct CommandGate {
    /// What the next word means.
    pub is_command: Signal<In, Bit>,
    pub is_argument: Signal<In, Bit>,
    pub is_points: Signal<In, Bit>,
    /// The core is not ready for commands yet.
    pub sweeps: Signal<In, Bit>,
    /// All points of the command have come.
    pub none_is_left: Signal<In, Bit>,
    /// The point before is being stored.
    pub came: Signal<In, Bit>,
    pub engine: Signal<In, EngineState>,
    /// A word is taken.
    pub ready: Signal<Out, Bit>,
    /// It is a command; it is a point.
    pub takes_command: Signal<Out, Bit>,
    pub takes_point: Signal<Out, Bit>,
    /// A point may come.
    pub awaits_point: Signal<Out, Bit>,
    is_held: Signal<Local, Bit>,
}

impl Logic for CommandGate {
    #[hdl_gen]
    fn update(&mut self) {
        self.is_held.next = self.engine.val().start_is_open & (!self.engine.val().stuck);
        self.awaits_point.next = self.is_points.val() & (!self.none_is_left.val());
        self.takes_command.next = self.is_command.val() & (!self.sweeps.val());
        self.takes_point.next = self.awaits_point.val() & (!self.came.val()) & (!self.is_held.val());
        self.ready.next = self.is_argument.val() | self.takes_command.val() | self.takes_point.val();
    }
}
