//! Reports that no point is finished any more, so that commands are answered with an error instead of silence.
//!
//! 1. `stuck` stays high until reset.
//! 2. The inputs and the comparison go into registers first.
//!
//! Latency: three clocks more than `patience`.
//!
//! With a patience of 4 clocks:
//! ```text
//! is_quiet        /^^\____________________________________________
//! finishes        _________/^^\___________________________________
//! stuck           _________________________________/^^^^^^^^^^^^^^
//! ```

use crate::engine::types::Clocks;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Watchdog {
    pub clock: Signal<In, Clock>,
    /// Reset forgets the fault.
    pub reset: Signal<In, Bit>,
    /// A point is finished at this edge: it is in the mesh, or is known to be a duplicate.
    pub finishes: Signal<In, Bit>,
    /// No work is left.
    pub is_quiet: Signal<In, Bit>,
    /// The number of clocks to wait, a constant; see `patience` of the protocol.
    pub patience: Signal<In, Clocks>,
    /// The fault: that many clocks have passed with work to do and no point finished.
    pub stuck: Signal<Out, Bit>,
    rests: DFF<Bit>,
    clocks: DFF<Clocks>,
    is_over: DFF<Bit>,
    is_stuck: DFF<Bit>,
    one: Signal<Local, Clocks>,
}

impl Logic for Watchdog {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, rests, clocks, is_over, is_stuck);
        self.one.next = 1.into();
        self.stuck.next = self.is_stuck.q.val();
        self.clocks.d.next = self.clocks.q.val() + self.one.val();
        self.rests.d.next = self.finishes.val() | self.is_quiet.val();
        self.is_over.d.next = self.clocks.q.val() == self.patience.val();
        if self.rests.q.val() {
            self.clocks.d.next = 0.into();
        }
        if self.is_over.q.val() {
            self.is_stuck.d.next = true;
        }
        if self.reset.val() {
            self.rests.d.next = false;
            self.clocks.d.next = 0.into();
            self.is_over.d.next = false;
            self.is_stuck.d.next = false;
        }
    }
}
