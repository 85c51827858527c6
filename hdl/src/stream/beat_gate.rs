//! Lets command beats into the FIFO, and drops and reports beats that lack bytes, so that a host learns of a transfer
//! that it has not padded to whole beats.
//!
//! Latency: none (combinational) to `push`, 1 clock to `events`.

use super::events::CommandEvents;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct BeatGate<const K: usize> {
    /// The bus's clock and reset.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A beat on offer, and the bytes that it holds.
    pub s_axis_tvalid: Signal<In, Bit>,
    pub s_axis_tkeep: Signal<In, Bits<K>>,
    /// The FIFO is full, so no beat is taken; comes from a register.
    pub is_full: Signal<In, Bit>,
    /// The beat on offer is whole and goes into the FIFO.
    pub push: Signal<Out, Bit>,
    pub events: Signal<Out, CommandEvents>,
    seen: DFF<CommandEvents>,
    is_whole: Signal<Local, Bit>,
}

impl<const K: usize> Logic for BeatGate<K> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, seen);
        self.is_whole.next = self.s_axis_tkeep.val().all();
        self.push.next = self.s_axis_tvalid.val() & self.is_whole.val();
        self.seen.d.next.took = self.s_axis_tvalid.val() & (!self.is_full.val());
        self.seen.d.next.waited = self.s_axis_tvalid.val() & self.is_full.val();
        self.seen.d.next.dropped = self.s_axis_tvalid.val() & (!self.is_full.val()) & (!self.is_whole.val());
        if self.reset.val() {
            self.seen.d.next.took = false;
            self.seen.d.next.waited = false;
            self.seen.d.next.dropped = false;
        }
        self.events.next = self.seen.q.val();
    }
}
