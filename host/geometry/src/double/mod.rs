//! The two predicates for points of doubles: exact signs for all finite coordinates, whatever their exponents.
//!
//! A filter in floating-point arithmetic decides nearly all cases; what it leaves open is decided by integers that hold
//! the whole determinant (`exact`). There is no epsilon: the bounds of the filter are proved, and the integers are
//! never rounded.
//!
//! **The filter's bounds.** Let `u = 2^-53`. A rounded difference, product or sum is the true one times `1 + d` with
//! `|d| <= u`, if nothing overflows or underflows. So `cross = ax by - ay bx`, worked out from rounded differences,
//! errs by at most `(4 u + O(u²)) (|ax by| + |ay bx|)`, and the dot product alike. In `dot(c) cross(d) - dot(d)
//! cross(c)` the error of each product is at most `9 u + O(u²)` times the product of the two sizes, and the last
//! subtraction adds `u` times the result. The bounds below are 6 u and 16 u, which leaves room for the rounding
//! of the sizes themselves.
//!
//! **Overflow** makes a size infinite or not a number, and no comparison with such a bound is true: the exact stage
//! decides. **Underflow** adds at most `2^-1075` to each product: where a size is at least `2^-960` that is less than
//! `2^-115` of it, and hidden in the room above; below it the exact stage decides.
//!
//! The CPU triangulator asks a cheaper filter first, with bounds that hold for a whole set of points (`bounds`).

mod big;
mod bounds;
mod coordinate;
mod cotangents;
mod exact;
mod inverse;
mod view;

use core::cmp::Ordering;

pub(crate) use bounds::Bounds;
pub(crate) use coordinate::Coordinate;
pub(crate) use cotangents::{cotangents, LEAST_SUM, MOST};
pub(crate) use inverse::{height, HEIGHT_BOUND};
pub(crate) use view::View;
use view::{sign, UNIT};

/// Error of a cross or dot product, by its size.
const PRODUCT_BOUND: f64 = 6.0 * UNIT;
/// Error of the determinant of incircle, by its size.
const DETERMINANT_BOUND: f64 = 16.0 * UNIT;
/// The smallest size of a cross or dot product for which underflow can be neglected: `2^-960`.
const LEAST_SIZE: f64 = f64::from_bits((1023 - 960) << 52);

/// A view with the sizes of its products, which bound their errors.
#[derive(Clone, Copy, Debug)]
pub struct SizedView {
    view: View,
    /// `|ax by| + |ay bx|`.
    cross_size: f64,
    /// `|ax bx| + |ay by|`.
    dot_size: f64,
}

impl SizedView {
    /// The edge from `a` to `b`, seen from `p`.
    #[inline(always)]
    pub(crate) fn of<C: Coordinate>(a: [C; 2], b: [C; 2], p: [C; 2]) -> Self {
        let (ax, ay, bx, by) = (a[0].minus(p[0]), a[1].minus(p[1]), b[0].minus(p[0]), b[1].minus(p[1]));
        let cross_size = (ax * by).abs() + (ay * bx).abs();
        let dot_size = (ax * bx).abs() + (ay * by).abs();
        Self { view: View::of(a, b, p), cross_size, dot_size }
    }

    /// The sign of the cross product, if the filter can tell.
    #[inline(always)]
    fn side(self) -> Option<Ordering> {
        let Self { view: View { cross, .. }, cross_size, .. } = self;
        (cross_size >= LEAST_SIZE && cross.abs() > PRODUCT_BOUND * cross_size).then(|| sign(cross))
    }

    /// Whether underflow can be neglected.
    #[inline(always)]
    fn is_large(self) -> bool {
        self.cross_size >= LEAST_SIZE && self.dot_size >= LEAST_SIZE
    }
}

/// The side of the edge from `a` to `b` on which `p` lies: `Greater` is left.
#[inline(always)]
pub(crate) fn orient2d_of<C: Coordinate>(a: [C; 2], b: [C; 2], p: [C; 2]) -> Ordering {
    orient2d_seen([a, b], p, SizedView::of(a, b, p))
}

/// The side of an edge on which `p` lies, given the view from there.
#[inline(always)]
pub(crate) fn orient2d_seen<C: Coordinate>([a, b]: [[C; 2]; 2], p: [C; 2], view: SizedView) -> Ordering {
    match view.side() {
        Some(side) => side,
        None => exact::orient2d(a, b, p),
    }
}

/// The sign of `incircle(a, b, c, d)`.
#[inline(always)]
pub(crate) fn incircle_of<C: Coordinate>(a: [C; 2], b: [C; 2], c: [C; 2], d: [C; 2]) -> Ordering {
    incircle_seen([a, b], [c, d], [SizedView::of(a, b, c), SizedView::of(a, b, d)])
}

/// The sign of `incircle(a, b, c, d)`, given the views of the edge from `a` to `b` from `c` and from `d`.
#[inline(always)]
pub(crate) fn incircle_seen<C: Coordinate>(
    [a, b]: [[C; 2]; 2],
    [c, d]: [[C; 2]; 2],
    [from_c, from_d]: [SizedView; 2],
) -> Ordering {
    let determinant = from_c.view.determinant(from_d.view);
    let size = from_c.dot_size * from_d.cross_size + from_d.dot_size * from_c.cross_size;
    // A product of two small sizes may underflow, too.
    if size >= LEAST_SIZE && determinant.abs() > DETERMINANT_BOUND * size && from_c.is_large() && from_d.is_large() {
        return sign(determinant);
    }
    exact::incircle(a, b, c, d)
}

/// Compares the distances from `q` to `a` and to `b`.
#[inline(always)]
pub(crate) fn nearer_of<C: Coordinate>(q: [C; 2], a: [C; 2], b: [C; 2]) -> Ordering {
    let (to_a, to_b) = (View::of(a, a, q).dot, View::of(b, b, q).dot);
    // Each square errs by 4 u of its size or less: two roundings of differences, one of each product, one of the sum.
    let (difference, size) = (to_a - to_b, to_a + to_b);
    if size >= LEAST_SIZE && difference.abs() > DETERMINANT_BOUND * size {
        return sign(difference);
    }
    exact::nearer(q, a, b)
}

/// Whether `p` lies at most `radius` from `q`. No point lies within a radius that is negative or not a number.
#[inline]
pub(crate) fn is_within_of<C: Coordinate>(q: [C; 2], p: [C; 2], radius: f64) -> bool {
    if radius.is_nan() || radius < 0.0 {
        return false;
    }
    let (to_p, square) = (View::of(p, p, q).dot, radius * radius);
    let (difference, size) = (square - to_p, square + to_p);
    if size >= LEAST_SIZE && difference.abs() > DETERMINANT_BOUND * size {
        return difference > 0.0;
    }
    radius == f64::INFINITY || exact::is_within(q, p, radius)
}

/// Returns on which side of the line from `a` to `b` the point `c` lies: `Greater` to the left, so that `a`, `b`, `c`
/// turn counter-clockwise; `Less` to the right; `Equal` on the line. Exact for all finite coordinates.
///
/// The time is constant where the filter decides, which it nearly always does. Near a line the exact stage takes some
/// ten times as long, and up to thousands of times if in addition the exponents differ by hundreds.
///
/// ```
/// use core::cmp::Ordering;
/// use incircle_geometry::double::orient2d;
/// assert_eq!(orient2d([0.0, 0.0], [0.3, 0.3], [0.1, 0.1]), Ordering::Equal);
/// assert_eq!(orient2d([0.0, 0.0], [0.3, 0.3], [0.1, 0.1f64.next_up()]), Ordering::Greater);
/// ```
///
/// # Panics
/// Never. For coordinates that are infinite or not a number the answer means nothing.
#[inline]
pub fn orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Ordering {
    orient2d_of(a, b, c)
}

/// Returns on which side of the circle through the counter-clockwise triangle `a`, `b`, `c` the point `d` lies:
/// `Greater` inside, `Equal` on the circle, `Less` outside. The answer is the other way round for a clockwise triangle.
/// Exact for all finite coordinates; the time is that of [`orient2d`], twice.
///
/// ```
/// use core::cmp::Ordering;
/// use incircle_geometry::double::incircle;
/// let [a, b, c] = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1]];
/// assert_eq!(incircle(a, b, c, [0.0, 0.1]), Ordering::Equal);
/// assert_eq!(incircle(a, b, c, [0.0, 0.1f64.next_down()]), Ordering::Greater);
/// ```
#[inline]
pub fn incircle(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> Ordering {
    incircle_of(a, b, c, d)
}

#[cfg(test)]
mod tests;
