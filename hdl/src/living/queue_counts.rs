//! How many items wait for each context: the counts behind [`ItemQueues`](super::ItemQueues).
//!
//! 1. A context has two counts, modulo twice the depth of its queue: of the items that were put into the queue, and of
//!    those that were fetched out of it. Equal counts mean an empty queue; counts that differ in the top bit alone mean
//!    a full one. The low bits of a count are the place of the next item in the queue.
//! 2. A put changes the counts of `offer_context`, a fetch those of `end_context`. The user never puts into a full
//!    queue and never fetches from an empty one.
//! 3. After a reset the counts are cleared, one context a clock for 32 clocks. The user puts nothing meanwhile.
//!
//! Latency: none (combinational) from a context to its counts, which change at the edge of a put or a fetch.
//!
//! Source: both contexts ask for both counts in one clock, and a [`LutMemory`] has one read port. So each count is kept
//! twice.

use super::types::{DEPTH_BITS, QUEUE_COUNT_BITS};
use crate::engine::types::{context_bits, ContextId, CONTEXT_BITS};
use crate::leaf::LutMemory;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct QueueCounts {
    pub clock: Signal<In, Clock>,
    /// Reset clears all counts.
    pub reset: Signal<In, Bit>,
    /// The context of an item on offer: whether its queue is full, and the place for the item.
    pub offer_context: Signal<In, ContextId>,
    pub is_full: Signal<Out, Bit>,
    pub put_place: Signal<Out, Bits<DEPTH_BITS>>,
    /// The item on offer is put into the queue at this edge.
    pub puts: Signal<In, Bit>,
    /// The context whose item ends: whether its queue has an item, and the place of that item.
    pub end_context: Signal<In, ContextId>,
    pub has_more: Signal<Out, Bit>,
    pub fetched_place: Signal<Out, Bits<DEPTH_BITS>>,
    /// The next item of `end_context` is fetched out of its queue at this edge.
    pub fetches: Signal<In, Bit>,
    put_for_offer: LutMemory<CONTEXT_BITS, QUEUE_COUNT_BITS>,
    put_for_end: LutMemory<CONTEXT_BITS, QUEUE_COUNT_BITS>,
    fetched_for_offer: LutMemory<CONTEXT_BITS, QUEUE_COUNT_BITS>,
    fetched_for_end: LutMemory<CONTEXT_BITS, QUEUE_COUNT_BITS>,
    /// Context whose counts are cleared next; the top bit says that all are clear.
    sweep: DFF<Bits<6>>,
    sweeps: Signal<Local, Bit>,
    swept: Signal<Local, ContextId>,
    put: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    fetched: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    put_context: Signal<Local, ContextId>,
    fetched_context: Signal<Local, ContextId>,
    after_put: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    after_fetched: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    one: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    depth: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
}

// The kernel holds the depth as a literal, because rust-hdl allows no constants there.
const _: () =
    assert!(DEPTH_BITS == 5 && QUEUE_COUNT_BITS == 6, "the kernel of this block is for 32 items of a context");

impl QueueCounts {
    /// Counts for the contexts of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let counts = || LutMemory::new(context_bits(config), QUEUE_COUNT_BITS);
        Self {
            put_for_offer: counts(),
            put_for_end: counts(),
            fetched_for_offer: counts(),
            fetched_for_end: counts(),
            ..Self::default()
        }
    }
}

impl Logic for QueueCounts {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, sweep);
        clock!(self, clock, put_for_offer, put_for_end, fetched_for_offer, fetched_for_end);
        self.one.next = 1.into();
        self.depth.next = 32.into();

        self.put_for_offer.read_address.next = self.offer_context.val();
        self.fetched_for_offer.read_address.next = self.offer_context.val();
        self.put.next = self.put_for_offer.read_data.val();
        self.is_full.next = (self.put.val() ^ self.fetched_for_offer.read_data.val()) == self.depth.val();
        self.put_place.next = bit_cast::<5, 6>(self.put.val());
        self.put_for_end.read_address.next = self.end_context.val();
        self.fetched_for_end.read_address.next = self.end_context.val();
        self.fetched.next = self.fetched_for_end.read_data.val();
        self.has_more.next = self.put_for_end.read_data.val() != self.fetched.val();
        self.fetched_place.next = bit_cast::<5, 6>(self.fetched.val());

        // The sweep after a reset has the write ports to itself.
        self.sweeps.next = !self.sweep.q.val().get_bit(5);
        self.swept.next = bit_cast::<5, 6>(self.sweep.q.val());
        self.put_context.next = self.offer_context.val();
        self.after_put.next = self.put.val() + self.one.val();
        self.fetched_context.next = self.end_context.val();
        self.after_fetched.next = self.fetched.val() + self.one.val();
        if self.sweeps.val() {
            self.sweep.d.next = self.sweep.q.val() + self.one.val();
            self.put_context.next = self.swept.val();
            self.after_put.next = 0.into();
            self.fetched_context.next = self.swept.val();
            self.after_fetched.next = 0.into();
        }
        self.put_for_offer.write_address.next = self.put_context.val();
        self.put_for_offer.write_data.next = self.after_put.val();
        self.put_for_offer.write_enable.next = self.puts.val() | self.sweeps.val();
        self.put_for_end.write_address.next = self.put_context.val();
        self.put_for_end.write_data.next = self.after_put.val();
        self.put_for_end.write_enable.next = self.puts.val() | self.sweeps.val();
        self.fetched_for_offer.write_address.next = self.fetched_context.val();
        self.fetched_for_offer.write_data.next = self.after_fetched.val();
        self.fetched_for_offer.write_enable.next = self.fetches.val() | self.sweeps.val();
        self.fetched_for_end.write_address.next = self.fetched_context.val();
        self.fetched_for_end.write_data.next = self.after_fetched.val();
        self.fetched_for_end.write_enable.next = self.fetches.val() | self.sweeps.val();
        if self.reset.val() {
            self.sweep.d.next = 0.into();
        }
    }
}
