//! Notices that nothing is finished any more.
//!
//! 1. `stuck` stays until reset.
//!
//! 2. Its inputs and the comparison go into registers first.
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
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The watchdog; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Watchdog {
    pub clock: Signal<In, Clock>,
    /// Reset forgets the fault.
    pub reset: Signal<In, Bit>,
    /// A point is in the mesh, or known to be a duplicate, at this edge.
    pub finishes: Signal<In, Bit>,
    /// There is nothing to do.
    pub is_quiet: Signal<In, Bit>,
    /// Clocks to wait, a constant; see `patience` of the protocol.
    pub patience: Signal<In, Clocks>,
    /// A fault: that many clocks have passed without either.
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
