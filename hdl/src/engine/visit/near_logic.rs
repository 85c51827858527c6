//! Says where a search round the nearest corner of a record begins and where it goes on.
//!
//! 1. The search needs all spokes of the corner that are ahead. Two chains of visits look for them: the chain to the
//!    right leaves the record across the spoke to the next corner, and the chain to the left across the spoke to the
//!    corner before.
//! 2. A chain ends at a spoke that is *past*: not ahead, and on the chain's own side of the direction to the place.
//! 3. A chain also ends in a record that has the direction away from the place inside: with the next corner to the left
//!    and the corner before to the right. A search that begins in such a record has only the chain to the left, which
//!    goes round once.
//! 4. A spoke to the infinite vertex stands for the directions between two hull edges, which are 180 degrees apart or
//!    more. A chain ends before such a spoke if the other spoke is on the chain's own side, and behind it if the other
//!    spoke is on the other side: the direction away from the place lies between.
//! 5. `slot` counts the corners of the record as rotated.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{NearVerdict, Slot};
use crate::predicate::{EdgeFlags, NearSigns};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct NearLogic {
    /// The nearest corner, and the signs of the edges, for the corners as stored.
    pub nearest: Signal<In, NearSigns>,
    pub edges: Signal<In, EdgeFlags>,
    /// The stored slot that came first.
    pub first_slot: Signal<In, Slot>,
    pub verdict: Signal<Out, NearVerdict>,
    slot: Signal<Local, Slot>,
    is_second: Signal<Local, Bit>,
    is_third: Signal<Local, Bit>,
    next_is_left: Signal<Local, Bit>,
    next_is_straight: Signal<Local, Bit>,
    before_is_right: Signal<Local, Bit>,
    before_is_straight: Signal<Local, Bit>,
    next_is_past: Signal<Local, Bit>,
    before_is_past: Signal<Local, Bit>,
    looks_away: Signal<Local, Bit>,
    ends_right: Signal<Local, Bit>,
    ends_left: Signal<Local, Bit>,
    comes_back_right: Signal<Local, Bit>,
    comes_back_left: Signal<Local, Bit>,
    first: Signal<Local, Slot>,
    second: Signal<Local, Slot>,
    third: Signal<Local, Slot>,
}

impl Logic for NearLogic {
    #[hdl_gen]
    fn update(&mut self) {
        self.first.next = 0.into();
        self.second.next = 1.into();
        self.third.next = 2.into();
        self.slot.next = self.nearest.val().slot;
        self.is_second.next = self.slot.val() == self.second.val();
        self.is_third.next = self.slot.val() == self.third.val();

        // The spoke to the next corner is the edge opposite the corner before, and runs along that edge. The spoke to
        // the corner before runs against the edge opposite the next corner.
        self.next_is_left.next = self.edges.val().e2_negative;
        self.next_is_straight.next = self.edges.val().e2_zero;
        self.before_is_right.next = self.edges.val().e1_negative;
        self.before_is_straight.next = self.edges.val().e1_zero;
        if self.is_second.val() {
            self.next_is_left.next = self.edges.val().e0_negative;
            self.next_is_straight.next = self.edges.val().e0_zero;
            self.before_is_right.next = self.edges.val().e2_negative;
            self.before_is_straight.next = self.edges.val().e2_zero;
        }
        if self.is_third.val() {
            self.next_is_left.next = self.edges.val().e1_negative;
            self.next_is_straight.next = self.edges.val().e1_zero;
            self.before_is_right.next = self.edges.val().e0_negative;
            self.before_is_straight.next = self.edges.val().e0_zero;
        }

        self.next_is_past.next =
            (!self.nearest.val().next_is_infinite) & (!self.nearest.val().next_is_ahead) & (!self.next_is_left.val());
        self.before_is_past.next = (!self.nearest.val().before_is_infinite)
            & (!self.nearest.val().before_is_ahead)
            & (!self.before_is_right.val());
        self.looks_away.next = (!self.nearest.val().next_is_infinite)
            & (!self.nearest.val().before_is_infinite)
            & self.next_is_left.val()
            & self.before_is_right.val();
        self.ends_right.next = self.next_is_past.val()
            | self.looks_away.val()
            | (self.nearest.val().next_is_infinite & (self.before_is_right.val() | self.before_is_straight.val()));
        self.ends_left.next = self.before_is_past.val()
            | (self.nearest.val().before_is_infinite & (self.next_is_left.val() | self.next_is_straight.val()));
        self.comes_back_right.next = self.nearest.val().before_is_infinite & self.next_is_left.val();
        self.comes_back_left.next =
            self.looks_away.val() | (self.nearest.val().next_is_infinite & self.before_is_right.val());
        self.verdict.next.begins_right = !self.ends_right.val();
        self.verdict.next.begins_left = !self.ends_left.val();
        self.verdict.next.goes_right = (!self.ends_right.val()) & (!self.comes_back_right.val());
        self.verdict.next.goes_left = (!self.ends_left.val()) & (!self.comes_back_left.val());

        self.verdict.next.slot = self.slot.val();
        if self.first_slot.val() == self.second.val() {
            self.verdict.next.slot = self.slot.val() - self.second.val();
            if (!self.is_second.val()) & (!self.is_third.val()) {
                self.verdict.next.slot = self.third.val();
            }
        }
        if self.first_slot.val() == self.third.val() {
            self.verdict.next.slot = self.slot.val() + self.second.val();
            if self.is_third.val() {
                self.verdict.next.slot = self.first.val();
            }
        }
    }
}
