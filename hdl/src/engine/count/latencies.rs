//! The histogram of latencies: the number of insertions in each bucket of latencies.
//!
//! 1. The memory has one read port, which serves a latency that comes before it serves `select`. The host does not read
//!    while points are inserted.
//! 2. Latencies come at least three clocks apart.
//!
//! Latency: a latency is counted at the fifth edge; its bucket takes three clocks, the read one, the write one. A
//! sweep takes 128 clocks.
//!
//! The end of a sweep, and two insertions of 22 clocks:
//! ```text
//! sweeps          /^^^^^^^^\______________________________________
//! comes           ____________/^^\_____/^^\_______________________
//! latency           .  .  .  . 22  .  . 22  .  .  .  .  .  .  .  .
//! value             .  .  .  .  0  0  0  0  .  0  1  .  1  2  2  2
//! ```

use super::latency_bucket::LatencyBucket;
use crate::engine::types::Clocks;
use crate::leaf::LutMemory;
use crate::prelude::*;
use incircle_protocol::LATENCY_BUCKETS;

/// Width of a bucket's count in bits: each of up to 16384 points is counted once.
const COUNT_BITS: usize = 15;

const _: () = assert!(LATENCY_BUCKETS == 128, "the address of this block's memory has seven bits");

#[derive(LogicBlock, Default)]
pub struct Latencies {
    pub clock: Signal<In, Clock>,
    /// Reset and clear start a sweep.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// An insertion took this many clocks; not during a sweep.
    pub comes: Signal<In, Bit>,
    pub latency: Signal<In, Clocks>,
    /// The buckets are being cleared, one a clock.
    pub sweeps: Signal<Out, Bit>,
    /// The bucket to read; see `latency_bucket` of the protocol.
    pub select: Signal<In, Bits<7>>,
    /// The number of insertions in that bucket a clock later, while no latency comes.
    pub value: Signal<Out, Bits<32>>,
    is_sweeping: DFF<Bit>,
    sweep_bucket: DFF<Bits<7>>,
    shifts: DFF<Bit>,
    seeks: DFF<Bit>,
    finds: DFF<Bit>,
    counts: DFF<Bit>,
    counted_bucket: DFF<Bits<7>>,
    found: DFF<Bits<15>>,
    bucket: LatencyBucket,
    memory: LutMemory<7, COUNT_BITS>,
    last_bucket: Signal<Local, Bits<7>>,
    one_bucket: Signal<Local, Bits<7>>,
    one: Signal<Local, Bits<15>>,
}

impl Logic for Latencies {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_sweeping, sweep_bucket, shifts, seeks, finds, counts, counted_bucket, found);
        clock!(self, clock, bucket, memory);
        self.last_bucket.next = 127.into();
        self.one_bucket.next = 1.into();
        self.one.next = 1.into();
        self.sweeps.next = self.is_sweeping.q.val();

        // The count is read in the fourth clock and written in the fifth. Latencies come three clocks apart, so none
        // reads a count that is about to change.
        self.bucket.latency.next = self.latency.val();
        self.shifts.d.next = self.comes.val();
        self.seeks.d.next = self.shifts.q.val();
        self.finds.d.next = self.seeks.q.val();
        if self.seeks.q.val() {
            self.counted_bucket.d.next = self.bucket.bucket.val();
        }
        self.counts.d.next = self.finds.q.val();
        self.memory.read_address.next = self.select.val();
        if self.finds.q.val() {
            self.memory.read_address.next = self.counted_bucket.q.val();
        }
        self.found.d.next = self.memory.read_data.val();
        self.value.next = bit_cast::<32, 15>(self.found.q.val());
        self.memory.write_address.next = self.counted_bucket.q.val();
        self.memory.write_data.next = self.found.q.val() + self.one.val();
        self.memory.write_enable.next = self.counts.q.val();

        if self.is_sweeping.q.val() {
            self.memory.write_address.next = self.sweep_bucket.q.val();
            self.memory.write_data.next = 0.into();
            self.memory.write_enable.next = true;
            self.sweep_bucket.d.next = self.sweep_bucket.q.val() + self.one_bucket.val();
            if self.sweep_bucket.q.val() == self.last_bucket.val() {
                self.is_sweeping.d.next = false;
            }
        }
        if self.reset.val() | self.clears.val() {
            self.is_sweeping.d.next = true;
            self.sweep_bucket.d.next = 0.into();
            self.shifts.d.next = false;
            self.seeks.d.next = false;
            self.finds.d.next = false;
            self.counts.d.next = false;
        }
    }
}
