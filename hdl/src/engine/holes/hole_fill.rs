//! Goes on from interval to interval of a hole, one step in each clock and one hole at a time: puts a triangle on the
//! base of the interval, and asks for the first test of the next one.
//!
//! 1. A hole waits in line until those before it have got as far as a test or their end.
//! 2. A test enters the queue of visits in a clock in which nothing else does (`pushes`). A hole that is full or flat
//!    ends in a clock in which no other item does (`ends`).
//! 3. While the writer is full, no triangle is put and no hole ends.
//!
//! Latency: 2 clocks from `came` to the request if nothing waits.

use super::next_interval::NextInterval;
use crate::engine::attempt::ContextAddress;
use crate::engine::types::{
    context_bits, ContextId, FillEnd, FillJob, FillRequest, Hole, HoleCame, HoleOf, VertexId, CONTEXT_BITS,
    HOLE_OF_BITS, VERTEX_BITS,
};
use crate::leaf::{Fifo, LutMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

/// The next step for the hole at work.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum FillState {
    /// No hole is at work.
    Idle,
    /// The apex of its interval is known.
    Step,
    /// A test is asked for.
    Push,
    /// The hole is full or flat.
    End,
}

#[derive(LogicBlock, Default)]
pub struct HoleFill {
    pub clock: Signal<In, Clock>,
    /// Reset drops all holes.
    pub reset: Signal<In, Bit>,
    /// A hole opens, or its next apex is known.
    pub came: Signal<In, HoleCame>,
    /// The hole whose test is asked for (`asks`), and whether its visit enters the queue at this edge.
    pub asks: Signal<Out, Bit>,
    pub hole: Signal<Out, HoleOf>,
    pub pushes: Signal<In, Bit>,
    /// The item that ends, if `ends` allows it.
    pub ending: Signal<Out, FillEnd>,
    pub may_end: Signal<In, Bit>,
    /// A triangle, or the end of a deletion, for the writer, which takes no more while `is_full`.
    pub job: Signal<Out, FillRequest>,
    pub is_full: Signal<In, Bit>,
    /// The vertex of a context that takes one (`takes`).
    pub takes: Signal<In, Bit>,
    pub taker: Signal<In, ContextId>,
    pub taken: Signal<In, VertexId>,
    arrival: DFF<HoleCame>,
    line: Fifo<CONTEXT_BITS, HOLE_OF_BITS>,
    first: Unpack<HoleOf, HOLE_OF_BITS>,
    state: DFF<FillState>,
    work: DFF<HoleOf>,
    interval: NextInterval,
    /// The intervals that wait: the places of their ends.
    waiting: LutMemory<9, 12>,
    write_at: ContextAddress<4, 9>,
    read_at: ContextAddress<4, 9>,
    vertices: LutMemory<CONTEXT_BITS, VERTEX_BITS>,
    arrived: Signal<Local, HoleOf>,
    arrived_bits: Signal<Local, Bits<HOLE_OF_BITS>>,
    current: Signal<Local, HoleOf>,
    hole_now: Signal<Local, Hole>,
    hole_after: Signal<Local, Hole>,
    depth: Signal<Local, Bits<4>>,
    one: Signal<Local, Bits<4>>,
    takes_first: Signal<Local, Bit>,
    is_active: Signal<Local, Bit>,
    steps: Signal<Local, Bit>,
    ends_now: Signal<Local, Bit>,
    wide_i: Signal<Local, Bits<12>>,
    wide_j: Signal<Local, Bits<12>>,
    shift: Signal<Local, Bits<12>>,
    given: Signal<Local, FillJob>,
}

impl HoleFill {
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        Self {
            line: Fifo::new(bits, HOLE_OF_BITS),
            interval: NextInterval::new(config),
            waiting: LutMemory::new(bits + 4, 12),
            write_at: ContextAddress::new(4),
            read_at: ContextAddress::new(4),
            vertices: LutMemory::new(bits, VERTEX_BITS),
            ..Self::default()
        }
    }
}

impl Logic for HoleFill {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, arrival, state, work);
        clock!(self, clock, line, waiting, vertices);
        self.one.next = 1.into();
        self.shift.next = 6.into();
        self.arrival.d.next = self.came.val();
        self.arrived.next = self.arrival.q.val().hole;
        self.arrived_bits.next = self.arrived.val().into();
        self.line.reset.next = self.reset.val();
        self.line.push.next = self.arrival.q.val().valid;
        self.line.push_data.next = self.arrived_bits.val();
        self.takes_first.next = (self.state.q.val() == FillState::Idle) & self.line.valid.val();
        self.line.pop.next = self.takes_first.val();
        self.first.bits.next = self.line.data.val();
        self.current.next = self.work.q.val();
        if self.takes_first.val() {
            self.current.next = self.first.value.val();
        }
        self.hole_now.next = self.current.val().hole;
        self.is_active.next = self.takes_first.val() | (self.state.q.val() == FillState::Step);
        self.steps.next = self.is_active.val() & self.hole_now.val().is_ready & (!self.is_full.val());

        self.interval.hole.next = self.hole_now.val();
        self.depth.next = self.hole_now.val().depth;
        self.read_at.context_id.next = self.current.val().context;
        self.read_at.place.next = self.depth.val() - self.one.val();
        self.waiting.read_address.next = self.read_at.address.val();
        self.interval.waiting_i.next = self.waiting.read_data.val().get_bits::<6>(0);
        self.interval.waiting_j.next = self.waiting.read_data.val().get_bits::<6>(6);
        self.write_at.context_id.next = self.current.val().context;
        self.write_at.place.next = self.depth.val();
        self.wide_i.next = bit_cast::<12, 6>(self.hole_now.val().best);
        self.wide_j.next = bit_cast::<12, 6>(self.hole_now.val().j);
        self.waiting.write_address.next = self.write_at.address.val();
        self.waiting.write_data.next = self.wide_i.val() | (self.wide_j.val() << self.shift.val());
        self.waiting.write_enable.next = self.steps.val() & self.interval.pushes.val();

        self.asks.next = self.state.q.val() == FillState::Push;
        self.hole.next = self.work.q.val();
        self.ends_now.next = (self.state.q.val() == FillState::End) & (!self.is_full.val());
        self.ending.next.valid = self.ends_now.val();
        self.ending.next.context = self.current.val().context;
        self.ending.next.is_flat = self.hole_now.val().is_dry;
        self.ending.next.vertex = self.vertices.read_data.val();
        self.ending.next.locks = self.hole_now.val().locks;

        self.vertices.write_address.next = self.taker.val();
        self.vertices.write_data.next = self.taken.val();
        self.vertices.write_enable.next = self.takes.val();
        self.vertices.read_address.next = self.current.val().context;
        self.given.next.context = self.current.val().context;
        self.given.next.i = self.hole_now.val().i;
        self.given.next.m = self.hole_now.val().best;
        self.given.next.j = self.hole_now.val().j;
        self.given.next.base = self.hole_now.val().base;
        self.given.next.mends = self.interval.mends.val();
        self.given.next.ends = false;
        self.given.next.vertex = self.vertices.read_data.val();
        self.given.next.locks = self.hole_now.val().locks;
        if self.state.q.val() == FillState::End {
            self.given.next.i = self.interval.start.val();
            self.given.next.m = self.interval.second.val();
            self.given.next.j = self.hole_now.val().end;
            self.given.next.base = 0.into();
            self.given.next.mends = false;
            self.given.next.ends = true;
        }
        self.job.next.valid = (self.steps.val() & self.interval.writes.val())
            | (self.ends_now.val() & self.may_end.val() & (!self.hole_now.val().is_dry));
        self.job.next.job = self.given.val();

        self.work.d.next = self.current.val();
        self.hole_after.next = self.interval.after.val();
        if self.is_active.val() {
            self.state.d.next = FillState::Step;
            if !self.hole_now.val().is_ready {
                self.state.d.next = FillState::Push;
            }
        }
        if self.steps.val() {
            self.work.d.next.hole = self.hole_after.val();
            if self.interval.ends.val() {
                self.work.d.next.hole = self.hole_now.val();
                self.state.d.next = FillState::End;
            } else if !self.hole_after.val().is_ready {
                self.state.d.next = FillState::Push;
            }
        }
        if (self.asks.val() & self.pushes.val()) | (self.ends_now.val() & self.may_end.val()) {
            self.state.d.next = FillState::Idle;
        }
        if self.reset.val() {
            self.state.d.next = FillState::Idle;
            self.arrival.d.next.valid = false;
        }
    }
}
