//! Says whether a place in a triangle is a corner, on a side or inside, and names the corners that have a weight.
//!
//! 1. The place lies on the right of no side. The sides with the place on their line say what the place is: with none,
//!    the place lies inside the triangle; with one, inside that side; with two, on the corner that both share.
//! 2. The weight of a corner is twice the area of the triangle between the opposite side and the place. So it is 0
//!    where the place lies on the line of that side, and the corner is not named then.
//! 3. Corners are named in the order of their slots.
//!
//! Latency: none, the block is combinational.

use super::types::Finding;
use crate::engine::types::Turned;
use crate::predicate::{EdgeFlags, Sides, Weights};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct NamedVertices {
    /// The triangle, and where the place lies with respect to its sides.
    pub turned: Signal<In, Turned>,
    pub sides: Signal<In, Sides>,
    pub finding: Signal<Out, Finding>,
    flags: Signal<Local, EdgeFlags>,
    weights: Signal<Local, Weights>,
    on_0: Signal<Local, Bit>,
    on_1: Signal<Local, Bit>,
    on_2: Signal<Local, Bit>,
}

impl Logic for NamedVertices {
    #[hdl_gen]
    fn update(&mut self) {
        self.flags.next = self.sides.val().flags;
        self.weights.next = self.sides.val().weights;
        self.on_0.next = self.flags.val().e0_zero;
        self.on_1.next = self.flags.val().e1_zero;
        self.on_2.next = self.flags.val().e2_zero;
        self.finding.next.outcome = 3.into();
        self.finding.next.v0 = self.turned.val().v0;
        self.finding.next.v1 = self.turned.val().v1;
        self.finding.next.v2 = self.turned.val().v2;
        self.finding.next.w0 = self.weights.val().w0;
        self.finding.next.w1 = self.weights.val().w1;
        self.finding.next.w2 = self.weights.val().w2;
        if self.on_0.val() {
            self.finding.next.v0 = self.turned.val().v1;
            self.finding.next.w0 = self.weights.val().w1;
        }
        if self.on_0.val() & self.on_1.val() {
            self.finding.next.v0 = self.turned.val().v2;
            self.finding.next.w0 = self.weights.val().w2;
        }
        if self.on_0.val() | self.on_1.val() {
            self.finding.next.v1 = self.turned.val().v2;
            self.finding.next.w1 = self.weights.val().w2;
        }
        if self.on_0.val() | self.on_1.val() | self.on_2.val() {
            self.finding.next.outcome = 2.into();
            self.finding.next.v2 = 0.into();
            self.finding.next.w2 = 0.into();
        }
        if (self.on_0.val() & self.on_1.val())
            | (self.on_0.val() & self.on_2.val())
            | (self.on_1.val() & self.on_2.val())
        {
            self.finding.next.outcome = 1.into();
            self.finding.next.v1 = 0.into();
            self.finding.next.w1 = 0.into();
        }
    }
}
