//! The inner records of every cavity, which have no edge on the boundary. A commit uses their ids first, before
//! it takes new ones.
//!
//! 1. `steps` comes only while neither `is_used_up` nor `is_awaited` is high.
//! 2. A list is not written in the clock before it is read, nor while it is being read.
//!
//! Latency: three clocks from `restarts` or `steps` to the next `inner_id` (block RAM, its output register, and one
//! register away from it). The outputs are registers. There is no reset, because the first
//! `restarts` sets every register.
//!
//! A list of two records, 20 and 21:
//! ```text
//! restarts        ___/^^\________________________________
//! steps           __________________/^^\________/^^\_____
//! is_used_up        .  .___________________________/^^^^^
//! is_awaited        .  ./^^^^^^^^\_____/^^^^^^^^\________
//! inner_id          .  .  .  .  . 20 20  .  .  . 21  .  .
//! ```

use crate::engine::attempt::ContextAddress;
use crate::engine::types::{
    context_bits, ring_bits, ContextId, InnerWrite, RingCount, TriangleId, ENTRY_BITS, RING_ADDRESS_BITS, TRIANGLE_BITS,
};
use crate::leaf::BlockMemory;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct InnerList {
    pub clock: Signal<In, Clock>,
    /// An inner record joins the list of a context.
    pub inner: Signal<In, InnerWrite>,
    /// Another list is read from its start: its context and its length.
    pub restarts: Signal<In, Bit>,
    pub reader: Signal<In, ContextId>,
    pub inners: Signal<In, RingCount>,
    /// The record on the output is used.
    pub steps: Signal<In, Bit>,
    /// No record is left in the list.
    pub is_used_up: Signal<Out, Bit>,
    /// A record is left, but has not come to the output yet.
    pub is_awaited: Signal<Out, Bit>,
    /// The id of the next inner record, unless one of these flags is high.
    pub inner_id: Signal<Out, TriangleId>,
    memory: BlockMemory<RING_ADDRESS_BITS, TRIANGLE_BITS>,
    written: DFF<InnerWrite>,
    list_context: DFF<ContextId>,
    list_inners: DFF<RingCount>,
    index: DFF<RingCount>,
    /// The next record is the last one. The flag comes a clock late, but is looked at later still.
    one_is_left: DFF<Bit>,
    used_up: DFF<Bit>,
    awaited: DFF<Bit>,
    /// The address has stood still for one clock, and for two.
    stood_1: DFF<Bit>,
    stood_2: DFF<Bit>,
    arrival: DFF<TriangleId>,
    write_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    read_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    first_place: Signal<Local, RingCount>,
    one: Signal<Local, RingCount>,
    after_index: Signal<Local, RingCount>,
}

impl InnerList {
    pub fn new(config: Config) -> Self {
        let bits = ring_bits(config);
        Self {
            memory: BlockMemory::new(context_bits(config) + bits, TRIANGLE_BITS),
            write_at: ContextAddress::new(bits),
            read_at: ContextAddress::new(bits),
            ..Self::default()
        }
    }
}

impl Logic for InnerList {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, written, list_context, list_inners);
        dff_setup!(self, clock, index, one_is_left, used_up, awaited, stood_1, stood_2, arrival);
        clock!(self, clock, memory);
        self.one.next = 1.into();
        self.first_place.next = 0.into();
        self.written.d.next = self.inner.val();
        self.write_at.context_id.next = self.written.q.val().context;
        self.write_at.place.next = self.written.q.val().place;
        self.memory.write_address.next = self.write_at.address.val();
        self.memory.write_data.next = self.written.q.val().id;
        self.memory.write_enable.next = self.written.q.val().valid;

        self.read_at.context_id.next = self.list_context.q.val();
        self.read_at.place.next = self.index.q.val().get_bits::<6>(0);
        self.memory.read_address.next = self.read_at.address.val();
        self.arrival.d.next = self.memory.read_data.val();
        self.inner_id.next = self.arrival.q.val();
        self.is_used_up.next = self.used_up.q.val();
        self.is_awaited.next = self.awaited.q.val();

        self.after_index.next = self.index.q.val() + self.one.val();
        self.one_is_left.d.next = self.after_index.val() == self.list_inners.q.val();
        self.stood_1.d.next = true;
        self.stood_2.d.next = self.stood_1.q.val();
        self.awaited.d.next = self.awaited.q.val() & (!self.stood_2.q.val());
        if self.steps.val() {
            self.index.d.next = self.after_index.val();
            self.used_up.d.next = self.one_is_left.q.val();
            self.awaited.d.next = !self.one_is_left.q.val();
        }
        if self.restarts.val() {
            self.index.d.next = self.first_place.val();
            self.list_context.d.next = self.reader.val();
            self.list_inners.d.next = self.inners.val();
            self.used_up.d.next = self.inners.val() == self.first_place.val();
            self.awaited.d.next = self.inners.val() != self.first_place.val();
        }
        if self.steps.val() | self.restarts.val() {
            self.stood_1.d.next = false;
            self.stood_2.d.next = false;
        }
    }
}
