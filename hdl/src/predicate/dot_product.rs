//! The dot product of two vectors: two multipliers and an addition.
//!
//! 1. The block takes new vectors at every edge. There is no reset.
//! 2. The components of the vectors are differences of 16-bit coordinates, so each product is below `2^32` and the
//!    result fits in 34 bits; the upper bits of the 36 repeat the sign.
//!
//! Latency: vectors that are valid before edge 1 give the result after edge 4: edges 1 to 3 for the multipliers, 4 for
//! the addition. The register of the addition separates the adder from a multiplier behind the block.
//!
//! The block differs from [`CrossProduct`](super::CrossProduct) in the wiring and the operator only; the header of that
//! block says why there are two.
//!
//! Source: the dot products of the Cline-Renka form of incircle.

use crate::leaf::Multiplier;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct DotProduct {
    pub clock: Signal<In, Clock>,
    /// Components of the two vectors, in two's complement.
    pub a_x: Signal<In, Bits<18>>,
    pub a_y: Signal<In, Bits<18>>,
    pub b_x: Signal<In, Bits<18>>,
    pub b_y: Signal<In, Bits<18>>,
    /// The dot product `a_x * b_x + a_y * b_y`, in two's complement.
    pub product: Signal<Out, Bits<36>>,
    x_by_x: Multiplier,
    y_by_y: Multiplier,
    sum: DFF<Bits<36>>,
}

impl DotProduct {
    /// Number of clock edges from the vectors to the result.
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
