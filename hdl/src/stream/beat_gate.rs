//! Takes command beats into the FIFO, and drops those without all their bytes.
//!
//! Latency: none to `push`, 1 clock to the others.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The gate for command beats; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct BeatGate<const K: usize> {
    /// The bus's clock and reset.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A beat is offered; the bytes it has.
    pub s_axis_tvalid: Signal<In, Bit>,
    pub s_axis_tkeep: Signal<In, Bits<K>>,
    /// No beat is taken. A register.
    pub is_full: Signal<In, Bit>,
    /// The beat is whole.
    pub push: Signal<Out, Bit>,
    /// In the clock before a beat was taken; waited; was taken without all its bytes.
    pub took: Signal<Out, Bit>,
    pub waited: Signal<Out, Bit>,
    pub dropped: Signal<Out, Bit>,
    takes: DFF<Bit>,
    waits: DFF<Bit>,
    drops: DFF<Bit>,
    is_whole: Signal<Local, Bit>,
}

impl<const K: usize> Logic for BeatGate<K> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, takes, waits, drops);
        self.is_whole.next = self.s_axis_tkeep.val().all();
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
