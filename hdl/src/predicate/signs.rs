//! What the predicates take and find out.

use super::widths::Point;
use rust_hdl_core::prelude::*;

crate::packed! {
    /// The corners of a record as stored; that of the infinite vertex is arbitrary.
    pub struct Corners {
        pub r0: Point,
        pub r1: Point,
        pub r2: Point,
    }

    /// Where the point lies from the three edges: `E_k` is the orientation of edge `k`, which lies opposite corner `k`, and the point.
    pub struct EdgeFlags {
        /// `E_k < 0`: the point lies right of edge `k`.
        pub e0_negative: bool,
        pub e1_negative: bool,
        pub e2_negative: bool,
        /// `E_k = 0`: the point lies on the line of edge `k`.
        pub e0_zero: bool,
        pub e1_zero: bool,
        pub e2_zero: bool,
        /// `E_i < E_j`, signed.
        pub e1_below_e0: bool,
        pub e2_below_e0: bool,
        pub e2_below_e1: bool,
    }

    /// The order of the point and the corners: by `x`, then by `y`.
    pub struct OrderFlags {
        /// The point comes before that corner.
        pub p_before_r0: bool,
        pub p_before_r1: bool,
        pub p_before_r2: bool,
        /// The point is that corner.
        pub p_equals_r0: bool,
        pub p_equals_r1: bool,
        pub p_equals_r2: bool,
        /// The one corner comes before the other.
        pub r0_before_r1: bool,
        pub r0_before_r2: bool,
        pub r1_before_r2: bool,
    }

    /// All that the predicates find out.
    pub struct Signs {
        pub edges: EdgeFlags,
        pub order: OrderFlags,
        /// The point lies inside the circle; on it.
        pub incircle_positive: bool,
        pub incircle_zero: bool,
    }
}
