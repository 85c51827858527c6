//! The point that each context inserts, and the clock count when the context took it. A commit needs both: the new
//! vertex for its records, the clock count for the latency.
//!
//! 1. There is no reset: the point of a context is arbitrary until the context takes one.
//!
//! Latency: 2 clocks from `start` to `vertex` and `since`, long before any visit for the point
//! completes; none from `context_id`.
//!
//! Context 1 takes point 7 at time 3:
//! ```text
//! takes           /^^\________
//! taker             1  .  .  .
//! taken_id          7  .  .  .
//! now               3  .  .  .
//! context_id        .  .  1  .
//! vertex            .  .  7  .
//! since             .  .  3  .
//! ```

use crate::engine::types::{context_bits, Clocks, ContextId, Start, VertexId, CONTEXT_BITS, LATENCY_BITS, VERTEX_BITS};
use crate::leaf::LutMemory;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct AttemptPoints {
    pub clock: Signal<In, Clock>,
    /// A context that starts and may take a point at this edge; the clock count.
    pub start: Signal<In, Start>,
    pub now: Signal<In, Clocks>,
    /// A context; its point, and the clock count when the context took the point.
    pub context_id: Signal<In, ContextId>,
    pub vertex: Signal<Out, VertexId>,
    pub since: Signal<Out, Clocks>,
    points: LutMemory<CONTEXT_BITS, VERTEX_BITS>,
    times: LutMemory<CONTEXT_BITS, LATENCY_BITS>,
    has_taken: DFF<Bit>,
    last_taker: DFF<ContextId>,
    last_taken: DFF<VertexId>,
    taken_at: DFF<Clocks>,
}

impl AttemptPoints {
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        Self { points: LutMemory::new(bits, VERTEX_BITS), times: LutMemory::new(bits, LATENCY_BITS), ..Self::default() }
    }
}

impl Logic for AttemptPoints {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, has_taken, last_taker, last_taken, taken_at);
        clock!(self, clock, points, times);
        self.has_taken.d.next = self.start.val().takes;
        self.last_taker.d.next = self.start.val().context;
        self.last_taken.d.next = self.start.val().id;
        self.taken_at.d.next = self.now.val();
        self.points.write_address.next = self.last_taker.q.val();
        self.points.write_data.next = self.last_taken.q.val();
        self.points.write_enable.next = self.has_taken.q.val();
        self.times.write_address.next = self.last_taker.q.val();
        self.times.write_data.next = self.taken_at.q.val();
        self.times.write_enable.next = self.has_taken.q.val();
        self.points.read_address.next = self.context_id.val();
        self.times.read_address.next = self.context_id.val();
        self.vertex.next = self.points.read_data.val();
        self.since.next = self.times.read_data.val();
    }
}
