//! All predicates that one visit of a record needs; a new visit may come at every clock.
//!
//! 1. Inputs come straight from registers. The block takes new ones at every edge; there is no reset.
//! 2. `E_k = orient2d(r[k+1], r[k+2], p)`, indices modulo 3: edge `k` is opposite vertex `k`.
//! 3. `I = E_0 * dot(r1 - r0, r2 - r0) - orient2d(r0, r1, r2) * dot(r1 - p, r2 - p)`. For `r0`, `r1`, `r2`
//!    counter-clockwise, `I > 0` if and only if `p` lies strictly inside their circle. If they are
//!    clockwise, the sign changes.
//! 4. Every flag is exact for all inputs, also for equal and collinear points.
//!
//! Latency: inputs that are valid before edge 1 give all flags after edge 10: edges 1 to 3 for the small products, 4
//! for their sums, 5 to 7 for the large products, 8 and 9 for their sums, 10 for the comparison of the two. No edge
//! takes more than one addition or comparison, and a register separates every adder from the multipliers around it.
//!
//! Source: the Cline-Renka form of incircle (A. K. Cline, R. J. Renka, 1984). 20 multipliers: 12 for the small
//! products, 8 for the large ones. A core with questions has ten more, in [`CornerPairs`].

use super::apex_side::ApexSide;
use super::corner_pairs::CornerPairs;
use super::cross_product::CrossProduct;
use super::dot_product::DotProduct;
use super::edge_signs::EdgeSigns;
use super::point_difference::PointDifference;
use super::side_delay::SideDelay;
use super::signs::{Corners, PairFlags, Sides, Signs};
use super::vertex_order::VertexOrder;
use super::wide_product::WideProduct;
use super::widths::Point;
use crate::prelude::*;

#[derive(LogicBlock)]
pub struct VisitPredicates {
    pub clock: Signal<In, Clock>,
    pub corners: Signal<In, Corners>,
    pub p: Signal<In, Point>,
    pub signs: Signal<Out, Signs>,
    /// Signs and values of the three orient2d: in a core that answers questions.
    pub sides: Vec<Signal<Out, Sides>>,
    /// In such a core as well: the comparisons of the corners, 5 clocks after them.
    pub pairs: Vec<Signal<Out, PairFlags>>,
    /// And whether the corners turn left.
    pub turns_left: Vec<Signal<Out, Bit>>,
    p_to_r0: PointDifference,
    p_to_r1: PointDifference,
    p_to_r2: PointDifference,
    r0_to_r1: PointDifference,
    r0_to_r2: PointDifference,
    cross_0: CrossProduct,
    cross_1: CrossProduct,
    cross_2: CrossProduct,
    cross_apex: CrossProduct,
    dot_apex: DotProduct,
    dot_point: DotProduct,
    edges: EdgeSigns,
    side_delay: Vec<SideDelay>,
    corner_pairs: Vec<CornerPairs>,
    apex_side: Vec<ApexSide>,
    order: VertexOrder,
    point_by_apex: WideProduct,
    apex_by_point: WideProduct,
    biased_first: Signal<Local, Bits<68>>,
    biased_second: Signal<Local, Bits<68>>,
    positive: DFF<Bit>,
    zero: DFF<Bit>,
    sign: Constant<Bits<68>>,
}

impl VisitPredicates {
    /// Number of clock edges from inputs to flags: the small products, the large ones, and their comparison.
    pub const LATENCY: usize = CrossProduct::LATENCY + WideProduct::LATENCY + 1;
    /// Number of 18 x 18 bit multipliers: two each for four cross and two dot products, four each
    /// for two wide products.
    pub const MULTIPLIERS: usize = 2 * (4 + 2) + 4 * 2;

    /// The predicates of a core that answers questions.
    pub fn with_sides() -> Self {
        Self {
            sides: vec![Signal::default()],
            pairs: vec![Signal::default()],
            turns_left: vec![Signal::default()],
            apex_side: vec![ApexSide::new(Self::LATENCY - CrossProduct::LATENCY)],
            corner_pairs: vec![CornerPairs::default()],
            side_delay: vec![SideDelay::new(Self::LATENCY - CrossProduct::LATENCY)],
            ..Self::default()
        }
    }
}

impl Default for VisitPredicates {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            corners: Signal::default(),
            p: Signal::default(),
            signs: Signal::default(),
            sides: Vec::new(),
            pairs: Vec::new(),
            turns_left: Vec::new(),
            apex_side: Vec::new(),
            p_to_r0: PointDifference::default(),
            p_to_r1: PointDifference::default(),
            p_to_r2: PointDifference::default(),
            r0_to_r1: PointDifference::default(),
            r0_to_r2: PointDifference::default(),
            cross_0: CrossProduct::default(),
            cross_1: CrossProduct::default(),
            cross_2: CrossProduct::default(),
            cross_apex: CrossProduct::default(),
            dot_apex: DotProduct::default(),
            dot_point: DotProduct::default(),
            edges: EdgeSigns::new(Self::LATENCY - CrossProduct::LATENCY),
            side_delay: Vec::new(),
            corner_pairs: Vec::new(),
            order: VertexOrder::new(Self::LATENCY),
            point_by_apex: WideProduct::default(),
            apex_by_point: WideProduct::default(),
            biased_first: Signal::default(),
            biased_second: Signal::default(),
            positive: DFF::default(),
            zero: DFF::default(),
            sign: Constant::new(Bits::<68>::default().replace_bit(67, true)),
        }
    }
}

impl Logic for VisitPredicates {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, cross_0, cross_1, cross_2, cross_apex, dot_apex, dot_point);
        clock!(self, clock, edges, order, point_by_apex, apex_by_point, positive, zero);

        self.p_to_r0.from.next = self.p.val();
        self.p_to_r0.to.next = self.corners.val().r0;
        self.p_to_r1.from.next = self.p.val();
        self.p_to_r1.to.next = self.corners.val().r1;
        self.p_to_r2.from.next = self.p.val();
        self.p_to_r2.to.next = self.corners.val().r2;
        self.r0_to_r1.from.next = self.corners.val().r0;
        self.r0_to_r1.to.next = self.corners.val().r1;
        self.r0_to_r2.from.next = self.corners.val().r0;
        self.r0_to_r2.to.next = self.corners.val().r2;

        // `cross_0` is orient2d and a factor of incircle as well, so incircle needs one cross product of its own.
        self.cross_0.a_x.next = self.p_to_r1.x.val();
        self.cross_0.a_y.next = self.p_to_r1.y.val();
        self.cross_0.b_x.next = self.p_to_r2.x.val();
        self.cross_0.b_y.next = self.p_to_r2.y.val();
        self.cross_1.a_x.next = self.p_to_r2.x.val();
        self.cross_1.a_y.next = self.p_to_r2.y.val();
        self.cross_1.b_x.next = self.p_to_r0.x.val();
        self.cross_1.b_y.next = self.p_to_r0.y.val();
        self.cross_2.a_x.next = self.p_to_r0.x.val();
        self.cross_2.a_y.next = self.p_to_r0.y.val();
        self.cross_2.b_x.next = self.p_to_r1.x.val();
        self.cross_2.b_y.next = self.p_to_r1.y.val();
        self.cross_apex.a_x.next = self.r0_to_r1.x.val();
        self.cross_apex.a_y.next = self.r0_to_r1.y.val();
        self.cross_apex.b_x.next = self.r0_to_r2.x.val();
        self.cross_apex.b_y.next = self.r0_to_r2.y.val();
        self.dot_apex.a_x.next = self.r0_to_r1.x.val();
        self.dot_apex.a_y.next = self.r0_to_r1.y.val();
        self.dot_apex.b_x.next = self.r0_to_r2.x.val();
        self.dot_apex.b_y.next = self.r0_to_r2.y.val();
        self.dot_point.a_x.next = self.p_to_r1.x.val();
        self.dot_point.a_y.next = self.p_to_r1.y.val();
        self.dot_point.b_x.next = self.p_to_r2.x.val();
        self.dot_point.b_y.next = self.p_to_r2.y.val();

        // The signs of the edges are ready long before incircle; `EdgeSigns` delays them so that all flags of
        // a visit come together.
        self.edges.e0.next = self.cross_0.product.val();
        self.edges.e1.next = self.cross_1.product.val();
        self.edges.e2.next = self.cross_2.product.val();
        for i in 0..self.sides.len() {
            self.side_delay[i].clock.next = self.clock.val();
            self.side_delay[i].e0.next = self.cross_0.product.val();
            self.side_delay[i].e1.next = self.cross_1.product.val();
            self.side_delay[i].e2.next = self.cross_2.product.val();
            self.side_delay[i].flags.next = self.edges.flags.val();
            self.sides[i].next = self.side_delay[i].sides.val();
            self.corner_pairs[i].clock.next = self.clock.val();
            self.corner_pairs[i].corners.next = self.corners.val();
            self.corner_pairs[i].p.next = self.p.val();
            self.corner_pairs[i].r1_by_r2.next = self.dot_point.product.val();
            self.pairs[i].next = self.corner_pairs[i].flags.val();
            self.apex_side[i].clock.next = self.clock.val();
            self.apex_side[i].product.next = self.cross_apex.product.val();
            self.turns_left[i].next = self.apex_side[i].is_left.val();
        }
        self.point_by_apex.a.next = self.cross_0.product.val();
        self.point_by_apex.b.next = self.dot_apex.product.val();
        self.apex_by_point.a.next = self.cross_apex.product.val();
        self.apex_by_point.b.next = self.dot_point.product.val();

        // Edge 10: comparing the two products is one step, where the sign of their difference would be two. With
        // inverted sign bits, an unsigned comparison orders signed numbers.
        self.biased_first.next = self.point_by_apex.product.val() ^ self.sign.val();
        self.biased_second.next = self.apex_by_point.product.val() ^ self.sign.val();
        self.positive.d.next = self.biased_second.val() < self.biased_first.val();
        self.zero.d.next = self.point_by_apex.product.val() == self.apex_by_point.product.val();
        self.signs.next.incircle_positive = self.positive.q.val();
        self.signs.next.incircle_zero = self.zero.q.val();

        self.order.corners.next = self.corners.val();
        self.order.p.next = self.p.val();
        self.signs.next.edges = self.edges.flags.val();
        self.signs.next.order = self.order.flags.val();
    }
}
