//! The vertices of a run of `Move` that are out of the mesh and go back into it: a line of contexts, each with the rest
//! of its item.
//!
//! 1. A context joins the line in the clock after the last write of its deletion (`puts_out`). It has one item at a
//!    time, so the line is never full.
//! 2. The item of a context in the line has the new place of its vertex as its place, and ids are kept for it: the two
//!    that its deletion has left.
//!
//! Latency: 1 clock from `puts_out` to `waits`.

use super::types::{Item, Launch, ITEM_BITS};
use crate::engine::types::{context_bits, ContextId, CONTEXT_BITS};
use crate::leaf::{Fifo, LutMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct ReturnLine {
    pub clock: Signal<In, Clock>,
    /// Reset empties the line.
    pub reset: Signal<In, Bit>,
    /// An item leaves the queues, and begins soon: it is not out of this line.
    pub begins: Signal<In, Bit>,
    pub begun: Signal<In, Launch>,
    /// The vertex of this context is out of the mesh.
    pub puts_out: Signal<In, Bit>,
    pub put_out_context: Signal<In, ContextId>,
    /// A vertex waits, and its item; it goes back at this edge. The user sets `goes` only while `waits` is 1.
    pub waits: Signal<Out, Bit>,
    pub launch: Signal<Out, Launch>,
    pub goes: Signal<In, Bit>,
    items: LutMemory<CONTEXT_BITS, ITEM_BITS>,
    unpacked: Unpack<Item, ITEM_BITS>,
    came: DFF<Bit>,
    out_context: DFF<ContextId>,
    line: Fifo<CONTEXT_BITS, CONTEXT_BITS>,
    begun_item: Signal<Local, Item>,
    begun_bits: Signal<Local, Bits<ITEM_BITS>>,
    item: Signal<Local, Item>,
    returned: Signal<Local, Item>,
}

impl ReturnLine {
    /// The line of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        Self { items: LutMemory::new(bits, ITEM_BITS), line: Fifo::new(bits, CONTEXT_BITS), ..Self::default() }
    }
}

impl Logic for ReturnLine {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, came, out_context);
        clock!(self, clock, items, line);
        self.begun_item.next = self.begun.val().item;
        self.begun_bits.next = self.begun_item.val().into();
        self.items.write_address.next = self.begun.val().context;
        self.items.write_data.next = self.begun_bits.val();
        self.items.write_enable.next = self.begins.val();
        self.came.d.next = self.puts_out.val() & (!self.reset.val());
        self.out_context.d.next = self.put_out_context.val();
        self.line.reset.next = self.reset.val();
        self.line.push.next = self.came.q.val();
        self.line.push_data.next = self.out_context.q.val();
        self.line.pop.next = self.goes.val();
        self.items.read_address.next = self.line.data.val();
        self.unpacked.bits.next = self.items.read_data.val();
        self.item.next = self.unpacked.value.val();
        self.waits.next = self.line.valid.val();
        self.launch.next.context = self.line.data.val();
        self.returned.next = self.item.val();
        self.returned.next.place = self.item.val().target;
        self.returned.next.owns = true;
        self.launch.next.item = self.returned.val();
    }
}
