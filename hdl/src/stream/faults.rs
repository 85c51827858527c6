//! Keeps what went wrong until it is cleared.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | the bus's clock and reset |
//! | `dropped` | in | 1 | a command beat was dropped |
//! | `failed`, `header` | in | 1, 32 | an answer had a status other than `Ok`; its header |
//! | `clears_dropped`, `clears_failed` | in | 1 | forget that one was dropped; that one failed |
//! | `was_dropped`, `has_failed` | out | 1 | one was, since that was forgotten; one had |
//! | `fault` | out | 32 | the header of the last answer that failed, 0 if none did |
//!
//! 1. What comes in the clock in which it is cleared stays.
//!
//! Latency: 1 clock.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What went wrong; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Faults {
    /// Clock of the bus.
    pub clock: Signal<In, Clock>,
    /// Its reset.
    pub reset: Signal<In, Bit>,
    /// A command beat was dropped.
    pub dropped: Signal<In, Bit>,
    /// An answer failed.
    pub failed: Signal<In, Bit>,
    /// Its header.
    pub header: Signal<In, Bits<32>>,
    /// Forget that a beat was dropped.
    pub clears_dropped: Signal<In, Bit>,
    /// Forget that an answer failed.
    pub clears_failed: Signal<In, Bit>,
    /// A beat was dropped.
    pub was_dropped: Signal<Out, Bit>,
    /// An answer failed.
    pub has_failed: Signal<Out, Bit>,
    /// Header of the last one that did.
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
