//! The Z-curve over the square around the points.
//!
//! A position has the bits of both coordinates in turn, so no curve is cheaper to compute; from one half to the other
//! the curve jumps. Source: Morton, *A computer oriented geodetic data base*, 1966.

use incircle_geometry::order::{by_key, z_curve::position};
use incircle_geometry::Point;

use super::square::square;

/// The points along the curve over the square around them.
pub(super) fn order(points: &[Point]) -> Vec<u32> {
    let (corner, _) = square(points);
    by_key(points, |point| position(point.x - corner.x, point.y - corner.y))
}

#[cfg(test)]
mod tests {
    use crate::order::drawing::draw;
    use crate::order::Curve;

    #[test]
    fn it_looks_like_a_z() {
        assert_eq!(draw(Curve::Morton, 4), ["  5  7 13 15", "  4  6 12 14", "  1  3  9 11", "  0  2  8 10"]);
    }
}
