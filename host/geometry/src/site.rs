//! Points in the numbers in which the living mesh computes, with exact predicates.

mod filtered;
mod grid;

use core::cmp::Ordering;
use core::fmt::Debug;

use crate::double::cotangents;
use crate::tie::is_inside_at_tie;

pub use filtered::FilteredSite;

/// A point, and an edge as seen from there.
#[derive(Clone, Copy, Debug)]
pub struct Seen<S: Site> {
    pub site: S,
    pub view: S::View,
}

impl<S: Site> Seen<S> {
    #[inline(always)]
    pub fn of(edge: [S; 2], site: S) -> Self {
        Self { site, view: S::view(edge, site) }
    }
}

/// A point whose predicates are exact. The order is lexicographic, x before y, as the tie rule wants.
pub trait Site: Copy + Ord + Debug + Send + Sync + 'static {
    /// Whether both coordinates are finite numbers. No other function may be called before this one has said so.
    fn is_finite(self) -> bool;

    /// The turn from `a` over `b` to `c`: `Greater` if it is counter-clockwise, `Equal` on one line.
    fn orient2d(a: Self, b: Self, c: Self) -> Ordering;

    /// The sign of incircle: `Greater` if `d` lies inside the circle of the counter-clockwise triangle.
    fn incircle(abc: [Self; 3], d: Self) -> Ordering;

    /// The part of the predicates that depends on an edge and one point, so that several tests of the point share it.
    type View: Copy + Debug;

    /// Views an edge from a point.
    fn view(edge: [Self; 2], p: Self) -> Self::View;

    /// The side of the edge on which a point lies, as [`orient2d`](Self::orient2d) gives it.
    fn side(edge: [Self; 2], seen: Seen<Self>) -> Ordering;

    /// The sign of incircle of the triangle on an edge with the apex `c`.
    fn incircle_seen(edge: [Self; 2], c: Seen<Self>, d: Seen<Self>) -> Ordering;

    /// The same as [`conflicts`](Self::conflicts) for the triangle on an edge with the apex `c`.
    #[inline(always)]
    fn conflicts_seen(edge: [Self; 2], c: Seen<Self>, d: Seen<Self>) -> bool {
        match Self::incircle_seen(edge, c, d) {
            Ordering::Greater => true,
            Ordering::Less => false,
            Ordering::Equal => is_inside_at_tie([edge[0], edge[1], c.site], d.site, Self::orient2d),
        }
    }

    /// Compares the distances from `q` to `a` and to `b`.
    fn compare_distances(q: Self, a: Self, b: Self) -> Ordering;

    /// Whether `p` lies at most `radius` from `q`.
    fn is_within(q: Self, p: Self, radius: f64) -> bool;

    /// The point with the first x and the second y.
    fn corner(x: Self, y: Self) -> Self;

    /// Compares the y of two points.
    fn compare_y(self, other: Self) -> Ordering;

    /// Both coordinates, rounded to doubles.
    fn rounded(self) -> [f64; 2];

    /// Compares the x of two points.
    fn compare_x(self, other: Self) -> Ordering {
        self.cmp(&Self::corner(other, self))
    }

    /// Whether the counter-clockwise triangle conflicts with `d`: `d` is inside its circle, or on it where the tie rule
    /// says so.
    #[inline(always)]
    fn conflicts(abc: [Self; 3], d: Self) -> bool {
        match Self::incircle(abc, d) {
            Ordering::Greater => true,
            Ordering::Less => false,
            Ordering::Equal => is_inside_at_tie(abc, d, Self::orient2d),
        }
    }

    /// The cotangents of the angles of a triangle in multiples of 1/128, rounded, or `None` if the triangle is slender,
    /// or may not be counter-clockwise.
    ///
    /// If the cotangents opposite an edge add up to [`LEAST_SUM`](crate::double::LEAST_SUM) or more, neither corner
    /// lies in or on the circle of the other triangle. If they add up to minus that or less, both lie inside.
    #[inline(always)]
    fn cotangents([a, b, c]: [Self; 3]) -> Option<[i16; 3]> {
        cotangents([Self::vector(b, c), Self::vector(c, a), Self::vector(a, b)])
    }

    /// The vector from one point to another. Each coordinate is the exact difference, rounded once.
    fn vector(from: Self, to: Self) -> [f64; 2];

    /// Compares two points by their distance from `q`, and points at the same distance by x, then y.
    #[inline]
    fn compare_nearness(q: Self, a: Self, b: Self) -> Ordering {
        Self::compare_distances(q, a, b).then_with(|| a.cmp(&b))
    }

    /// Whether `q`, a point on the line of `a` and `b`, lies strictly between them.
    #[inline]
    fn is_between(a: Self, q: Self, b: Self) -> bool {
        (a < q) == (q < b) && q != a && q != b
    }

    /// An estimate of the squared distance, for choices that do not change an answer.
    #[inline(always)]
    fn rough_distance(self, other: Self) -> f64 {
        let ([x, y], [u, v]) = (self.rounded(), other.rounded());
        (x - u) * (x - u) + (y - v) * (y - v)
    }
}
