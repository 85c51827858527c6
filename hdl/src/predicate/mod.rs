//! The exact predicates of one visit: three orient2d, one incircle, and the order of the vertices. [`VisitPredicates`]
//! states the formula of incircle (its rule 3), and [`WideProduct`] multiplies its two halves.
//!
//! All values are integers in two's complement, wide enough that nothing ever wraps. Signs decide; there is no epsilon.
//! Coordinates are unsigned, and every difference is widened before it is taken, so no value is ever cut.
//!
//! ```text
//! r0 r1 r2 p -> PointDifference x5 -> CrossProduct x4, DotProduct x2 -> EdgeSigns           -> e*_...
//!            |                                                       -> WideProduct x2, sign -> incircle_...
//!            -> VertexOrder ----------------------------------------------------------------> p_..., r0_...
//! ```
//! In a core that answers questions, `SideDelay` also gives the values of the three orient2d, and `CornerPairs`
//! compares the distances of the corners.

mod apex_side;
mod corner_pairs;
mod cross_product;
mod dot_product;
mod edge_signs;
mod point_difference;
mod side_delay;
mod signs;
mod vertex_order;
mod visit_predicates;
mod wide_product;
mod widths;

pub use apex_side::ApexSide;
pub use corner_pairs::CornerPairs;
pub use cross_product::CrossProduct;
pub use dot_product::DotProduct;
pub use edge_signs::EdgeSigns;
pub use point_difference::PointDifference;
pub use side_delay::SideDelay;
pub use signs::{
    Corners, EdgeFlags, InfiniteCorners, NearSigns, OrderFlags, PairFlags, Sides, Signs, Weights, WEIGHTS_BITS,
};
pub use vertex_order::VertexOrder;
pub use visit_predicates::VisitPredicates;
pub use wide_product::WideProduct;
pub use widths::*;
