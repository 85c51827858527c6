//! The verdict of a visit, from the signs of its predicates: whether the record conflicts with the point, and how
//! a walk goes on.
//!
//! 1. A triangle conflicts with the point if the point lies inside its circumcircle, or on the circle and the tie rule
//!    says so: the diagonal ends in the lexicographically smallest of the four points.
//! 2. A ghost triangle conflicts if the point lies strictly beyond its hull edge, or on the line of the edge and
//!    strictly between its ends.
//! 3. Corners come as stored, but the record comes rotated, and the verdict does not depend on the rotation. A point on
//!    the circle that is no corner lies beyond exactly one side. The tie rule asks for the diagonal that ends in the
//!    corner opposite that side. In a tie of a corner `conflict` is arbitrary.
//! 4. A walk ends in a triangle that has the point on the right of no side, and in a ghost triangle whose hull edge has
//!    the point strictly beyond. A walk leaves a triangle across the most negative side, the first one of equals, and a
//!    ghost triangle across its only finite side. Walks do not rotate their records, so the `walk_next` of a triangle,
//!    `is_left` and `is_straight` count only with slot 0.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{Slot, Turned, Verdict};
use crate::predicate::{EdgeFlags, OrderFlags, Signs};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct VerdictLogic {
    /// The record as the reader has rotated it.
    pub turned: Signal<In, Turned>,
    /// The signs of the predicates for the corners as stored.
    pub signs: Signal<In, Signs>,
    /// The findings of the visit.
    pub verdict: Signal<Out, Verdict>,
    edges: Signal<Local, EdgeFlags>,
    order: Signal<Local, OrderFlags>,
    is_ghost: Signal<Local, Bit>,
    second_slot: Signal<Local, Slot>,
    third_slot: Signal<Local, Slot>,
    is_second: Signal<Local, Bit>,
    is_third: Signal<Local, Bit>,
    faces_second: Signal<Local, Bit>,
    faces_third: Signal<Local, Bit>,
    is_end0: Signal<Local, Bit>,
    is_end1: Signal<Local, Bit>,
    is_end2: Signal<Local, Bit>,
    infinite1: Signal<Local, Bit>,
    infinite2: Signal<Local, Bit>,
    is_beyond: Signal<Local, Bit>,
    is_on_hull_line: Signal<Local, Bit>,
    is_between: Signal<Local, Bit>,
    takes_tie: Signal<Local, Bit>,
    is_outside_some_side: Signal<Local, Bit>,
    leaves_by_side1: Signal<Local, Bit>,
    leaves_by_side2: Signal<Local, Bit>,
}

impl Logic for VerdictLogic {
    #[hdl_gen]
    fn update(&mut self) {
        self.edges.next = self.signs.val().edges;
        self.order.next = self.signs.val().order;
        self.is_ghost.next = self.turned.val().infinite0 | self.turned.val().infinite1 | self.turned.val().infinite2;

        // The signs come for the corners as stored, so the flags of the infinite vertex are rotated back. A ghost
        // triangle whose stored corners 1 and 2 are finite has the infinite vertex in corner 0.
        self.second_slot.next = 1.into();
        self.third_slot.next = 2.into();
        self.is_second.next = self.turned.val().slot == self.second_slot.val();
        self.is_third.next = self.turned.val().slot == self.third_slot.val();
        self.infinite1.next = self.turned.val().infinite1;
        self.infinite2.next = self.turned.val().infinite2;
        if self.is_second.val() {
            self.infinite1.next = self.turned.val().infinite0;
            self.infinite2.next = self.turned.val().infinite1;
        }
        if self.is_third.val() {
            self.infinite1.next = self.turned.val().infinite2;
            self.infinite2.next = self.turned.val().infinite0;
        }

        // The infinite corner of a ghost triangle lies opposite the hull edge, the only side
        // whose sign means something.
        self.is_beyond.next = (!self.edges.val().e0_negative) & (!self.edges.val().e0_zero);
        self.is_on_hull_line.next = self.edges.val().e0_zero;
        self.is_end0.next = self.order.val().p_equals_r0;
        self.is_end1.next = self.order.val().p_equals_r1;
        self.is_end2.next = self.order.val().p_equals_r2;
        self.is_between.next = (self.order.val().p_before_r1 ^ self.order.val().p_before_r2)
            & (!self.is_end1.val())
            & (!self.is_end2.val());
        if self.infinite1.val() {
            self.is_beyond.next = (!self.edges.val().e1_negative) & (!self.edges.val().e1_zero);
            self.is_on_hull_line.next = self.edges.val().e1_zero;
            self.is_between.next = (self.order.val().p_before_r2 ^ self.order.val().p_before_r0)
                & (!self.is_end2.val())
                & (!self.is_end0.val());
        }
        if self.infinite2.val() {
            self.is_beyond.next = (!self.edges.val().e2_negative) & (!self.edges.val().e2_zero);
            self.is_on_hull_line.next = self.edges.val().e2_zero;
            self.is_between.next = (self.order.val().p_before_r0 ^ self.order.val().p_before_r1)
                & (!self.is_end0.val())
                & (!self.is_end1.val());
        }

        // L10: a tie is a conflict if the diagonal from the point to the corner opposite the side that faces it ends in
        // the smallest of the four points: min(p, r0) < min(r1, r2), with that corner as r0. Where the visit came from
        // says nothing, because the root need not hold the point.
        self.faces_second.next = self.edges.val().e1_negative;
        self.faces_third.next = self.edges.val().e2_negative;
        self.takes_tie.next = (self.order.val().p_before_r1 & self.order.val().p_before_r2)
            | (self.order.val().r0_before_r1 & self.order.val().r0_before_r2);
        if self.faces_second.val() {
            self.takes_tie.next = (self.order.val().p_before_r2 & self.order.val().p_before_r0)
                | (self.order.val().r1_before_r2 & (!self.order.val().r0_before_r1));
        }
        if self.faces_third.val() {
            self.takes_tie.next = (self.order.val().p_before_r0 & self.order.val().p_before_r1)
                | ((!self.order.val().r0_before_r2) & (!self.order.val().r1_before_r2));
        }
        if self.is_ghost.val() {
            self.verdict.next.conflict = self.is_beyond.val() | (self.is_on_hull_line.val() & self.is_between.val());
        } else {
            self.verdict.next.conflict =
                self.signs.val().incircle_positive | (self.signs.val().incircle_zero & self.takes_tie.val());
        }

        self.is_outside_some_side.next =
            self.edges.val().e0_negative | self.edges.val().e1_negative | self.edges.val().e2_negative;
        self.leaves_by_side2.next = (self.edges.val().e1_below_e0 & self.edges.val().e2_below_e1)
            | ((!self.edges.val().e1_below_e0) & self.edges.val().e2_below_e0);
        self.leaves_by_side1.next = self.edges.val().e1_below_e0 & (!self.edges.val().e2_below_e1);
        self.verdict.next.walk_next = self.turned.val().n0;
        if self.is_ghost.val() {
            self.verdict.next.located = self.is_beyond.val();
            self.verdict.next.falls_onto_corner = false;
            if self.turned.val().infinite1 {
                self.verdict.next.walk_next = self.turned.val().n1;
            }
            if self.turned.val().infinite2 {
                self.verdict.next.walk_next = self.turned.val().n2;
            }
        } else {
            self.verdict.next.located = !self.is_outside_some_side.val();
            self.verdict.next.falls_onto_corner =
                self.order.val().p_equals_r0 | self.order.val().p_equals_r1 | self.order.val().p_equals_r2;
            if self.leaves_by_side1.val() {
                self.verdict.next.walk_next = self.turned.val().n1;
            }
            if self.leaves_by_side2.val() {
                self.verdict.next.walk_next = self.turned.val().n2;
            }
        }
        self.verdict.next.is_straight = self.edges.val().e2_zero;
        self.verdict.next.is_left = (!self.edges.val().e2_negative) & (!self.edges.val().e2_zero);
    }
}
