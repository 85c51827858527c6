//! The dot product of two vectors: two multipliers and an addition.
//!
//! 1. New vectors are taken at every edge. There is no reset.
//! 2. Parts of the vectors are differences of 16-bit coordinates, so each product is below `2^32` and the result fits 34 bits; the
//!    upper bits of the 36 repeat the sign.
//!
//! Latency: vectors that stand before edge 1 give the result after edge 4: edges 1 to 3 the multipliers, 4 the addition. Its
//! register keeps the adder apart from whatever the user multiplies the result with.
//!
//! Apart from the wiring and the operator it is [`CrossProduct`](super::CrossProduct), whose header says why there are two.
//!
//! Source: the dot products of the Cline-Renka form of incircle.

use crate::leaf::Multiplier;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// A dot product; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct DotProduct {
    pub clock: Signal<In, Clock>,
    /// The vectors, two's complement.
    pub a_x: Signal<In, Bits<18>>,
    pub a_y: Signal<In, Bits<18>>,
    pub b_x: Signal<In, Bits<18>>,
    pub b_y: Signal<In, Bits<18>>,
    /// `a_x * b_x + a_y * b_y`, two's complement.
    pub product: Signal<Out, Bits<36>>,
    x_by_x: Multiplier,
    y_by_y: Multiplier,
    sum: DFF<Bits<36>>,
}

impl DotProduct {
    /// Edges from vectors to result.
    pub const LATENCY: usize = Multiplier::LATENCY + 1;
}

impl Logic for DotProduct {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, x_by_x, y_by_y, sum);
        self.x_by_x.a.next = self.a_x.val();
        self.x_by_x.b.next = self.b_x.val();
        self.y_by_y.a.next = self.a_y.val();
        self.y_by_y.b.next = self.b_y.val();
        self.sum.d.next = self.x_by_x.product.val() + self.y_by_y.product.val();
        self.product.next = self.sum.q.val();
    }
}
