//! Keeps what went wrong until it is cleared.
//!
//! 1. What comes in the clock in which it is cleared stays.
//!
//! Latency: 1 clock.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What went wrong; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Faults {
    /// The bus's clock and reset.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A command beat was dropped.
    pub dropped: Signal<In, Bit>,
    /// An answer had a status other than `Ok`; its header.
    pub failed: Signal<In, Bit>,
    pub header: Signal<In, Bits<32>>,
    /// Forget that one was dropped; that one failed.
    pub clears_dropped: Signal<In, Bit>,
    pub clears_failed: Signal<In, Bit>,
    /// One was, since that was forgotten; one had.
    pub was_dropped: Signal<Out, Bit>,
    pub has_failed: Signal<Out, Bit>,
    /// The header of the last answer that failed, 0 if none did.
    pub fault: Signal<Out, Bits<32>>,
    dropped_once: DFF<Bit>,
    failed_once: DFF<Bit>,
    last_fault: DFF<Bits<32>>,
}

impl Logic for Faults {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, dropped_once, failed_once, last_fault);
        self.was_dropped.next = self.dropped_once.q.val();
        self.has_failed.next = self.failed_once.q.val();
        self.fault.next = self.last_fault.q.val();
        if self.clears_dropped.val() {
            self.dropped_once.d.next = false;
        }
        if self.clears_failed.val() {
            self.failed_once.d.next = false;
        }
        if self.dropped.val() {
            self.dropped_once.d.next = true;
        }
        if self.failed.val() {
            self.failed_once.d.next = true;
            self.last_fault.d.next = self.header.val();
        }
        if self.reset.val() {
            self.dropped_once.d.next = false;
            self.failed_once.d.next = false;
            self.last_fault.d.next = 0.into();
        }
    }
}
