//! The centroid of a cell whose corners are integers.

use super::quotient::floor_quotient;
use crate::point::Point;

/// Bits behind the point of a corner.
pub(super) const BITS: u32 = 8;
/// Polygons whose corners lie this near to the point have twice an area below 2^63.
const NEAR: i64 = 1 << 30;

/// Twice the area and six times the moments of polygons around a point, from corners as seen from it, in 2^-8 of a step.
/// Inside the grid these have 40 bits, so the sums have at most 80 and 122.
pub(super) struct Sums {
    area: i128,
    moments: [i128; 2],
    pub(super) low: [i64; 2],
    pub(super) high: [i64; 2],
}

impl Sums {
    pub(super) fn new() -> Self {
        Self { area: 0, moments: [0; 2], low: [i64::MAX; 2], high: [i64::MIN; 2] }
    }

    /// Adds a polygon, counter-clockwise.
    pub(super) fn add(&mut self, ring: &[[i64; 2]]) {
        for corner in ring {
            self.low = core::array::from_fn(|axis| self.low[axis].min(corner[axis]));
            self.high = core::array::from_fn(|axis| self.high[axis].max(corner[axis]));
        }
        let is_near = self.low.iter().all(|&value| value > -NEAR) && self.high.iter().all(|&value| value < NEAR);
        let Some(mut from) = ring.last().copied() else { return };
        for &to in ring {
            if is_near {
                self.add_near(from, to);
            } else {
                self.add_far(from, to);
            }
            from = to;
        }
    }

    /// Adds the triangle of the point and an edge.
    #[inline]
    fn add_near(&mut self, from: [i64; 2], to: [i64; 2]) {
        let twice = from[0] * to[1] - from[1] * to[0];
        self.area += i128::from(twice);
        for axis in 0..2 {
            self.moments[axis] += i128::from(from[axis] + to[axis]) * i128::from(twice);
        }
    }

    /// As [`add_near`](Self::add_near), for any corner. Sums of many edges may wrap; the last ones do not.
    fn add_far(&mut self, from: [i64; 2], to: [i64; 2]) {
        let [a, b, c, d] = [from[0], to[1], from[1], to[0]].map(i128::from);
        let twice = a * b - c * d;
        self.area = self.area.wrapping_add(twice);
        for axis in 0..2 {
            let sum = i128::from(from[axis]) + i128::from(to[axis]);
            self.moments[axis] = self.moments[axis].wrapping_add(sum.wrapping_mul(twice));
        }
    }

    /// The grid point nearest to the centroid, halves upwards; the point itself if there is no area.
    pub(super) fn centroid(&self, point: Point) -> Point {
        if self.area <= 0 {
            return point;
        }
        // Three times the area, in units of a grid step.
        let divisor = (3 * self.area) << BITS;
        let round = |value: i64| (value + (1 << (BITS - 1))) >> BITS;
        let moved = |value: u32, axis: usize| {
            let offset = floor_quotient(2 * self.moments[axis] + divisor, 2 * divisor);
            // The rounded corners of a cell that is thinner than a share of a step can have a centroid outside their
            // box.
            let inside = offset.clamp(round(self.low[axis]).into(), round(self.high[axis]).into());
            (i128::from(value) + inside).clamp(0, (1 << 31) - 1) as u32
        };
        Point::new(moved(point.x, 0), moved(point.y, 1))
    }
}
