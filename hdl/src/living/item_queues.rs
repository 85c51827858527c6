//! A queue of items for each context, and the order in which contexts begin their items.
//!
//! 1. An item for a context that has none begins as soon as it may. All others wait, up to 32 for each context. An item
//!    that can neither begin nor wait is not taken, and stays on offer. Neither is one that comes at the edge at which
//!    the item before it in its context ends, or at which an item out of the memory takes its way.
//! 2. When the item of a context ends, its next one is fetched from the memory, and waits with its context to begin.
//!    Contexts begin in the order of their fetches. No context waits twice, so there is a place for each.
//! 3. After a reset all contexts are without an item, and the counts of the queues are cleared, one a clock. No item
//!    comes meanwhile, because the core clears its locks for 128 clocks at least.
//!
//! Latency: none (combinational) from `dealt` to `taken` and `launch`; 2 clocks from `ends` to `launch`.
//!
//! Two items for context 1, of which the second waits until the first has ended:
//! ```text
//! dealt           ___/^^^^^\____________________
//! dealt.number      .  4  5  .  .  .  .  .  .  .
//! taken           ___/^^^^^\____________________
//! ends            _______________/^^\___________
//! waits           ___/^^\______________/^^^^^\__
//! launch.number     .  4  .  .  .  .  .  5  5  .
//! launches        ___/^^\_________________/^^\__
//! ```

use super::types::{
    ContextEnd, DealtItem, Item, Launch, DEPTH_BITS, ITEM_BITS, LAUNCH_BITS, QUEUE_ADDRESS_BITS, QUEUE_COUNT_BITS,
};
use crate::engine::types::{context_bits, ContextId, ContextSet, CONTEXT_BITS};
use crate::leaf::{BlockMemory, Fifo, LutMemory, Unpack};
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
    /// The item of a context ends at this edge.
    pub ends: Signal<In, ContextEnd>,
    /// A context has an item to begin (`waits`), and begins at this edge (`launches`), which needs `waits`.
    pub waits: Signal<Out, Bit>,
    pub launch: Signal<Out, Launch>,
    pub launches: Signal<In, Bit>,
    items: BlockMemory<QUEUE_ADDRESS_BITS, ITEM_BITS>,
    /// Counts of the items that have waited and of those that have been fetched, modulo twice the depth: once for the
    /// context of the item on offer, once for that whose item ends.
    put_for_offer: LutMemory<CONTEXT_BITS, QUEUE_COUNT_BITS>,
    put_for_end: LutMemory<CONTEXT_BITS, QUEUE_COUNT_BITS>,
    fetched_for_offer: LutMemory<CONTEXT_BITS, QUEUE_COUNT_BITS>,
    fetched_for_end: LutMemory<CONTEXT_BITS, QUEUE_COUNT_BITS>,
    beginners: Fifo<CONTEXT_BITS, LAUNCH_BITS>,
    first: Unpack<Launch, LAUNCH_BITS>,
    fetched_item: Unpack<Item, ITEM_BITS>,
    /// Bit `c`: context `c` has no item, not even one that waits.
    idle: DFF<ContextSet>,
    fetch1: DFF<ContextEnd>,
    fetch2: DFF<ContextEnd>,
    /// Context whose counts are cleared next; the top bit says that all are clear.
    sweep: DFF<Bits<6>>,
    offered: Signal<Local, Item>,
    offered_bits: Signal<Local, Bits<ITEM_BITS>>,
    pushed: Signal<Local, Launch>,
    pushed_bits: Signal<Local, Bits<LAUNCH_BITS>>,
    sweeps: Signal<Local, Bit>,
    swept: Signal<Local, ContextId>,
    is_idle: Signal<Local, Bit>,
    is_full: Signal<Local, Bit>,
    meets_end: Signal<Local, Bit>,
    begins: Signal<Local, Bit>,
    stores: Signal<Local, Bit>,
    fetches: Signal<Local, Bit>,
    falls_idle: Signal<Local, Bit>,
    has_more: Signal<Local, Bit>,
    put: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    fetched: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    after_put: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    after_fetched: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    put_place: Signal<Local, Bits<DEPTH_BITS>>,
    fetched_place: Signal<Local, Bits<DEPTH_BITS>>,
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
    one: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    depth: Signal<Local, Bits<QUEUE_COUNT_BITS>>,
    depth_shift: Signal<Local, Bits<QUEUE_ADDRESS_BITS>>,
}

// The kernel holds the depth as a literal, because rust-hdl allows no constants there.
const _: () = assert!(DEPTH_BITS == 5, "the kernel of this block is for 32 items of a context");

impl ItemQueues {
    /// Queues for the contexts of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        let counts = || LutMemory::new(bits, QUEUE_COUNT_BITS);
        Self {
            items: BlockMemory::new(bits + DEPTH_BITS, ITEM_BITS),
            put_for_offer: counts(),
            put_for_end: counts(),
            fetched_for_offer: counts(),
            fetched_for_end: counts(),
            beginners: Fifo::new(bits, LAUNCH_BITS),
            ..Self::default()
        }
    }
}

impl Logic for ItemQueues {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, idle, fetch1, fetch2, sweep);
        clock!(self, clock, items, put_for_offer, put_for_end, fetched_for_offer, fetched_for_end, beginners);
        self.one.next = 1.into();
        self.one_bit.next = 1.into();
        self.none.next = 0.into();
        self.depth.next = 32.into();
        self.depth_shift.next = 5.into();

        // An item on offer: its context has none, or has a place for it.
        self.offered.next = self.dealt.val().item;
        self.offered_bits.next = self.offered.val().into();
        self.put_for_offer.read_address.next = self.dealt.val().context;
        self.fetched_for_offer.read_address.next = self.dealt.val().context;
        self.put.next = self.put_for_offer.read_data.val();
        self.is_full.next = (self.put.val() ^ self.fetched_for_offer.read_data.val()) == self.depth.val();
        self.wide_offer.next = bit_cast::<24, 5>(self.dealt.val().context);
        self.of_offer.next = self.idle.q.val() >> self.wide_offer.val();
        self.is_idle.next = self.of_offer.val().get_bit(0);
        self.meets_end.next = self.ends.val().valid & (self.ends.val().context == self.dealt.val().context);
        self.begins.next = self.dealt.val().valid & self.is_idle.val() & (!self.fetch2.q.val().valid);
        self.stores.next =
            self.dealt.val().valid & (!self.is_idle.val()) & (!self.is_full.val()) & (!self.meets_end.val());
        self.taken.next = self.begins.val() | self.stores.val();
        self.after_put.next = self.put.val() + self.one.val();
        self.put_place.next = bit_cast::<5, 6>(self.put.val());
        self.write_context.next = bit_cast::<10, 5>(self.dealt.val().context);
        self.write_place.next = bit_cast::<10, 5>(self.put_place.val());
        self.items.write_address.next = (self.write_context.val() << self.depth_shift.val()) | self.write_place.val();
        self.items.write_data.next = self.offered_bits.val();
        self.items.write_enable.next = self.stores.val();

        // An item that ends: the next one of its context is fetched, if there is one.
        self.put_for_end.read_address.next = self.ends.val().context;
        self.fetched_for_end.read_address.next = self.ends.val().context;
        self.fetched.next = self.fetched_for_end.read_data.val();
        self.has_more.next = self.put_for_end.read_data.val() != self.fetched.val();
        self.fetches.next = self.ends.val().valid & self.has_more.val();
        self.falls_idle.next = self.ends.val().valid & (!self.has_more.val());
        self.after_fetched.next = self.fetched.val() + self.one.val();
        self.fetched_place.next = bit_cast::<5, 6>(self.fetched.val());
        self.read_context.next = bit_cast::<10, 5>(self.ends.val().context);
        self.read_place.next = bit_cast::<10, 5>(self.fetched_place.val());
        self.items.read_address.next = (self.read_context.val() << self.depth_shift.val()) | self.read_place.val();
        self.fetch1.d.next.valid = self.fetches.val();
        self.fetch1.d.next.context = self.ends.val().context;
        self.fetch2.d.next = self.fetch1.q.val();
        self.fetched_item.bits.next = self.items.read_data.val();

        // The counts, which a sweep clears after a reset.
        self.sweeps.next = !self.sweep.q.val().get_bit(5);
        self.swept.next = bit_cast::<5, 6>(self.sweep.q.val());
        self.put_for_offer.write_address.next = self.dealt.val().context;
        self.put_for_end.write_address.next = self.dealt.val().context;
        self.put_for_offer.write_data.next = self.after_put.val();
        self.put_for_end.write_data.next = self.after_put.val();
        self.put_for_offer.write_enable.next = self.stores.val() | self.sweeps.val();
        self.put_for_end.write_enable.next = self.stores.val() | self.sweeps.val();
        self.fetched_for_offer.write_address.next = self.ends.val().context;
        self.fetched_for_end.write_address.next = self.ends.val().context;
        self.fetched_for_offer.write_data.next = self.after_fetched.val();
        self.fetched_for_end.write_data.next = self.after_fetched.val();
        self.fetched_for_offer.write_enable.next = self.fetches.val() | self.sweeps.val();
        self.fetched_for_end.write_enable.next = self.fetches.val() | self.sweeps.val();
        if self.sweeps.val() {
            self.sweep.d.next = self.sweep.q.val() + self.one.val();
            self.put_for_offer.write_address.next = self.swept.val();
            self.put_for_end.write_address.next = self.swept.val();
            self.put_for_offer.write_data.next = 0.into();
            self.put_for_end.write_data.next = 0.into();
            self.fetched_for_offer.write_address.next = self.swept.val();
            self.fetched_for_end.write_address.next = self.swept.val();
            self.fetched_for_offer.write_data.next = 0.into();
            self.fetched_for_end.write_data.next = 0.into();
        }

        // Those that begin: an item out of the memory goes before one on offer.
        self.pushed.next.context = self.dealt.val().context;
        self.pushed.next.item = self.offered.val();
        if self.fetch2.q.val().valid {
            self.pushed.next.context = self.fetch2.q.val().context;
            self.pushed.next.item = self.fetched_item.value.val();
        }
        self.pushed_bits.next = self.pushed.val().into();
        self.beginners.reset.next = self.reset.val();
        self.beginners.push.next = self.fetch2.q.val().valid | self.begins.val();
        self.beginners.push_data.next = self.pushed_bits.val();
        self.beginners.pop.next = self.launches.val();
        self.first.bits.next = self.beginners.data.val();
        self.waits.next = self.beginners.valid.val();
        self.launch.next = self.first.value.val();

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
            self.sweep.d.next = 0.into();
        }
    }
}
