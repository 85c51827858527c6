//! A queue of items for each context, and the order in which contexts begin their items.
//!
//! 1. An item on offer whose context has no other item joins the line of those that begin. If its context is at work,
//!    the item waits in the queue of the context, which has room for 32.
//! 2. An item on offer is not taken, and stays on offer, in three cases: the queue of its context is full; the item at
//!    work in its context ends at this edge; or the item would join the line while one out of the memory does.
//! 3. When the item of a context ends, the next item in its queue is fetched from the memory and joins the line. The
//!    items in the line begin one after another. A context has one item in the line at most, so the line is never full.
//! 4. After a reset no context has an item, and the counts of the queues are cleared, one a clock. No item comes
//!    meanwhile, because the core clears its locks for 128 clocks at least.
//!
//! Latency: none (combinational) from `dealt` to `taken`; 1 clock from there to `launch`; 2 clocks from `ends` to
//! `launch`.
//!
//! Two items for context 1, of which the second waits until the first has ended:
//! ```text
//! dealt           ___/^^^^^\____________________
//! dealt.number      .  4  5  .  .  .  .  .  .  .
//! taken           ___/^^^^^\____________________
//! ends            _______________/^^\___________
//! waits           ______/^^\___________/^^^^^\__
//! launch.number     .  .  4  .  .  .  .  5  5  .
//! launches        ______/^^\______________/^^\__
//! ```

use super::queue_counts::QueueCounts;
use super::types::{ContextEnd, DealtItem, Item, Launch, DEPTH_BITS, ITEM_BITS, LAUNCH_BITS, QUEUE_ADDRESS_BITS};
use crate::engine::types::{context_bits, ContextSet, CONTEXT_BITS};
use crate::leaf::{BlockMemory, Fifo, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct ItemQueues {
    pub clock: Signal<In, Clock>,
    /// Reset drops all items.
    pub reset: Signal<In, Bit>,
    /// An item on offer, and whether it is taken at this edge.
    pub dealt: Signal<In, DealtItem>,
    pub taken: Signal<Out, Bit>,
    /// The context whose item ends at this edge.
    pub ends: Signal<In, ContextEnd>,
    /// The line holds an item, and the first item in the line.
    pub waits: Signal<Out, Bit>,
    pub launch: Signal<Out, Launch>,
    /// The first item in the line leaves it at this edge. The user sets it only while `waits` is 1.
    pub launches: Signal<In, Bit>,
    /// No context has an item.
    pub rests: Signal<Out, Bit>,
    items: BlockMemory<QUEUE_ADDRESS_BITS, ITEM_BITS>,
    counts: QueueCounts,
    beginners: Fifo<CONTEXT_BITS, LAUNCH_BITS>,
    first: Unpack<Launch, LAUNCH_BITS>,
    fetched_item: Unpack<Item, ITEM_BITS>,
    /// Bit `c`: context `c` has no item, not even one that waits.
    idle: DFF<ContextSet>,
    fetch1: DFF<ContextEnd>,
    fetch2: DFF<ContextEnd>,
    /// The item on offer before, which joins the line in this clock.
    joins: DFF<Bit>,
    joined: DFF<Launch>,
    offered: Signal<Local, Item>,
    offered_bits: Signal<Local, Bits<ITEM_BITS>>,
    pushed: Signal<Local, Launch>,
    pushed_bits: Signal<Local, Bits<LAUNCH_BITS>>,
    is_idle: Signal<Local, Bit>,
    meets_end: Signal<Local, Bit>,
    begins: Signal<Local, Bit>,
    stores: Signal<Local, Bit>,
    fetches: Signal<Local, Bit>,
    falls_idle: Signal<Local, Bit>,
    write_place: Signal<Local, Bits<QUEUE_ADDRESS_BITS>>,
    read_place: Signal<Local, Bits<QUEUE_ADDRESS_BITS>>,
    write_context: Signal<Local, Bits<QUEUE_ADDRESS_BITS>>,
    read_context: Signal<Local, Bits<QUEUE_ADDRESS_BITS>>,
    wide_offer: Signal<Local, ContextSet>,
    wide_end: Signal<Local, ContextSet>,
    of_offer: Signal<Local, ContextSet>,
    offer_bit: Signal<Local, ContextSet>,
    end_bit: Signal<Local, ContextSet>,
    one_bit: Signal<Local, ContextSet>,
    none: Signal<Local, ContextSet>,
    depth_shift: Signal<Local, Bits<QUEUE_ADDRESS_BITS>>,
}

// The kernel holds the width of a place as a literal, because rust-hdl allows no constants there.
const _: () = assert!(DEPTH_BITS == 5, "the kernel of this block is for 32 items of a context");

impl ItemQueues {
    /// Queues for the contexts of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        Self {
            items: BlockMemory::new(bits + DEPTH_BITS, ITEM_BITS),
            counts: QueueCounts::new(config),
            beginners: Fifo::new(bits, LAUNCH_BITS),
            ..Self::default()
        }
    }
}

impl Logic for ItemQueues {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, idle, fetch1, fetch2, joins, joined);
        clock!(self, clock, items, counts, beginners);
        self.one_bit.next = 1.into();
        self.none.next = 0.into();
        self.depth_shift.next = 5.into();
        self.counts.reset.next = self.reset.val();

        // An item may wait only behind another item of its context. At the edge at which that one ends, the queue might
        // be found empty, and the item would then wait for ever.
        self.offered.next = self.dealt.val().item;
        self.offered_bits.next = self.offered.val().into();
        self.counts.offer_context.next = self.dealt.val().context;
        self.wide_offer.next = bit_cast::<24, 5>(self.dealt.val().context);
        self.of_offer.next = self.idle.q.val() >> self.wide_offer.val();
        self.is_idle.next = self.of_offer.val().get_bit(0);
        self.meets_end.next = self.ends.val().valid & (self.ends.val().context == self.dealt.val().context);
        self.begins.next = self.dealt.val().valid & self.is_idle.val() & (!self.fetch1.q.val().valid);
        self.stores.next =
            self.dealt.val().valid & (!self.is_idle.val()) & (!self.counts.is_full.val()) & (!self.meets_end.val());
        self.taken.next = self.begins.val() | self.stores.val();
        self.counts.puts.next = self.stores.val();
        self.write_context.next = bit_cast::<10, 5>(self.dealt.val().context);
        self.write_place.next = bit_cast::<10, 5>(self.counts.put_place.val());
        self.items.write_address.next = (self.write_context.val() << self.depth_shift.val()) | self.write_place.val();
        self.items.write_data.next = self.offered_bits.val();
        self.items.write_enable.next = self.stores.val();

        self.counts.end_context.next = self.ends.val().context;
        self.fetches.next = self.ends.val().valid & self.counts.has_more.val();
        self.falls_idle.next = self.ends.val().valid & (!self.counts.has_more.val());
        self.counts.fetches.next = self.fetches.val();
        self.read_context.next = bit_cast::<10, 5>(self.ends.val().context);
        self.read_place.next = bit_cast::<10, 5>(self.counts.fetched_place.val());
        self.items.read_address.next = (self.read_context.val() << self.depth_shift.val()) | self.read_place.val();
        self.fetch1.d.next.valid = self.fetches.val();
        self.fetch1.d.next.context = self.ends.val().context;
        self.fetch2.d.next = self.fetch1.q.val();
        self.fetched_item.bits.next = self.items.read_data.val();

        // One item a clock joins the line. An item out of the memory cannot wait, so the one on offer does. It is known
        // late in its clock, so it joins in the next.
        self.joins.d.next = self.begins.val() & (!self.reset.val());
        self.joined.d.next.context = self.dealt.val().context;
        self.joined.d.next.item = self.offered.val();
        self.pushed.next = self.joined.q.val();
        if self.fetch2.q.val().valid {
            self.pushed.next.context = self.fetch2.q.val().context;
            self.pushed.next.item = self.fetched_item.value.val();
        }
        self.pushed_bits.next = self.pushed.val().into();
        self.beginners.reset.next = self.reset.val();
        self.beginners.push.next = self.fetch2.q.val().valid | self.joins.q.val();
        self.beginners.push_data.next = self.pushed_bits.val();
        self.beginners.pop.next = self.launches.val();
        self.first.bits.next = self.beginners.data.val();
        self.waits.next = self.beginners.valid.val();
        self.launch.next = self.first.value.val();
        self.rests.next = self.idle.q.val() == (!self.none.val());

        self.wide_end.next = bit_cast::<24, 5>(self.ends.val().context);
        self.offer_bit.next = 0.into();
        self.end_bit.next = 0.into();
        if self.begins.val() {
            self.offer_bit.next = self.one_bit.val() << self.wide_offer.val();
        }
        if self.falls_idle.val() {
            self.end_bit.next = self.one_bit.val() << self.wide_end.val();
        }
        self.idle.d.next = (self.idle.q.val() | self.end_bit.val()) & (!self.offer_bit.val());
        if self.reset.val() {
            self.idle.d.next = !self.none.val();
            self.fetch1.d.next.valid = false;
            self.fetch2.d.next.valid = false;
        }
    }
}
