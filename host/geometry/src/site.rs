//! Points in the numbers in which the living mesh computes, with exact predicates.

use core::cmp::Ordering;
use core::fmt::Debug;

use bytemuck::Zeroable;

use crate::cpu::view::{view_of_32_bits, View, Wide, Widest, Width};
use crate::double::{cotangents, incircle_of, is_within_of, nearer_of, orient2d_of, Coordinate};
use crate::double::{incircle_seen, orient2d_seen, SizedView};
use crate::point::Point;
use crate::predicate;
use crate::tie::is_inside_at_tie;

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

    /// What predicates share that look at one edge from several points.
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

/// Whether all coordinates of the points are below 2^31, so that the public predicates are exact.
#[inline(always)]
fn are_below_31_bits<const N: usize>(points: [Point; N]) -> bool {
    points.iter().fold(0, |all, point| all | point.x | point.y) >> 31 == 0
}

impl Site for Point {
    fn is_finite(self) -> bool {
        true
    }

    #[inline(always)]
    fn orient2d(a: Self, b: Self, c: Self) -> Ordering {
        if are_below_31_bits([a, b, c]) {
            predicate::orient2d(a, b, c).cmp(&0)
        } else {
            view_of_32_bits(a, b, c).cross.cmp(&0)
        }
    }

    #[inline(always)]
    fn incircle([a, b, c]: [Self; 3], d: Self) -> Ordering {
        if are_below_31_bits([a, b, c, d]) {
            predicate::incircle(a, b, c, d).cmp(&0)
        } else {
            Widest::determinant(view_of_32_bits(a, b, c), view_of_32_bits(a, b, d)).cmp(&0)
        }
    }

    /// Means nothing for coordinates from 2^31 on.
    type View = View<i64>;

    #[inline(always)]
    fn view([a, b]: [Self; 2], p: Self) -> View<i64> {
        if are_below_31_bits([a, b, p]) {
            Wide::view(a.into(), b.into(), p.into())
        } else {
            View::default()
        }
    }

    #[inline(always)]
    fn side([a, b]: [Self; 2], seen: Seen<Self>) -> Ordering {
        if are_below_31_bits([a, b, seen.site]) {
            seen.view.cross.cmp(&0)
        } else {
            Self::orient2d(a, b, seen.site)
        }
    }

    #[inline(always)]
    fn incircle_seen([a, b]: [Self; 2], c: Seen<Self>, d: Seen<Self>) -> Ordering {
        if are_below_31_bits([a, b, c.site, d.site]) {
            Wide::determinant(c.view, d.view).cmp(&0)
        } else {
            Self::incircle([a, b, c.site], d.site)
        }
    }

    #[inline(always)]
    fn vector(from: Self, to: Self) -> [f64; 2] {
        // Differences of 32 bits are exact.
        [f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y)]
    }

    #[inline(always)]
    fn compare_distances(q: Self, a: Self, b: Self) -> Ordering {
        // Squares of differences of 32 bits, and the sum of two.
        let square = |p: Self| {
            let (x, y) = (u128::from(p.x.abs_diff(q.x)), u128::from(p.y.abs_diff(q.y)));
            x * x + y * y
        };
        square(a).cmp(&square(b))
    }

    fn is_within(q: Self, p: Self, radius: f64) -> bool {
        is_within_of(q.rounded(), p.rounded(), radius)
    }

    #[inline(always)]
    fn corner(x: Self, y: Self) -> Self {
        Self::new(x.x, y.y)
    }

    #[inline(always)]
    fn compare_y(self, other: Self) -> Ordering {
        self.y.cmp(&other.y)
    }

    #[inline(always)]
    fn rounded(self) -> [f64; 2] {
        [self.x.into(), self.y.into()]
    }
}

/// A point whose coordinates are finite and never minus zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Zeroable)]
pub struct FilteredSite<C>(pub(crate) [C; 2]);

impl<C: Coordinate> FilteredSite<C> {
    /// The site of a point with finite coordinates.
    #[inline(always)]
    pub(crate) fn of(point: [C; 2]) -> Self {
        Self(point.map(C::positive_zero))
    }
}

impl<C: Coordinate> Eq for FilteredSite<C> {}

impl<C: Coordinate> PartialOrd for FilteredSite<C> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<C: Coordinate> Ord for FilteredSite<C> {
    #[inline(always)]
    fn cmp(&self, other: &Self) -> Ordering {
        // All coordinates are finite, so all are comparable.
        self.0.partial_cmp(&other.0).unwrap_or(Ordering::Equal)
    }
}

impl<C: Coordinate + Debug> Site for FilteredSite<C> {
    fn is_finite(self) -> bool {
        self.0.iter().all(|value| value.half().is_finite())
    }

    #[inline(always)]
    fn orient2d(a: Self, b: Self, c: Self) -> Ordering {
        orient2d_of(a.0, b.0, c.0)
    }

    #[inline(always)]
    fn incircle([a, b, c]: [Self; 3], d: Self) -> Ordering {
        incircle_of(a.0, b.0, c.0, d.0)
    }

    type View = SizedView;

    #[inline(always)]
    fn view([a, b]: [Self; 2], p: Self) -> SizedView {
        SizedView::of(a.0, b.0, p.0)
    }

    #[inline(always)]
    fn side([a, b]: [Self; 2], seen: Seen<Self>) -> Ordering {
        orient2d_seen([a.0, b.0], seen.site.0, seen.view)
    }

    #[inline(always)]
    fn incircle_seen([a, b]: [Self; 2], c: Seen<Self>, d: Seen<Self>) -> Ordering {
        incircle_seen([a.0, b.0], [c.site.0, d.site.0], [c.view, d.view])
    }

    #[inline(always)]
    fn vector(from: Self, to: Self) -> [f64; 2] {
        [to.0[0].minus(from.0[0]), to.0[1].minus(from.0[1])]
    }

    #[inline(always)]
    fn compare_distances(q: Self, a: Self, b: Self) -> Ordering {
        nearer_of(q.0, a.0, b.0)
    }

    fn is_within(q: Self, p: Self, radius: f64) -> bool {
        is_within_of(q.0, p.0, radius)
    }

    #[inline(always)]
    fn corner(x: Self, y: Self) -> Self {
        Self([x.0[0], y.0[1]])
    }

    #[inline(always)]
    fn compare_y(self, other: Self) -> Ordering {
        self.0[1].partial_cmp(&other.0[1]).unwrap_or(Ordering::Equal)
    }

    #[inline(always)]
    fn rounded(self) -> [f64; 2] {
        self.0.map(|value| 2.0 * value.half())
    }
}

impl From<[i64; 2]> for FilteredSite<i64> {
    #[inline(always)]
    fn from(point: [i64; 2]) -> Self {
        Self::of(point)
    }
}

impl From<[f64; 2]> for FilteredSite<f64> {
    #[inline(always)]
    fn from(point: [f64; 2]) -> Self {
        Self::of(point)
    }
}
