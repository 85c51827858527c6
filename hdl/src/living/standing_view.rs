//! Collects the state of the core on which runs depend.
//!
//! 1. Runs can be done as soon as the first triangle has a record. They cannot be done on a batch, which has a mesh for
//!    each of its jobs, nor after a report of the watchdog.
//!
//! Latency: none, the block is combinational.

use super::types::Standing;
use crate::commands::types::Clearing;
use crate::engine::{Deal, EngineState};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct StandingView {
    /// The next word is a command.
    pub awaits_command: Signal<In, Bit>,
    pub clearing: Signal<In, Clearing>,
    pub deal: Signal<In, Deal>,
    pub state: Signal<In, EngineState>,
    /// Number of this engine on the chip; a constant.
    pub engine: Signal<In, Bits<8>>,
    pub standing: Signal<Out, Standing>,
    one_job: Signal<Local, Bits<5>>,
}

impl Logic for StandingView {
    #[hdl_gen]
    fn update(&mut self) {
        self.one_job.next = 1.into();
        self.standing.next.awaits_command = self.awaits_command.val();
        self.standing.next.clears = self.clearing.val().clears;
        self.standing.next.tag = self.clearing.val().tag;
        self.standing.next.engine = self.engine.val();
        self.standing.next.contexts = self.deal.val().contexts;
        self.standing.next.has_mesh =
            self.state.val().records.any() & (self.deal.val().jobs == self.one_job.val()) & (!self.state.val().stuck);
    }
}
