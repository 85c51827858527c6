//! The points that go into the predicates, and the flags that come out.

use super::widths::Point;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// The coordinates of a record's vertices, in stored order; those of the infinite vertex are arbitrary.
    pub struct Corners {
        pub r0: Point,
        pub r1: Point,
        pub r2: Point,
    }

    /// The position of the point relative to the three edges. `E_k` is orient2d of edge `k` and the point; edge `k`
    /// lies opposite corner `k`.
    pub struct EdgeFlags {
        /// `E_k < 0`: the point lies right of edge `k`.
        pub e0_negative: bool,
        pub e1_negative: bool,
        pub e2_negative: bool,
        /// `E_k = 0`: the point lies on the line of edge `k`.
        pub e0_zero: bool,
        pub e1_zero: bool,
        pub e2_zero: bool,
        /// `E_i < E_j`, as signed numbers.
        pub e1_below_e0: bool,
        pub e2_below_e0: bool,
        pub e2_below_e1: bool,
    }

    /// For each edge twice the area of the triangle that it makes with the point: the low bits of `E_k`, which are its
    /// value if `E_k` is not negative. The high bits are 0 then, because `E_k` is below 2^32.
    pub struct Weights {
        pub w0: Bits<32>,
        pub w1: Bits<32>,
        pub w2: Bits<32>,
    }

    /// The position of the point relative to the three edges, with the weights of the opposite corners.
    pub struct Sides {
        pub flags: EdgeFlags,
        pub weights: Weights,
    }

    /// The comparisons of the vectors from the point to the corners, by which the nearest corner and its spokes are
    /// found. The spoke from one corner to another is *ahead* if it makes an angle of less than 90 degrees with the
    /// direction to the point.
    pub struct PairFlags {
        /// Corner 1 is nearer to the point than corner 0, and so on.
        pub nearer_10: bool,
        pub nearer_20: bool,
        pub nearer_21: bool,
        /// Both corners have the same distance to the point.
        pub equal_10: bool,
        pub equal_20: bool,
        pub equal_21: bool,
        /// The spoke from corner 0 to corner 1 is ahead, and so on.
        pub ahead_01: bool,
        pub ahead_02: bool,
        pub ahead_10: bool,
        pub ahead_12: bool,
        pub ahead_20: bool,
        pub ahead_21: bool,
    }

    /// The corners of a record as stored that are the infinite vertex, one at most.
    pub struct InfiniteCorners {
        pub c0: bool,
        pub c1: bool,
        pub c2: bool,
    }

    /// The corner nearest to the point, and its spokes: the edges to the next corner and to the corner before,
    /// counter-clockwise.
    pub struct NearSigns {
        /// The stored slot of the corner.
        pub slot: Bits<2>,
        /// The spoke is ahead; arbitrary if its end is infinite.
        pub next_is_ahead: bool,
        pub before_is_ahead: bool,
        /// The end of the spoke is the infinite vertex.
        pub next_is_infinite: bool,
        pub before_is_infinite: bool,
    }

    /// The lexicographic order of the point and the corners: by `x`, then by `y`.
    pub struct OrderFlags {
        /// The point comes before the corner.
        pub p_before_r0: bool,
        pub p_before_r1: bool,
        pub p_before_r2: bool,
        /// The point has the coordinates of the corner.
        pub p_equals_r0: bool,
        pub p_equals_r1: bool,
        pub p_equals_r2: bool,
        /// The first corner comes before the second.
        pub r0_before_r1: bool,
        pub r0_before_r2: bool,
        pub r1_before_r2: bool,
    }

    /// All results of the predicates.
    pub struct Signs {
        pub edges: EdgeFlags,
        pub order: OrderFlags,
        /// The point lies inside the circle (`incircle_positive`) or on the circle
        /// (`incircle_zero`) of counter-clockwise corners.
        pub incircle_positive: bool,
        pub incircle_zero: bool,
    }
}

/// Number of bits of [`Weights`].
pub const WEIGHTS_BITS: usize = Weights::BITS;
