//! Grid points as sites: integers of 32 bits, whose predicates need 64 or 128 bits.

use core::cmp::Ordering;

use super::{Seen, Site};
use crate::cpu::view::{view_of_32_bits, View, Wide, Widest, Width};
use crate::double::is_within_of;
use crate::point::Point;
use crate::predicate;

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
