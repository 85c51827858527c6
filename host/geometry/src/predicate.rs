//! The two predicates of Delaunay triangulations, exact for all coordinates below 2^31.
//!
//! The CPU triangulator evaluates the same determinants in a form that shares work between points (`cpu/view.rs`), and
//! the validator has predicates of its own (`verify/exact.rs`). The names are those of Shewchuk, *Adaptive Precision
//! Floating-Point Arithmetic and Fast Robust Geometric Predicates*, 1997.

use crate::point::Point;

/// The vector from one point to another.
const fn vector(from: Point, to: Point) -> [i64; 2] {
    [to.x as i64 - from.x as i64, to.y as i64 - from.y as i64]
}

/// Tells on which side of the line from `a` to `b` the point `c` lies.
///
/// The result is positive if `a`, `b`, `c` turn counter-clockwise (`c` lies to the left), zero if they lie on one line,
/// and negative otherwise. The value is twice the signed area of the triangle in squares of the grid, so areas of
/// polygons are sums of such values. Two multiplications; usable in constants.
///
/// Exact for coordinates below 2^31: differences stay below 2^31 in magnitude, each product below 2^62, their
/// difference below 2^63. Wider coordinates may overflow, which panics in a debug build.
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

/// Tells whether `d` lies inside the circle through `a`, `b` and `c`.
///
/// For a counter-clockwise triangle the result is positive if `d` is inside, zero if `d` is on the circle, and negative
/// if `d` is outside. A clockwise triangle has the opposite sign. The function is the plain determinant: the tie rule,
/// by which the canonical mesh decides a zero, is not part of it. Ten multiplications, two of them to 128
/// bits; usable in constants.
///
/// The determinant is evaluated as `dot(c) cross(d) - dot(d) cross(c)`, where `dot` and `cross` are the products of the
/// vectors from a point to `a` and `b` (Cline and Renka 1984). Exact for coordinates below 2^31: in magnitude `cross`,
/// which is an `orient2d`, stays below 2^62, `dot` below 2^63, and each product below 2^125. The determinant is at most
/// 2^123, because all four points lie in one square of the grid (`cpu/view.rs`). Wider coordinates may overflow.
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
