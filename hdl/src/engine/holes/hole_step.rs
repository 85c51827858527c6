//! The hole of a context after a test of four vertices of its ring, and the test that comes next.
//!
//! 1. The challenger replaces the best apex if it lies to the left of the base, and the best one does not, or the
//!    challenger conflicts with its triangle. On a base with the infinite vertex the conflict alone decides.
//! 2. The last challenger of an interval makes the apex known.
//! 3. A hole that opens has the whole ring as its interval, with the infinite vertex at its end if the ring has it.
//!    [`HoleFill`](super::HoleFill) finds its beginning and its first test (`is_new`).
//!
//! Latency: 1 clock from `early_visit` to the hole; none from the verdict.

use super::next_place::NextPlace;
use crate::engine::types::{
    context_bits, Hole, HoleCame, HoleOf, RingEntry, Star, Turned, Verdict, Visit, CONTEXT_BITS, HOLE_BITS,
};
use crate::leaf::{LutMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct HoleStep {
    pub clock: Signal<In, Clock>,
    /// The visit that completes in the next clock; and the one that completes in this clock, with its findings.
    pub early_visit: Signal<In, Visit>,
    pub visit: Signal<In, Visit>,
    pub turned: Signal<In, Turned>,
    pub verdict: Signal<In, Verdict>,
    /// The best apex of the test lies to the left of the base.
    pub best_is_left: Signal<In, Bit>,
    /// The visit is a test; or the star is complete and its hole opens.
    pub is_test: Signal<In, Bit>,
    pub opens: Signal<In, Bit>,
    pub star: Signal<In, Star>,
    /// A test follows at once, and the hole with it.
    pub asks: Signal<Out, Bit>,
    pub tested: Signal<Out, Hole>,
    /// The hole opens, or its next apex is known.
    pub came: Signal<Out, HoleCame>,
    /// A hole is stored for the test that the fill asks for; never together with a test that completes.
    pub stores: Signal<In, Bit>,
    pub stored: Signal<In, HoleOf>,
    holes: LutMemory<CONTEXT_BITS, HOLE_BITS>,
    unpacked: Unpack<Hole, HOLE_BITS>,
    state: DFF<Hole>,
    after_challenger: NextPlace,
    hole: Signal<Local, Hole>,
    hole_after: Signal<Local, Hole>,
    opened: Signal<Local, Hole>,
    given: Signal<Local, HoleOf>,
    stored_hole: Signal<Local, Hole>,
    written: Signal<Local, Hole>,
    written_bits: Signal<Local, Bits<HOLE_BITS>>,
    is_ghost: Signal<Local, Bit>,
    replaces: Signal<Local, Bit>,
    ends: Signal<Local, Bit>,
    ring_end: Signal<Local, RingEntry>,
}

impl HoleStep {
    pub fn new(config: Config) -> Self {
        Self {
            holes: LutMemory::new(context_bits(config), HOLE_BITS),
            after_challenger: NextPlace::new(config),
            ..Self::default()
        }
    }
}

impl Logic for HoleStep {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        clock!(self, clock, holes);
        self.holes.read_address.next = self.early_visit.val().context;
        self.unpacked.bits.next = self.holes.read_data.val();
        self.state.d.next = self.unpacked.value.val();
        self.hole.next = self.state.q.val();

        // The corners of a test are the end of its interval, the beginning, and the best apex. None but the first can
        // be infinite.
        self.is_ghost.next = self.turned.val().infinite0 | self.turned.val().infinite1 | self.turned.val().infinite2;
        self.replaces.next = self.verdict.val().is_left & (self.verdict.val().conflict | (!self.best_is_left.val()));
        if self.is_ghost.val() {
            self.replaces.next = self.verdict.val().conflict;
        }
        self.after_challenger.place.next = self.hole.val().challenger;
        self.after_challenger.first.next = self.hole.val().first;
        self.after_challenger.last.next = self.hole.val().last;
        self.ends.next = self.after_challenger.after.val() == self.hole.val().j;
        self.hole_after.next = self.hole.val();
        self.hole_after.next.challenger = self.after_challenger.after.val();
        self.hole_after.next.is_ready = self.ends.val();
        if self.replaces.val() {
            self.hole_after.next.best = self.hole.val().challenger;
        }
        // M14: a test whose point was torn says nothing.
        if self.turned.val().again {
            self.hole_after.next = self.hole.val();
        }
        self.asks.next = self.is_test.val() & ((!self.ends.val()) | self.turned.val().again);
        self.tested.next = self.hole_after.val();

        self.ring_end.next = self.star.val().last;
        if self.star.val().has_infinite {
            self.ring_end.next = self.star.val().infinite;
        }
        self.opened.next.i = 0.into();
        self.opened.next.j = self.ring_end.val();
        self.opened.next.base = 0.into();
        self.opened.next.best = 0.into();
        self.opened.next.challenger = 0.into();
        self.opened.next.is_ready = false;
        self.opened.next.is_new = true;
        self.opened.next.end = self.ring_end.val();
        self.opened.next.first = self.star.val().first;
        self.opened.next.last = self.star.val().last;
        self.opened.next.depth = 0.into();
        self.opened.next.is_dry = self.star.val().has_infinite & (!self.star.val().has_triangle);
        self.opened.next.locks = self.star.val().logged;
        self.given.next.context = self.visit.val().context;
        self.given.next.hole = self.opened.val();
        if self.is_test.val() {
            self.given.next.hole = self.hole_after.val();
        }
        self.came.next.valid = self.opens.val() | (self.is_test.val() & self.ends.val() & (!self.turned.val().again));
        self.came.next.hole = self.given.val();

        self.stored_hole.next = self.stored.val().hole;
        self.written.next = self.hole_after.val();
        self.holes.write_address.next = self.visit.val().context;
        if self.stores.val() {
            self.written.next = self.stored_hole.val();
            self.holes.write_address.next = self.stored.val().context;
        }
        self.written_bits.next = self.written.val().into();
        self.holes.write_data.next = self.written_bits.val();
        self.holes.write_enable.next = self.is_test.val() | self.stores.val();
    }
}
