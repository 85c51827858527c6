//! Goes on from interval to interval of a hole, two clocks for each and one hole at a time: puts a triangle on the base
//! of the interval and finds the ends of the next one, and then looks for the first test there.
//!
//! 1. A hole waits in line until those before it have got as far as a test or their end. The first in line is kept in a
//!    register, so that its work begins one clock after that of the hole before it ends. The register is filled again a
//!    clock after it was emptied.
//! 2. A test enters the queue of visits in a clock in which nothing else does (`pushes`). A hole that is full or flat
//!    ends in a clock in which no other item does (`may_end`).
//! 3. While the writer is full, no triangle is put and no hole ends.
//!
//! Latency: 4 clocks from `came` to the request for the first test of a hole that opens, if nothing waits.

use super::first_challenge::FirstChallenge;
use super::next_interval::NextInterval;
use super::next_place::NextPlace;
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
    /// The ends of its next interval are known, or those of its first one.
    Look,
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
    /// The item that ends at this edge if `may_end` allows it.
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
    /// The first hole in line, if there is one (`follows`), and the hole at work.
    follower: DFF<HoleOf>,
    follows: DFF<Bit>,
    state: DFF<FillState>,
    work: DFF<HoleOf>,
    interval: NextInterval,
    challenge: FirstChallenge,
    /// The intervals that wait: the places of their ends.
    waiting: LutMemory<9, 12>,
    write_at: ContextAddress<4, 9>,
    read_at: ContextAddress<4, 9>,
    vertices: LutMemory<CONTEXT_BITS, VERTEX_BITS>,
    arrived: Signal<Local, HoleOf>,
    came_hole: Signal<Local, Hole>,
    begun_hole: Signal<Local, Hole>,
    beginning: NextPlace,
    stored: Signal<Local, HoleOf>,
    arrived_bits: Signal<Local, Bits<HOLE_OF_BITS>>,
    hole_now: Signal<Local, Hole>,
    next_hole: Signal<Local, Hole>,
    depth: Signal<Local, Bits<4>>,
    one: Signal<Local, Bits<4>>,
    moves_up: Signal<Local, Bit>,
    is_free: Signal<Local, Bit>,
    steps: Signal<Local, Bit>,
    ends_now: Signal<Local, Bit>,
    wide_i: Signal<Local, Bits<12>>,
    wide_j: Signal<Local, Bits<12>>,
    shift: Signal<Local, Bits<12>>,
    given: Signal<Local, FillJob>,
}

impl HoleFill {
    /// The block of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        Self {
            line: Fifo::new(bits, HOLE_OF_BITS),
            beginning: NextPlace::new(config),
            interval: NextInterval::new(config),
            challenge: FirstChallenge::new(config),
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
        dff_setup!(self, clock, arrival, follower, follows, state, work);
        clock!(self, clock, line, waiting, vertices);
        self.one.next = 1.into();
        self.shift.next = 6.into();
        self.arrival.d.next = self.came.val();
        // A hole that opens comes with the end of its interval. The beginning comes after it in the ring.
        self.arrived.next = self.arrival.q.val().hole;
        self.came_hole.next = self.arrived.val().hole;
        self.beginning.place.next = self.came_hole.val().end;
        self.beginning.first.next = self.came_hole.val().first;
        self.beginning.last.next = self.came_hole.val().last;
        self.begun_hole.next = self.came_hole.val();
        if self.came_hole.val().is_new {
            self.begun_hole.next.i = self.beginning.after.val();
        }
        self.stored.next.context = self.arrived.val().context;
        self.stored.next.hole = self.begun_hole.val();
        self.arrived_bits.next = self.stored.val().into();
        self.line.reset.next = self.reset.val();
        self.line.push.next = self.arrival.q.val().valid;
        self.line.push_data.next = self.arrived_bits.val();
        self.first.bits.next = self.line.data.val();
        self.hole_now.next = self.work.q.val().hole;
        self.steps.next = (self.state.q.val() == FillState::Step) & (!self.is_full.val());
        self.ends_now.next = (self.state.q.val() == FillState::End) & (!self.is_full.val());
        self.asks.next = self.state.q.val() == FillState::Push;
        self.is_free.next = (self.state.q.val() == FillState::Idle)
            | ((self.state.q.val() == FillState::Push) & self.pushes.val())
            | (self.ends_now.val() & self.may_end.val());
        self.moves_up.next = self.line.valid.val() & (!self.follows.q.val());
        self.line.pop.next = self.moves_up.val();

        self.interval.hole.next = self.hole_now.val();
        self.depth.next = self.hole_now.val().depth;
        self.read_at.context_id.next = self.work.q.val().context;
        self.read_at.place.next = self.depth.val() - self.one.val();
        self.waiting.read_address.next = self.read_at.address.val();
        self.interval.waiting_i.next = self.waiting.read_data.val().get_bits::<6>(0);
        self.interval.waiting_j.next = self.waiting.read_data.val().get_bits::<6>(6);
        self.write_at.context_id.next = self.work.q.val().context;
        self.write_at.place.next = self.depth.val();
        self.wide_i.next = bit_cast::<12, 6>(self.hole_now.val().best);
        self.wide_j.next = bit_cast::<12, 6>(self.hole_now.val().j);
        self.waiting.write_address.next = self.write_at.address.val();
        self.waiting.write_data.next = self.wide_i.val() | (self.wide_j.val() << self.shift.val());
        self.waiting.write_enable.next = self.steps.val() & self.interval.pushes.val();

        self.hole.next = self.work.q.val();
        self.ending.next.valid = self.ends_now.val();
        self.ending.next.context = self.work.q.val().context;
        self.ending.next.is_flat = self.hole_now.val().is_dry;
        self.ending.next.vertex = self.vertices.read_data.val();
        self.ending.next.locks = self.hole_now.val().locks;

        self.vertices.write_address.next = self.taker.val();
        self.vertices.write_data.next = self.taken.val();
        self.vertices.write_enable.next = self.takes.val();
        self.vertices.read_address.next = self.work.q.val().context;
        self.given.next.context = self.work.q.val().context;
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

        self.challenge.hole.next = self.hole_now.val();
        self.next_hole.next = self.follower.q.val().hole;
        if self.steps.val() {
            self.work.d.next.hole = self.interval.after.val();
            self.state.d.next = FillState::Look;
            if self.interval.ends.val() {
                self.work.d.next.hole = self.hole_now.val();
                self.state.d.next = FillState::End;
            }
        }
        if self.state.q.val() == FillState::Look {
            self.work.d.next.hole = self.challenge.after.val();
            self.state.d.next = FillState::Push;
            if self.challenge.is_ready.val() {
                self.state.d.next = FillState::Step;
            }
        }
        if self.is_free.val() {
            self.work.d.next = self.follower.q.val();
            self.follows.d.next = false;
            self.state.d.next = FillState::Idle;
            if self.follows.q.val() {
                self.state.d.next = FillState::Push;
                if self.next_hole.val().is_ready {
                    self.state.d.next = FillState::Step;
                }
                if self.next_hole.val().is_new {
                    self.state.d.next = FillState::Look;
                }
            }
        }
        if self.moves_up.val() {
            self.follower.d.next = self.first.value.val();
            self.follows.d.next = true;
        }
        if self.reset.val() {
            self.state.d.next = FillState::Idle;
            self.follows.d.next = false;
            self.arrival.d.next.valid = false;
        }
    }
}
