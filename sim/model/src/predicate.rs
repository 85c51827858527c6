//! Exact predicates on grid points, in the form in which the core evaluates them (`hdl/src/predicate/`).
//!
//! Coordinates have up to 31 bits. Differences therefore fit into 32 bits with sign, `orient2d` and dot products into
//! 64, and the incircle polynomial into 128: nothing is ever rounded.

/// A point on the grid. The derived order is lexicographic: x first, then y.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Point {
    /// The abscissa, below 2^31.
    pub x: u32,
    /// The ordinate, below 2^31.
    pub y: u32,
}

/// The exact vector from `p` to `q`.
#[inline]
fn difference(q: Point, p: Point) -> (i64, i64) {
    (i64::from(q.x) - i64::from(p.x), i64::from(q.y) - i64::from(p.y))
}

/// The z component of `a x b`. With coordinates of 31 bits its magnitude is at most `2 * (2^31 - 1)^2 < 2^63`.
#[inline]
fn cross(a: (i64, i64), b: (i64, i64)) -> i64 {
    a.0 * b.1 - a.1 * b.0
}

/// The inner product of `a` and `b`, with the bound of [`cross`].
#[inline]
fn inner(a: (i64, i64), b: (i64, i64)) -> i64 {
    a.0 * b.0 + a.1 * b.1
}

/// Twice the signed area of the triangle `abc`: positive if the points turn left, zero if they are collinear.
#[inline]
pub fn orient2d(a: Point, b: Point, c: Point) -> i64 {
    cross(difference(a, c), difference(b, c))
}

/// The inner product of the vectors from `v` to `a` and to `b`: negative if they make an angle of more than 90 degrees.
#[inline]
pub fn dot(v: Point, a: Point, b: Point) -> i64 {
    inner(difference(a, v), difference(b, v))
}

/// The incircle polynomial of the counter-clockwise triangle `r` and of `p`: positive if `p` lies inside the
/// circumcircle, zero if `p` lies on it.
///
/// The form is that of Cline and Renka: with `d = r[0]`, the value is `E_0 * D_d - A * D_p`, where `E_0 =
/// orient2d(r[1], r[2], p)`, `A = orient2d(r[1], r[2], d)`, and `D_q` is the dot product of `r[1] - q` and `r[2] - q`.
/// The value equals the lifted determinant of the four points for every `p`, wherever `p` lies.
#[inline]
pub fn incircle(r: [Point; 3], p: Point) -> i128 {
    let (a, b) = (difference(r[1], r[0]), difference(r[2], r[0]));
    let (u, v) = (difference(r[1], p), difference(r[2], p));
    i128::from(cross(u, v)) * i128::from(inner(a, b)) - i128::from(cross(a, b)) * i128::from(inner(u, v))
}

/// Whether `p`, which is no vertex of the finite triangle `r`, conflicts with it.
///
/// A point inside the circumcircle conflicts. On the circle the tie rule decides. Such a point lies beyond exactly one
/// side of the triangle, and the diagonal ends in the lexicographically smallest of the four points. So `r` conflicts
/// iff the smallest is `p` or the vertex opposite that side.
#[inline]
pub fn finite_conflict(r: [Point; 3], p: Point) -> bool {
    match incircle(r, p) {
        0 => takes_tie(r, facing_slot(r, p), p),
        value => value > 0,
    }
}

/// The slot opposite the side of `r` beyond which `p` lies, a point on the circumcircle and no vertex.
fn facing_slot(r: [Point; 3], p: Point) -> usize {
    match () {
        () if orient2d(r[2], r[0], p) < 0 => 1,
        () if orient2d(r[0], r[1], p) < 0 => 2,
        () => 0,
    }
}

/// Whether the tie rule lets `r` conflict with `p`, a point on the circumcircle beyond the side opposite `slot`.
#[inline]
pub(crate) fn takes_tie(r: [Point; 3], slot: usize, p: Point) -> bool {
    p.min(r[slot]) < r[(slot + 1) % 3].min(r[(slot + 2) % 3])
}

/// Whether `p` conflicts with the ghost triangle of a hull edge that runs from `a` to `b` as seen from outside.
///
/// There is a conflict if and only if `p` lies strictly outside the edge, or on its line strictly between `a` and `b`.
#[inline]
pub fn ghost_conflict(a: Point, b: Point, p: Point) -> bool {
    match orient2d(a, b, p) {
        0 => (p < a) != (p < b) && p != a && p != b,
        value => value > 0,
    }
}
