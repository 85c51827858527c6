//! The latency of each insertion, and the least and the most of all.
//!
//! 1. The first latency counts as the least. Any latency counts as the first while the most is 0.
//! 2. Insertions are finished at least three clocks apart, as each commit writes three records or more. So a latency is
//!    compared in one clock and stored in the next, while it still stands.
//!
//! Latency: 1 clock to `latency`, 3 to `least` and `most`.

use crate::engine::types::Clocks;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LatencyRange {
    pub clock: Signal<In, Clock>,
    /// All latencies are forgotten at this edge.
    pub zero: Signal<In, Bit>,
    /// An insertion is finished at this edge.
    pub commit_ends: Signal<In, Bit>,
    /// The clock count now, and when the point was taken; both modulo 2^22.
    pub now: Signal<In, Clocks>,
    pub since: Signal<In, Clocks>,
    /// The latency of the insertion that was finished at the last edge.
    pub latency_comes: Signal<Out, Bit>,
    pub latency: Signal<Out, Clocks>,
    /// The least and the most of all latencies; 0 if there was none.
    pub least: Signal<Out, Clocks>,
    pub most: Signal<Out, Clocks>,
    comes: DFF<Bit>,
    /// The latency is the least, or the most, so far.
    is_least: DFF<Bit>,
    is_most: DFF<Bit>,
    taken: DFF<Clocks>,
    lowest: DFF<Clocks>,
    highest: DFF<Clocks>,
    none: Signal<Local, Clocks>,
}

impl Logic for LatencyRange {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, comes, is_least, is_most, taken, lowest, highest);
        self.none.next = 0.into();
        self.latency_comes.next = self.comes.q.val();
        self.latency.next = self.taken.q.val();
        self.least.next = self.lowest.q.val();
        self.most.next = self.highest.q.val();

        self.comes.d.next = self.commit_ends.val();
        if self.commit_ends.val() {
            self.taken.d.next = self.now.val() - self.since.val();
        }
        self.is_least.d.next = self.comes.q.val()
            & ((self.highest.q.val() == self.none.val()) | (self.taken.q.val() < self.lowest.q.val()));
        self.is_most.d.next = self.comes.q.val() & (self.taken.q.val() > self.highest.q.val());
        if self.is_least.q.val() {
            self.lowest.d.next = self.taken.q.val();
        }
        if self.is_most.q.val() {
            self.highest.d.next = self.taken.q.val();
        }
        if self.zero.val() {
            self.comes.d.next = false;
            self.is_least.d.next = false;
            self.is_most.d.next = false;
            self.lowest.d.next = 0.into();
            self.highest.d.next = 0.into();
        }
    }
}
