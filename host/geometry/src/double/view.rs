//! An edge seen from a point, in floating-point arithmetic. Both filters decide by such views.

use core::cmp::Ordering;

use super::coordinate::Coordinate;

/// The unit of rounding of a double.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;

/// The edge from `a` to `b`, seen from a point: the rounded cross and dot products of the vectors from the point to
/// both ends. `cpu/view.rs` shows how the two decide orient2d and incircle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(super) cross: f64,
    pub(super) dot: f64,
}

impl View {
    /// The edge from `a` to `b`, seen from `p`.
    #[inline(always)]
    pub(crate) fn of<C: Coordinate>(a: [C; 2], b: [C; 2], p: [C; 2]) -> Self {
        let (ax, ay, bx, by) = (a[0].minus(p[0]), a[1].minus(p[1]), b[0].minus(p[0]), b[1].minus(p[1]));
        Self { cross: ax * by - ay * bx, dot: ax * bx + ay * by }
    }

    /// The rounded determinant of incircle, given the views from both points.
    #[inline(always)]
    pub(super) fn determinant(self, other: Self) -> f64 {
        self.dot * other.cross - other.dot * self.cross
    }
}

/// The sign of a number other than zero.
#[inline(always)]
pub(super) fn sign(value: f64) -> Ordering {
    if value > 0.0 {
        Ordering::Greater
    } else {
        Ordering::Less
    }
}
