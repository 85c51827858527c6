//! Looks whether a record names the vertex of its context, and whether it is free.
//!
//! 1. A free record has the infinite vertex three times (M8).
//!
//! Latency: 1 clock from the early inputs.

use crate::engine::types::{context_bits, Start, Turned, Upcoming, VertexId, Visit, CONTEXT_BITS, VERTEX_BITS};
use crate::leaf::LutMemory;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct NamedVertex {
    pub clock: Signal<In, Clock>,
    /// A context that starts and may take a vertex at this edge.
    pub start: Signal<In, Start>,
    /// The visit that completes in the next clock.
    pub early: Signal<In, Upcoming>,
    /// Of the visit that completes in this clock: the slot of the vertex, if the record names it; and whether the
    /// record is free.
    pub names0: Signal<Out, Bit>,
    pub names1: Signal<Out, Bit>,
    pub names2: Signal<Out, Bit>,
    pub is_free: Signal<Out, Bit>,
    vertices: LutMemory<CONTEXT_BITS, VERTEX_BITS>,
    has_taken: DFF<Bit>,
    taker: DFF<Bits<5>>,
    taken: DFF<VertexId>,
    is_v0: DFF<Bit>,
    is_v1: DFF<Bit>,
    is_v2: DFF<Bit>,
    free: DFF<Bit>,
    visit: Signal<Local, Visit>,
    turned: Signal<Local, Turned>,
}

impl NamedVertex {
    pub fn new(config: Config) -> Self {
        Self { vertices: LutMemory::new(context_bits(config), VERTEX_BITS), ..Self::default() }
    }
}

impl Logic for NamedVertex {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, has_taken, taker, taken, is_v0, is_v1, is_v2, free);
        clock!(self, clock, vertices);
        self.has_taken.d.next = self.start.val().takes;
        self.taker.d.next = self.start.val().context;
        self.taken.d.next = self.start.val().id;
        self.vertices.write_address.next = self.taker.q.val();
        self.vertices.write_data.next = self.taken.q.val();
        self.vertices.write_enable.next = self.has_taken.q.val();
        self.visit.next = self.early.val().visit;
        self.turned.next = self.early.val().turned;
        self.vertices.read_address.next = self.visit.val().context;
        self.is_v0.d.next = self.turned.val().v0 == self.vertices.read_data.val();
        self.is_v1.d.next = self.turned.val().v1 == self.vertices.read_data.val();
        self.is_v2.d.next = self.turned.val().v2 == self.vertices.read_data.val();
        self.free.d.next = self.turned.val().infinite0 & self.turned.val().infinite1 & self.turned.val().infinite2;
        self.names0.next = self.is_v0.q.val();
        self.names1.next = self.is_v1.q.val();
        self.names2.next = self.is_v2.q.val();
        self.is_free.next = self.free.q.val();
    }
}
