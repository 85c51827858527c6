//! Compares the distances of a record's corners to the point, and says which edges lead towards the point.
//!
//! 1. The block takes new corners at every edge. There is no reset.
//! 2. With `a_k = r_k - p`, the squared distance of corner `k` is `a_k * a_k`, and the spoke from corner `i` to corner
//!    `j` is ahead if `a_i * a_j < a_i * a_i`. That is the sign of the dot product of `r_j - r_i` and `p - r_i`.
//! 3. All products are below 2^33 in magnitude, so nothing ever wraps. The corners of a record are different points;
//!    the flags of an infinite corner are arbitrary.
//!
//! Latency: corners that are valid before edge 1 give their flags after edge `LATENCY` = 5: edges 1 to 4 for the
//! products, 5 for the comparisons. `r1_by_r2` comes after edge 4.
//!
//! Source: ten multipliers. The product of `a_1` and `a_2` is one of incircle, whose block gives it.

use super::dot_product::DotProduct;
use super::point_difference::PointDifference;
use super::signs::{Corners, PairFlags};
use super::widths::Point;
use crate::prelude::*;

#[derive(LogicBlock)]
pub struct CornerPairs {
    pub clock: Signal<In, Clock>,
    pub corners: Signal<In, Corners>,
    pub p: Signal<In, Point>,
    /// The dot product of `r1 - p` and `r2 - p`, in two's complement.
    pub r1_by_r2: Signal<In, Bits<36>>,
    pub flags: Signal<Out, PairFlags>,
    p_to_r0: PointDifference,
    p_to_r1: PointDifference,
    p_to_r2: PointDifference,
    square_0: DotProduct,
    square_1: DotProduct,
    square_2: DotProduct,
    r0_by_r1: DotProduct,
    r0_by_r2: DotProduct,
    compared: DFF<PairFlags>,
    distance_0: Signal<Local, Bits<34>>,
    distance_1: Signal<Local, Bits<34>>,
    distance_2: Signal<Local, Bits<34>>,
    biased_0: Signal<Local, Bits<34>>,
    biased_1: Signal<Local, Bits<34>>,
    biased_2: Signal<Local, Bits<34>>,
    biased_01: Signal<Local, Bits<34>>,
    biased_02: Signal<Local, Bits<34>>,
    biased_12: Signal<Local, Bits<34>>,
    sign: Constant<Bits<34>>,
}

impl CornerPairs {
    /// Number of clock edges from the corners to the flags.
    pub const LATENCY: usize = DotProduct::LATENCY + 1;
    /// Number of 18 x 18 bit multipliers: two each for five products.
    pub const MULTIPLIERS: usize = 2 * 5;
}

impl Default for CornerPairs {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            corners: Signal::default(),
            p: Signal::default(),
            r1_by_r2: Signal::default(),
            flags: Signal::default(),
            p_to_r0: PointDifference::default(),
            p_to_r1: PointDifference::default(),
            p_to_r2: PointDifference::default(),
            square_0: DotProduct::default(),
            square_1: DotProduct::default(),
            square_2: DotProduct::default(),
            r0_by_r1: DotProduct::default(),
            r0_by_r2: DotProduct::default(),
            compared: DFF::default(),
            distance_0: Signal::default(),
            distance_1: Signal::default(),
            distance_2: Signal::default(),
            biased_0: Signal::default(),
            biased_1: Signal::default(),
            biased_2: Signal::default(),
            biased_01: Signal::default(),
            biased_02: Signal::default(),
            biased_12: Signal::default(),
            sign: Constant::new(Bits::<34>::default().replace_bit(33, true)),
        }
    }
}

impl Logic for CornerPairs {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, square_0, square_1, square_2, r0_by_r1, r0_by_r2, compared);
        self.p_to_r0.from.next = self.p.val();
        self.p_to_r0.to.next = self.corners.val().r0;
        self.p_to_r1.from.next = self.p.val();
        self.p_to_r1.to.next = self.corners.val().r1;
        self.p_to_r2.from.next = self.p.val();
        self.p_to_r2.to.next = self.corners.val().r2;
        self.square_0.a_x.next = self.p_to_r0.x.val();
        self.square_0.a_y.next = self.p_to_r0.y.val();
        self.square_0.b_x.next = self.p_to_r0.x.val();
        self.square_0.b_y.next = self.p_to_r0.y.val();
        self.square_1.a_x.next = self.p_to_r1.x.val();
        self.square_1.a_y.next = self.p_to_r1.y.val();
        self.square_1.b_x.next = self.p_to_r1.x.val();
        self.square_1.b_y.next = self.p_to_r1.y.val();
        self.square_2.a_x.next = self.p_to_r2.x.val();
        self.square_2.a_y.next = self.p_to_r2.y.val();
        self.square_2.b_x.next = self.p_to_r2.x.val();
        self.square_2.b_y.next = self.p_to_r2.y.val();
        self.r0_by_r1.a_x.next = self.p_to_r0.x.val();
        self.r0_by_r1.a_y.next = self.p_to_r0.y.val();
        self.r0_by_r1.b_x.next = self.p_to_r1.x.val();
        self.r0_by_r1.b_y.next = self.p_to_r1.y.val();
        self.r0_by_r2.a_x.next = self.p_to_r0.x.val();
        self.r0_by_r2.a_y.next = self.p_to_r0.y.val();
        self.r0_by_r2.b_x.next = self.p_to_r2.x.val();
        self.r0_by_r2.b_y.next = self.p_to_r2.y.val();

        // Edge 5: with inverted sign bits, an unsigned comparison orders signed numbers.
        self.distance_0.next = bit_cast::<34, 36>(self.square_0.product.val());
        self.distance_1.next = bit_cast::<34, 36>(self.square_1.product.val());
        self.distance_2.next = bit_cast::<34, 36>(self.square_2.product.val());
        self.biased_0.next = self.distance_0.val() ^ self.sign.val();
        self.biased_1.next = self.distance_1.val() ^ self.sign.val();
        self.biased_2.next = self.distance_2.val() ^ self.sign.val();
        self.biased_01.next = bit_cast::<34, 36>(self.r0_by_r1.product.val()) ^ self.sign.val();
        self.biased_02.next = bit_cast::<34, 36>(self.r0_by_r2.product.val()) ^ self.sign.val();
        self.biased_12.next = bit_cast::<34, 36>(self.r1_by_r2.val()) ^ self.sign.val();
        self.compared.d.next.nearer_10 = self.distance_1.val() < self.distance_0.val();
        self.compared.d.next.nearer_20 = self.distance_2.val() < self.distance_0.val();
        self.compared.d.next.nearer_21 = self.distance_2.val() < self.distance_1.val();
        self.compared.d.next.equal_10 = self.distance_1.val() == self.distance_0.val();
        self.compared.d.next.equal_20 = self.distance_2.val() == self.distance_0.val();
        self.compared.d.next.equal_21 = self.distance_2.val() == self.distance_1.val();
        self.compared.d.next.ahead_01 = self.biased_01.val() < self.biased_0.val();
        self.compared.d.next.ahead_02 = self.biased_02.val() < self.biased_0.val();
        self.compared.d.next.ahead_10 = self.biased_01.val() < self.biased_1.val();
        self.compared.d.next.ahead_12 = self.biased_12.val() < self.biased_1.val();
        self.compared.d.next.ahead_20 = self.biased_02.val() < self.biased_2.val();
        self.compared.d.next.ahead_21 = self.biased_12.val() < self.biased_2.val();
        self.flags.next = self.compared.q.val();
    }
}
