//! Exact signs in 128-bit integers, for coordinates below 2^31.

use core::cmp::Ordering;

use crate::point::Point;

/// The limit below which coordinates must stay.
pub(super) const COORDINATE_LIMIT: u32 = 1 << 31;

/// The vector from `from` to `to`.
fn vector(from: Point, to: Point) -> [i128; 2] {
    [i128::from(to.x) - i128::from(from.x), i128::from(to.y) - i128::from(from.y)]
}

fn minor(one: [i128; 2], other: [i128; 2]) -> i128 {
    one[0] * other[1] - one[1] * other[0]
}

/// Twice the signed area of a triangle: positive if `a`, `b`, `c` turn left.
pub(super) fn orient2d(a: Point, b: Point, c: Point) -> i128 {
    minor(vector(a, b), vector(a, c))
}

/// Whether `d` is inside (`Greater`), on (`Equal`) or outside (`Less`) the circle of the counter-clockwise triangle.
///
/// The sign is that of the 3x3 determinant of the corners seen from `d` and lifted onto a paraboloid. Differences are
/// below 2^31, lifts and minors below 2^63, so each of the three products is below 2^126 and the sum of two below
/// 2^127. The determinant itself is at most 2^126: it equals a difference of two products, each of an `orient2d` in the
/// square of the grid (at most 2^62) and a scalar product (at most 2^63).
pub(super) fn incircle(a: Point, b: Point, c: Point, d: Point) -> Ordering {
    let [a, b, c] = [a, b, c].map(|corner| vector(d, corner));
    let lift = |v: [i128; 2]| v[0] * v[0] + v[1] * v[1];
    let determinant = lift(a) * minor(b, c) + lift(b) * minor(c, a) + lift(c) * minor(a, b);
    determinant.cmp(&0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAX: u32 = COORDINATE_LIMIT - 1;

    fn p(x: u32, y: u32) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn a_square_is_cocircular_at_full_width() {
        let (a, b, c, d) = (p(0, 0), p(MAX, 0), p(MAX, MAX), p(0, MAX));
        assert_eq!(incircle(a, b, c, d), Ordering::Equal);
        assert_eq!(incircle(a, b, c, p(0, MAX - 1)), Ordering::Greater);
        assert_eq!(incircle(a, b, p(MAX, MAX - 1), d), Ordering::Less);
    }

    #[test]
    fn area_is_positive_to_the_left() {
        assert_eq!(orient2d(p(0, 0), p(MAX, 0), p(0, MAX)), i128::from(MAX) * i128::from(MAX));
        assert_eq!(orient2d(p(0, 0), p(5, 5), p(9, 9)), 0);
        assert_eq!(orient2d(p(0, 0), p(0, 2), p(2, 0)), -4);
    }

    #[test]
    fn one_grid_step_decides() {
        let (a, b, c) = (p(10, 0), p(20, 10), p(10, 20));
        assert_eq!(incircle(a, b, c, p(0, 10)), Ordering::Equal);
        assert_eq!(incircle(a, b, c, p(1, 10)), Ordering::Greater);
        assert_eq!(incircle(a, b, c, p(0, 9)), Ordering::Less);
    }
}
