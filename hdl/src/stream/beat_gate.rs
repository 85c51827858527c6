//! Takes command beats into the FIFO, and drops those without all their bytes.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | the bus's clock and reset |
//! | `s_axis_tvalid`, `s_axis_tkeep` | in | 1, K | a beat is offered; the bytes it has |
//! | `is_full` | in | 1 | no beat is taken. A register |
//! | `push` | out | 1 | the beat is whole |
//! | `took`, `waited`, `dropped` | out | 1 | in the clock before a beat was taken; waited; was taken without all its bytes |
//!
//! Latency: none to `push`, 1 clock to the others.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The gate for command beats; see the top of this file.
#[derive(LogicBlock)]
pub struct BeatGate<const K: usize> {
    /// Clock of the bus.
    pub clock: Signal<In, Clock>,
    /// Its reset.
    pub reset: Signal<In, Bit>,
    /// A beat is offered.
    pub s_axis_tvalid: Signal<In, Bit>,
    /// Its bytes.
    pub s_axis_tkeep: Signal<In, Bits<K>>,
    /// No beat is taken.
    pub is_full: Signal<In, Bit>,
    /// A whole beat is offered.
    pub push: Signal<Out, Bit>,
    /// A beat was taken.
    pub took: Signal<Out, Bit>,
    /// A beat waited.
    pub waited: Signal<Out, Bit>,
    /// A beat was dropped.
    pub dropped: Signal<Out, Bit>,
    takes: DFF<Bit>,
    waits: DFF<Bit>,
    drops: DFF<Bit>,
    is_whole: Signal<Local, Bit>,
    all: Constant<Bits<K>>,
}

impl<const K: usize> Default for BeatGate<K> {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            s_axis_tvalid: Signal::default(),
            s_axis_tkeep: Signal::default(),
            is_full: Signal::default(),
            push: Signal::default(),
            took: Signal::default(),
            waited: Signal::default(),
            dropped: Signal::default(),
            takes: DFF::default(),
            waits: DFF::default(),
            drops: DFF::default(),
            is_whole: Signal::default(),
            all: Constant::new(Bits::<K>::mask()),
        }
    }
}

impl<const K: usize> Logic for BeatGate<K> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, takes, waits, drops);
        self.is_whole.next = self.s_axis_tkeep.val() == self.all.val();
        self.push.next = self.s_axis_tvalid.val() & self.is_whole.val();
        self.takes.d.next = self.s_axis_tvalid.val() & (!self.is_full.val());
        self.waits.d.next = self.s_axis_tvalid.val() & self.is_full.val();
        self.drops.d.next = self.s_axis_tvalid.val() & (!self.is_full.val()) & (!self.is_whole.val());
        if self.reset.val() {
            self.takes.d.next = false;
            self.waits.d.next = false;
            self.drops.d.next = false;
        }
        self.took.next = self.takes.q.val();
        self.waited.next = self.waits.q.val();
        self.dropped.next = self.drops.q.val();
    }
}
