//! The meaning of a completed visit of a deletion, or of a move whose vertex is in the mesh, as far as its star does
//! not decide.
//!
//! 1. Visits of a star and those outside turn their record and lock it. A visit outside has place 0 or the mark 32 in
//!    `after`. A visit that turns its record and does not lock is a test of a hole, or with the mark 64 in
//!    `cavity_record` the test of the last edge of a star that moves.
//! 2. Everything is decided a clock ahead.
//!
//! Latency: 1 clock.

use crate::engine::types::{RingEntry, TriangleId, Turned, Upcoming, Visit};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct StarCase {
    pub clock: Signal<In, Clock>,
    /// The visit that completes in the next clock, whether it is one of a deletion or of such a move, and whether its
    /// context holds the priority.
    pub finds: Signal<In, Bit>,
    pub early: Signal<In, Upcoming>,
    pub holds_priority: Signal<In, Bit>,
    /// Of the visit that completes in this clock: it is a root visit that has its lock; a visit of a star or outside,
    /// and then which; a test of a hole; that of the last edge; it may ask for visits.
    pub is_root: Signal<Out, Bit>,
    pub is_star: Signal<Out, Bit>,
    pub is_outside: Signal<Out, Bit>,
    pub is_test: Signal<Out, Bit>,
    pub is_last_edge: Signal<Out, Bit>,
    pub may_ask: Signal<Out, Bit>,
    /// Another context holds its lock; and its own context waits for that.
    pub is_foreign: Signal<Out, Bit>,
    pub is_awaited: Signal<Out, Bit>,
    rooted: DFF<Bit>,
    star: DFF<Bit>,
    outside: DFF<Bit>,
    test: DFF<Bit>,
    last_edge: DFF<Bit>,
    asks: DFF<Bit>,
    foreign: DFF<Bit>,
    awaited: DFF<Bit>,
    visit: Signal<Local, Visit>,
    turned: Signal<Local, Turned>,
    comes: Signal<Local, Bit>,
    goes_round: Signal<Local, Bit>,
    lies_outside: Signal<Local, Bit>,
    first_place: Signal<Local, RingEntry>,
    mark: Signal<Local, RingEntry>,
    tests: Signal<Local, Bit>,
    cavity: Signal<Local, TriangleId>,
}

impl Logic for StarCase {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, rooted, star, outside, test, last_edge, asks, foreign, awaited);
        self.first_place.next = 0.into();
        self.mark.next = 32.into();
        self.visit.next = self.early.val().visit;
        self.turned.next = self.early.val().turned;
        self.comes.next = self.early.val().done & self.finds.val();
        self.goes_round.next = self.comes.val() & self.visit.val().rotates & self.visit.val().locks;
        self.lies_outside.next =
            (self.visit.val().entry == self.first_place.val()) | (self.visit.val().after == self.mark.val());
        self.rooted.d.next =
            self.comes.val() & (!self.visit.val().rotates) & self.visit.val().locks & (!self.turned.val().foreign);
        self.star.d.next = self.goes_round.val();
        self.outside.d.next = self.goes_round.val() & self.lies_outside.val();
        self.tests.next = self.comes.val() & self.visit.val().rotates & (!self.visit.val().locks);
        self.cavity.next = self.visit.val().cavity_record;
        self.test.d.next = self.tests.val() & (!self.cavity.val().get_bit(6));
        self.last_edge.d.next = self.tests.val() & self.cavity.val().get_bit(6);
        self.asks.d.next = self.comes.val()
            & self.visit.val().rotates
            & ((!self.visit.val().locks) | (!self.lies_outside.val()) | self.turned.val().foreign);
        self.foreign.d.next = self.turned.val().foreign;
        self.awaited.d.next = self.turned.val().foreign & self.holds_priority.val();
        self.is_root.next = self.rooted.q.val();
        self.is_star.next = self.star.q.val();
        self.is_outside.next = self.outside.q.val();
        self.is_test.next = self.test.q.val();
        self.is_last_edge.next = self.last_edge.q.val();
        self.may_ask.next = self.asks.q.val();
        self.is_foreign.next = self.foreign.q.val();
        self.is_awaited.next = self.awaited.q.val();
    }
}
