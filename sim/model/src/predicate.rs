//! Exact predicates on grid points, in the form the core evaluates them.
//!
//! Coordinates have up to 31 bits, so differences fit 32 bits signed, `orient2d` and dot products 64, and the
//! incircle polynomial 128: nothing is ever rounded.

/// A grid point. The derived order is lexicographic: x, then y.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Point {
    /// Abscissa, below 2^31.
    pub x: u32,
    /// Ordinate, below 2^31.
    pub y: u32,
}

/// `q - p`, exact.
#[inline]
fn difference(q: Point, p: Point) -> (i64, i64) {
    (i64::from(q.x) - i64::from(p.x), i64::from(q.y) - i64::from(p.y))
}

/// The z component of `a x b`. For 31-bit coordinates below `2 * (2^31 - 1)^2 < 2^63` in magnitude.
#[inline]
fn cross(a: (i64, i64), b: (i64, i64)) -> i64 {
    a.0 * b.1 - a.1 * b.0
}

/// The inner product of `a` and `b`; same bound as [`cross`].
#[inline]
fn dot(a: (i64, i64), b: (i64, i64)) -> i64 {
    a.0 * b.0 + a.1 * b.1
}

/// Twice the signed area of the triangle `abc`: positive if it is counter-clockwise, zero if collinear.
#[inline]
pub fn orient2d(a: Point, b: Point, c: Point) -> i64 {
    cross(difference(a, c), difference(b, c))
}

/// The incircle polynomial of the triangle `r` (counter-clockwise) and `p`: positive if `p` lies inside the
/// circumcircle, zero if on it.
///
/// Cline and Renka's form: with `d = r[0]`, `E_0 * D_d - A * D_p`, where `E_0 = orient2d(r[1], r[2], p)`,
/// `A = orient2d(r[1], r[2], d)`, and `D_q` is the dot product of `r[1] - q` and `r[2] - q`.
/// It agrees with the lifted determinant wherever `p` and `d` lie on opposite sides of the edge `r[1] r[2]`.
#[inline]
pub fn incircle(r: [Point; 3], p: Point) -> i128 {
    let (a, b) = (difference(r[1], r[0]), difference(r[2], r[0]));
    let (u, v) = (difference(r[1], p), difference(r[2], p));
    i128::from(cross(u, v)) * i128::from(dot(a, b)) - i128::from(cross(a, b)) * i128::from(dot(u, v))
}

/// Whether inserting `p` removes the finite triangle `r`, whose edge `r[1] r[2]` faces `p`.
///
/// Inside the circumcircle it does. On the circle the canonical tie rule decides: the diagonal takes the
/// lexicographically smallest of the four points, so `r` goes iff that is `p` or the apex `r[0]`.
#[inline]
pub fn finite_conflict(r: [Point; 3], p: Point) -> bool {
    match incircle(r, p) {
        0 => p.min(r[0]) < r[1].min(r[2]),
        value => value > 0,
    }
}

/// Whether inserting `p` removes the ghost triangle behind the hull edge, seen from outside as `a` to `b`.
///
/// It does iff `p` lies strictly outside, or on the line strictly between `a` and `b`.
#[inline]
pub fn ghost_conflict(a: Point, b: Point, p: Point) -> bool {
    match orient2d(a, b, p) {
        0 => (p < a) != (p < b),
        value => value > 0,
    }
}
