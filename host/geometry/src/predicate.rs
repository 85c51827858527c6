//! The two predicates of Delaunay triangulations, exact for all coordinates below 2^31.
//!
//! The engine evaluates the same determinants in a form that shares work between points (`cpu/view.rs`), and the
//! validator has its own.

use crate::point::Point;

/// The vector from one point to another.
const fn vector(from: Point, to: Point) -> [i64; 2] {
    [to.x as i64 - from.x as i64, to.y as i64 - from.y as i64]
}

/// Twice the signed area of the triangle, in squares of the grid: positive if `a`, `b`, `c` turn counter-clockwise,
/// zero if they lie on one line.
///
/// Exact for coordinates below 2^31: differences stay below 2^31 in magnitude, each product below 2^62, their
/// difference below 2^63.
///
/// ```
/// use incircle_geometry::{orient2d, Point};
/// assert_eq!(orient2d(Point::new(0, 0), Point::new(4, 0), Point::new(0, 3)), 12);
/// ```
#[inline]
pub const fn orient2d(a: Point, b: Point, c: Point) -> i64 {
    let ([bx, by], [cx, cy]) = (vector(a, b), vector(a, c));
    bx * cy - by * cx
}

/// Positive if `d` lies inside the circle through the counter-clockwise triangle `a`, `b`, `c`, zero if on the circle,
/// negative if outside. The sign is the other way round for a clockwise triangle. This is the plain determinant,
/// without the tie rule of the canonical mesh.
///
/// Exact for coordinates below 2^31: the determinant is a difference of two products of a doubled area (below 2^63) and
/// a scalar product (at most 2^63), both of vectors in one square of the grid; it is at most 2^123 (`cpu/view.rs`).
///
/// ```
/// use incircle_geometry::{incircle, Point};
/// let [a, b, c] = [(0, 0), (4, 0), (4, 4)].map(|(x, y)| Point::new(x, y));
/// assert!(incircle(a, b, c, Point::new(1, 3)) > 0);
/// assert_eq!(incircle(a, b, c, Point::new(0, 4)), 0);
/// ```
#[inline]
pub const fn incircle(a: Point, b: Point, c: Point, d: Point) -> i128 {
    let (ca, cb, da, db) = (vector(c, a), vector(c, b), vector(d, a), vector(d, b));
    dot(ca, cb) as i128 * cross(da, db) as i128 - dot(da, db) as i128 * cross(ca, cb) as i128
}

const fn dot(one: [i64; 2], other: [i64; 2]) -> i64 {
    one[0] * other[0] + one[1] * other[1]
}

const fn cross(one: [i64; 2], other: [i64; 2]) -> i64 {
    one[0] * other[1] - one[1] * other[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    const MAX: u32 = (1 << 31) - 1;

    #[test]
    fn orient2d_holds_the_widest_coordinates() {
        let corner = orient2d(Point::new(0, 0), Point::new(MAX, 0), Point::new(MAX, MAX));
        assert_eq!(corner, i64::from(MAX) * i64::from(MAX));
        let back = orient2d(Point::new(MAX, 0), Point::new(0, 0), Point::new(0, MAX));
        assert_eq!(back, -i64::from(MAX) * i64::from(MAX));
    }

    #[test]
    fn incircle_holds_the_widest_coordinates() {
        let [a, b, c] = [(0, 0), (MAX, 0), (MAX, MAX)].map(|(x, y)| Point::new(x, y));
        assert_eq!(incircle(a, b, c, Point::new(0, MAX)), 0);
        assert!(incircle(a, b, c, Point::new(0, MAX - 1)) > 0);
        assert!(incircle(a, b, Point::new(MAX, MAX - 1), Point::new(0, MAX)) < 0);
    }

    /// The 3x3 determinant of the corners seen from `d` and lifted onto a paraboloid.
    fn lifted(corners: [Point; 3], d: Point) -> i128 {
        let [a, b, c] = corners.map(|p| [i128::from(p.x) - i128::from(d.x), i128::from(p.y) - i128::from(d.y)]);
        let minor = |u: [i128; 2], v: [i128; 2]| u[0] * v[1] - u[1] * v[0];
        let lift = |v: [i128; 2]| v[0] * v[0] + v[1] * v[1];
        lift(a) * minor(b, c) + lift(b) * minor(c, a) + lift(c) * minor(a, b)
    }

    #[test]
    fn incircle_is_the_lifted_determinant() {
        let mut random = SplitMix64::new(5);
        for side in [3, 1 << 16, 1 << 31] {
            for _ in 0..2000 {
                let [a, b, c, d] = [(); 4].map(|()| Point::new(random.below_u32(side), random.below_u32(side)));
                assert_eq!(incircle(a, b, c, d), lifted([a, b, c], d), "{a} {b} {c} {d}");
            }
        }
    }
}
