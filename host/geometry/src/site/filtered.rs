//! Doubles and integers of 64 bits as sites: predicates in doubles, and exact ones where rounding hides the sign.

use core::cmp::Ordering;
use core::fmt::Debug;

use bytemuck::Zeroable;

use super::{Seen, Site};
use crate::double::{incircle_of, is_within_of, nearer_of, orient2d_of, Coordinate};
use crate::double::{incircle_seen, orient2d_seen, SizedView};

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
