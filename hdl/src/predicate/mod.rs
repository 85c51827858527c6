//! The exact predicates of one visit: three orientations, one incircle, and the order of the vertices.
//!
//! All is integer arithmetic in two's complement, wide enough that nothing ever wraps; signs decide, there is no epsilon. Coordinates are
//! unsigned; a difference of two is widened first, so no value is ever cut.
//!
//! ```text
//! r0 r1 r2 p -> PointDifference x5 -> CrossProduct x4, DotProduct x2 -> EdgeSigns           -> e*_...
//!            |                                                       -> WideProduct x2, sign -> incircle_...
//!            -> VertexOrder ----------------------------------------------------------------> p_..., r0_...
//! ```

mod cross_product;
mod dot_product;
mod edge_signs;
mod point_difference;
mod vertex_order;
mod visit_predicates;
mod wide_product;

pub use cross_product::CrossProduct;
pub use dot_product::DotProduct;
pub use edge_signs::EdgeSigns;
pub use point_difference::PointDifference;
pub use vertex_order::VertexOrder;
pub use visit_predicates::VisitPredicates;
pub use wide_product::WideProduct;

/// Bits of a coordinate, unsigned.
pub const COORD_BITS: usize = 16;
/// Bits of a point: `x` in the low half, `y` in the high half.
pub const POINT_BITS: usize = 2 * COORD_BITS;
/// Bits of a difference of two coordinates, signed: between `-(2^16 - 1)` and `2^16 - 1`. The multiplier takes 18.
pub const DIFFERENCE_BITS: usize = COORD_BITS + 1;
/// Bits of an orientation, signed. Twice the area of a triangle in a box is at most the area of the box, `(2^16 - 1)^2 < 2^32`.
pub const CROSS_BITS: usize = 2 * COORD_BITS + 1;
/// Bits of a dot product of two differences, signed: at most `2 * (2^16 - 1)^2 < 2^33`.
pub const DOT_BITS: usize = 2 * COORD_BITS + 2;
/// Bits of incircle, signed: two products below `2^32 * 2^33 = 2^65` each, so their difference is below `2^66`.
pub const INCIRCLE_BITS: usize = 4 * COORD_BITS + 3;
