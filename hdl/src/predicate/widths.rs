//! The widths of the values that the predicates compute with, each derived from the width of a coordinate.

use rust_hdl_core::prelude::Bits;

/// Number of bits of a coordinate, unsigned.
pub const COORD_BITS: usize = 16;
/// Number of bits of a point.
pub const POINT_BITS: usize = 2 * COORD_BITS;
/// A point: `x` in the low half, `y` in the high half.
pub type Point = Bits<POINT_BITS>;
/// Number of bits of a difference of two coordinates, signed: between `-(2^16 - 1)` and `2^16 - 1`.
/// The multiplier takes 18.
pub const DIFFERENCE_BITS: usize = COORD_BITS + 1;
/// Number of bits of orient2d, signed. Twice the area of a triangle in a box is at most the area of the box, `(2^16
/// - 1)^2 < 2^32`.
pub const CROSS_BITS: usize = 2 * COORD_BITS + 1;
/// Number of bits of a dot product of two differences, signed: at most `2 * (2^16 - 1)^2 < 2^33`.
pub const DOT_BITS: usize = 2 * COORD_BITS + 2;
/// Number of bits of incircle, signed: two products below `2^32 * 2^33 = 2^65` each, so their
/// difference is below `2^66`.
pub const INCIRCLE_BITS: usize = 4 * COORD_BITS + 3;
