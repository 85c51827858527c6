//! The point that each context inserts, and when it took it.
//!
//! 1. There is no reset: what a context has taken is arbitrary until it takes something.
//!
//! Latency: a point is there 2 clocks after it is taken, long before any visit of it completes. A context is answered at once.
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
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The points at hand; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct AttemptPoints {
    pub clock: Signal<In, Clock>,
    /// A context that starts may take a point at this edge; the time.
    pub start: Signal<In, Start>,
    pub now: Signal<In, Clocks>,
    /// A context; its point, and when it was taken.
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
    /// The points of a configuration.
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
