//! The cross product of two vectors: two multipliers and a subtraction.
//!
//! 1. The block takes new vectors at every edge. There is no reset.
//! 2. The components of the vectors are differences of 16-bit coordinates, so each product is below `2^32` and the
//!    result fits in 34 bits; the upper bits of the 36 repeat the sign.
//!
//! Latency: vectors that are valid before edge 1 give the result after edge 4: edges 1 to 3 for the multipliers, 4 for
//! the subtraction. The register of the subtraction separates the adder from a multiplier behind the block.
//!
//! The block differs from [`DotProduct`](super::DotProduct) in the wiring and the operator only. There are two blocks,
//! because a kernel of rust-hdl takes no operator as a parameter, and a subtract input would be a port that every user
//! ties to a constant.
//!
//! Source: `orient2d(u, v, p)` is the cross product of `u - p` and `v - p`.

use crate::leaf::Multiplier;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct CrossProduct {
    pub clock: Signal<In, Clock>,
    /// Components of the two vectors, in two's complement.
    pub a_x: Signal<In, Bits<18>>,
    pub a_y: Signal<In, Bits<18>>,
    pub b_x: Signal<In, Bits<18>>,
    pub b_y: Signal<In, Bits<18>>,
    /// The cross product `a_x * b_y - a_y * b_x`, in two's complement.
    pub product: Signal<Out, Bits<36>>,
    x_by_y: Multiplier,
    y_by_x: Multiplier,
    sum: DFF<Bits<36>>,
}

impl CrossProduct {
    /// Number of clock edges from the vectors to the result.
    pub const LATENCY: usize = Multiplier::LATENCY + 1;
}

impl Logic for CrossProduct {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, x_by_y, y_by_x, sum);
        self.x_by_y.a.next = self.a_x.val();
        self.x_by_y.b.next = self.b_y.val();
        self.y_by_x.a.next = self.a_y.val();
        self.y_by_x.b.next = self.b_x.val();
        self.sum.d.next = self.x_by_y.product.val() - self.y_by_x.product.val();
        self.product.next = self.sum.q.val();
    }
}
