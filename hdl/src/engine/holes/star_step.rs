//! The star of a vertex after one of its visits: two chains go round it, one each way from the root, until they meet.
//!
//! 1. A record of the star asks for the record outside, and for the next record of its chain, unless that is the one
//!    which the other chain visits or has visited last. A ring that would be longer than the list drains.
//! 2. A visit that meets a foreign lock makes the attempt drain (M4), or is made again (M5). So is a record of the star
//!    with a point that was torn (M14).
//! 3. The star is over when its last visit completes. If the vertex moves, and may keep all its edges, the last edge is
//!    tested (M12); else the hole opens. A vertex on the hull keeps none.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{LockCount, RingCount, RingEntry, Star, TriangleId, Turned, Visit};
use crate::leaf::Parameter;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct StarStep {
    /// The visit that completes with its record, and the flags of [`StarCase`](super::StarCase).
    pub visit: Signal<In, Visit>,
    pub turned: Signal<In, Turned>,
    pub is_star: Signal<In, Bit>,
    pub is_outside: Signal<In, Bit>,
    pub is_foreign: Signal<In, Bit>,
    pub is_awaited: Signal<In, Bit>,
    /// The visit is one of a move; the vertex has its new place already; its edges stay as far as the visit can tell.
    pub moves: Signal<In, Bit>,
    pub stays: Signal<In, Bit>,
    pub keeps: Signal<In, Bit>,
    /// The number of entries that a ring can have, a constant.
    pub ring_capacity: Signal<In, RingCount>,
    /// The star, and whether the next record of the chain is the head of the other chain.
    pub held: Signal<In, Star>,
    pub meets: Signal<In, Bit>,
    pub after: Signal<Out, Star>,
    /// The visit is made again; the record outside is asked for, and the next record of the chain (`goes_on`).
    pub revisits: Signal<Out, Bit>,
    /// The visit is made again because it waits for a lock.
    pub waits: Signal<Out, Bit>,
    pub looks_outside: Signal<Out, Bit>,
    pub goes_on: Signal<Out, Bit>,
    pub onward: Signal<Out, TriangleId>,
    pub outside: Signal<Out, TriangleId>,
    pub next_place: Signal<Out, RingEntry>,
    /// The visit brings an entry of the ring; it aborts the attempt; or the star is over, and the attempt has failed
    /// (`fails`), or the last edge is tested (`closes`), or the hole opens.
    pub settles: Signal<Out, Bit>,
    pub aborts: Signal<Out, Bit>,
    pub fails: Signal<Out, Bit>,
    pub closes: Signal<Out, Bit>,
    pub opens: Signal<Out, Bit>,
    /// A record of the star counts; the visit may close the star.
    pub goes_round: Signal<Out, Bit>,
    pub may_close: Signal<Out, Bit>,
    /// The star may be over, which is known sooner.
    pub may_settle: Signal<Out, Bit>,
    is_live: Signal<Local, Bit>,
    is_torn: Signal<Local, Bit>,
    counts: Signal<Local, Bit>,
    is_right: Signal<Local, Bit>,
    place: Signal<Local, RingEntry>,
    outstanding: Signal<Local, RingCount>,
    count: Signal<Local, RingCount>,
    logged: Signal<Local, LockCount>,
    goes: Signal<Local, Bit>,
    overflows: Signal<Local, Bit>,
    looks: Signal<Local, Bit>,
    again: Signal<Local, Bit>,
    refused: Signal<Local, Bit>,
    next_record: Signal<Local, TriangleId>,
    left_after: Signal<Local, RingCount>,
    is_last: Signal<Local, Bit>,
    entry: Signal<Local, RingEntry>,
    fails_now: Signal<Local, Bit>,
    keeps_all: Signal<Local, Bit>,
    is_kept: Signal<Local, Bit>,
    one: Signal<Local, RingCount>,
    two: Signal<Local, RingCount>,
    is_round: Signal<Local, Bit>,
    is_almost_full: Signal<Local, Bit>,
    one_place: Signal<Local, RingEntry>,
    places: Parameter<RingEntry>,
}

impl StarStep {
    pub fn new(config: Config) -> Self {
        let places = (1u64 << crate::engine::types::ring_bits(config)) - 1;
        Self { places: Parameter::new(places.into()), ..Self::default() }
    }
}

impl Logic for StarStep {
    #[hdl_gen]
    fn update(&mut self) {
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.one_place.next = 1.into();
        self.entry.next = self.visit.val().entry;
        self.is_right.next = self.entry.val().get_bit(5);
        self.place.next = self.entry.val() & self.places.val();
        self.outstanding.next = self.held.val().outstanding;
        self.count.next = self.held.val().count;
        self.logged.next = self.held.val().logged;
        self.is_almost_full.next = self.count.val() == (self.ring_capacity.val() - self.one.val());

        // M4, M5: a foreign lock makes the attempt drain, unless its context has the priority.
        self.is_live.next = self.is_star.val() & (!self.held.val().drains);
        self.is_torn.next = self.turned.val().again & (!self.is_foreign.val()) & (!self.is_outside.val());
        self.waits.next = self.is_live.val() & self.is_awaited.val();
        self.again.next = self.is_live.val() & (self.is_awaited.val() | self.is_torn.val());
        self.refused.next = self.is_live.val() & self.is_foreign.val() & (!self.is_awaited.val());
        self.counts.next = self.is_live.val() & (!self.is_foreign.val()) & (!self.is_torn.val());
        self.revisits.next = self.again.val();
        self.aborts.next = self.refused.val();
        self.settles.next = self.counts.val() & self.is_outside.val();

        // The record comes turned so that the record of the chain before lies opposite slot 0. To the left, the vertex
        // stands in slot 1, to the right in slot 2.
        self.next_record.next = self.turned.val().n2;
        self.outside.next = self.turned.val().n1;
        self.next_place.next = self.entry.val() + self.one_place.val();
        if self.is_right.val() {
            self.next_record.next = self.turned.val().n1;
            self.outside.next = self.turned.val().n2;
            self.next_place.next = self.entry.val() - self.one_place.val();
        }
        self.onward.next = self.next_record.val();
        self.is_round.next = self.counts.val() & (!self.is_outside.val());
        self.goes.next = self.is_round.val() & (!self.meets.val()) & (!self.held.val().is_full);
        self.overflows.next = self.is_round.val() & (!self.meets.val()) & self.held.val().is_full;
        self.looks.next = self.is_round.val() & (self.meets.val() | (!self.held.val().is_full));
        self.goes_on.next = self.goes.val();
        self.looks_outside.next = self.looks.val();

        self.left_after.next = self.outstanding.val() - self.one.val();
        if self.again.val() | (self.looks.val() & (!self.goes.val())) {
            self.left_after.next = self.outstanding.val();
        }
        if self.goes.val() {
            self.left_after.next = self.outstanding.val() + self.one.val();
        }
        // The visit is the last one if it asks for no other.
        self.may_settle.next = self.is_star.val() & self.held.val().is_one;
        self.is_last.next = self.is_star.val() & self.held.val().is_one & (!self.again.val()) & (!self.looks.val());
        self.fails_now.next = self.held.val().drains | self.refused.val() | self.overflows.val();
        self.fails.next = self.is_last.val() & self.fails_now.val();
        self.keeps_all.next = self.held.val().keeps & self.keeps.val();
        self.is_kept.next =
            self.moves.val() & (self.stays.val() | (self.keeps_all.val() & (!self.held.val().has_infinite)));
        if self.turned.val().infinite2 & (!self.stays.val()) {
            self.is_kept.next = false;
        }
        self.closes.next = self.is_last.val() & (!self.fails_now.val()) & self.is_kept.val();
        self.opens.next = self.is_last.val() & (!self.fails_now.val()) & (!self.is_kept.val());
        self.goes_round.next = self.is_round.val();
        self.may_close.next = self.moves.val() & self.is_outside.val() & self.held.val().is_one;

        self.after.next = self.held.val();
        self.after.next.outstanding = self.left_after.val();
        self.after.next.is_one = self.outstanding.val() == self.two.val();
        if self.again.val() | self.looks.val() {
            self.after.next.is_one = self.held.val().is_one & (!self.goes.val());
        }
        self.after.next.drains = self.fails_now.val();
        if self.counts.val() {
            self.after.next.keeps = self.keeps_all.val();
        }
        self.after.next.is_too_long = self.held.val().is_too_long | self.overflows.val();
        if self.turned.val().took {
            self.after.next.logged = self.logged.val() + self.one.val();
        }
        if self.counts.val() & self.is_outside.val() {
            if self.turned.val().infinite2 {
                self.after.next.has_infinite = true;
                self.after.next.infinite = self.place.val();
            }
            if (!self.turned.val().infinite0) & (!self.turned.val().infinite1) & (!self.turned.val().infinite2) {
                self.after.next.has_triangle = true;
            }
        }
        if self.is_round.val() {
            if self.is_right.val() {
                self.after.next.first = self.place.val();
            } else {
                self.after.next.last = self.place.val();
            }
        }
        if self.goes.val() {
            self.after.next.count = self.count.val() + self.one.val();
            self.after.next.is_full = self.is_almost_full.val();
            if self.is_right.val() {
                self.after.next.right_head = self.next_record.val();
            } else {
                self.after.next.left_head = self.next_record.val();
            }
        }
    }
}
