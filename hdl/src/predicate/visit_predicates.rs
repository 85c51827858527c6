//! All predicates that one visit of a triangle needs, for one new visit per clock.
//!
//! 1. Inputs come straight from registers. New ones are taken at every edge; there is no reset.
//! 2. `E_k = orient2d(r[k+1], r[k+2], p)`, indices modulo 3: edge `k` is opposite vertex `k`.
//! 3. `I = E_0 * dot(r1 - r0, r2 - r0) - orient2d(r0, r1, r2) * dot(r1 - p, r2 - p)`. For `r0`, `r1`, `r2` counter-clockwise, `I > 0` if
//!    and only if `p` lies strictly inside their circle; clockwise the sign turns.
//! 4. Every flag is exact for all inputs, also for equal and collinear points.
//!
//! Latency: inputs that stand before edge 1 give all flags after edge 10. Edges 1 to 3 small products, 4 their sums, 5 to 7 large
//! products, 8 and 9 their sums, 10 the comparison of the two. No edge takes more than one addition or comparison, and no adder stands
//! between two multipliers without a register.
//!
//! Source: the Cline-Renka form of incircle (A. K. Cline, R. J. Renka, 1984). 20 multipliers: 12 for small products, 8 for large ones.

use super::cross_product::CrossProduct;
use super::dot_product::DotProduct;
use super::edge_signs::EdgeSigns;
use super::point_difference::PointDifference;
use super::signs::{Corners, Signs};
use super::vertex_order::VertexOrder;
use super::wide_product::WideProduct;
use super::widths::Point;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Predicates of a visit; see the top of this file.
#[derive(LogicBlock)]
pub struct VisitPredicates {
    pub clock: Signal<In, Clock>,
    pub corners: Signal<In, Corners>,
    pub p: Signal<In, Point>,
    pub signs: Signal<Out, Signs>,
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
    /// Edges from inputs to flags: the small products, the large ones, and their comparison.
    pub const LATENCY: usize = CrossProduct::LATENCY + WideProduct::LATENCY + 1;
    /// 18 x 18 multipliers: two each for four cross and two dot products, four each for two wide products.
    pub const MULTIPLIERS: usize = 2 * (4 + 2) + 4 * 2;
}

impl Default for VisitPredicates {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            corners: Signal::default(),
            p: Signal::default(),
            signs: Signal::default(),
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

        // Vectors between the points.
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

        // Orientations of the three edges, and of the triangle.
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

        // Edge 5: the sums go to the signs and to the wide products.
        self.edges.e0.next = self.cross_0.product.val();
        self.edges.e1.next = self.cross_1.product.val();
        self.edges.e2.next = self.cross_2.product.val();
        self.point_by_apex.a.next = self.cross_0.product.val();
        self.point_by_apex.b.next = self.dot_apex.product.val();
        self.apex_by_point.a.next = self.cross_apex.product.val();
        self.apex_by_point.b.next = self.dot_point.product.val();

        // Edge 10: the sign of their difference.
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
