//! Counts of clocks, by the work that the core does in them.
//!
//! 1. The first three counts are two words each; the high word follows a clock after the low one has wrapped.
//! 2. A lock that is cleared counts while a job is under way, not in the sweep after reset.
//!
//! Latency: 2 clocks to a count; `value` follows `select` by 1.

use super::event_counter::{EventCounter, WideCounter};
use crate::prelude::*;
use incircle_protocol::Counter;

#[derive(LogicBlock, Default)]
pub struct CycleCounters {
    pub clock: Signal<In, Clock>,
    /// All counts go to zero at this edge.
    pub zero: Signal<In, Bit>,
    /// A job is under way; the job has no point to work on; a read-out is under way.
    pub inserting: Signal<In, Bit>,
    pub waiting: Signal<In, Bit>,
    pub reading: Signal<In, Bit>,
    /// A visit is issued; a record or a link is written.
    pub is_issuing: Signal<In, Bit>,
    pub is_writing: Signal<In, Bit>,
    /// A commit is at work; a lock is cleared.
    pub is_committing: Signal<In, Bit>,
    pub is_releasing: Signal<In, Bit>,
    /// The word to read, by its place in the answer to `Counters`.
    pub select: Signal<In, Bits<5>>,
    /// The selected word a clock later, if it is one of this block.
    pub value: Signal<Out, Bits<32>>,
    chosen: DFF<Bits<32>>,
    insert_cycles: WideCounter<32>,
    wait_cycles: WideCounter<32>,
    read_cycles: WideCounter<32>,
    issue_cycles: EventCounter,
    write_cycles: EventCounter,
    commit_cycles: EventCounter,
    release_cycles: EventCounter,
}

// `select` counts in the order of `Counter`; a change there must come here.
const _: () = assert!(
    Counter::InsertCycles as usize == 0
        && Counter::WaitCycles as usize == 2
        && Counter::ReadCycles as usize == 4
        && Counter::IssueCycles as usize == 19
        && Counter::WriteCycles as usize == 20
        && Counter::CommitCycles as usize == 21
        && Counter::ReleaseCycles as usize == 22,
    "the words of this block follow the protocol"
);

impl Logic for CycleCounters {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, chosen);
        clock!(self, clock, insert_cycles, wait_cycles, read_cycles);
        clock!(self, clock, issue_cycles, write_cycles, commit_cycles, release_cycles);
        self.insert_cycles.zero.next = self.zero.val();
        self.wait_cycles.zero.next = self.zero.val();
        self.read_cycles.zero.next = self.zero.val();
        self.issue_cycles.zero.next = self.zero.val();
        self.write_cycles.zero.next = self.zero.val();
        self.commit_cycles.zero.next = self.zero.val();
        self.release_cycles.zero.next = self.zero.val();
        self.insert_cycles.count.next = self.inserting.val();
        self.wait_cycles.count.next = self.waiting.val();
        self.read_cycles.count.next = self.reading.val();
        self.issue_cycles.count.next = self.is_issuing.val();
        self.write_cycles.count.next = self.is_writing.val();
        self.commit_cycles.count.next = self.is_committing.val();
        self.release_cycles.count.next = self.is_releasing.val() & self.inserting.val();
        self.value.next = self.chosen.q.val();
        match self.select.val().index() {
            0 => {
                self.chosen.d.next = self.insert_cycles.low.val();
            }
            1 => {
                self.chosen.d.next = self.insert_cycles.high.val();
            }
            2 => {
                self.chosen.d.next = self.wait_cycles.low.val();
            }
            3 => {
                self.chosen.d.next = self.wait_cycles.high.val();
            }
            4 => {
                self.chosen.d.next = self.read_cycles.low.val();
            }
            5 => {
                self.chosen.d.next = self.read_cycles.high.val();
            }
            19 => {
                self.chosen.d.next = self.issue_cycles.value.val();
            }
            20 => {
                self.chosen.d.next = self.write_cycles.value.val();
            }
            21 => {
                self.chosen.d.next = self.commit_cycles.value.val();
            }
            _ => {
                self.chosen.d.next = self.release_cycles.value.val();
            }
        }
    }
}
