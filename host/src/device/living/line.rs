//! Answers while all points lie on one line: no device has a mesh then.

use std::ops::Bound::{Excluded, Unbounded};

use super::names::{Names, Place};
use incircle_geometry::living::Location;
use incircle_geometry::{orient2d, Point};

impl Names {
    /// Whether the points, which lie on one line, would still do so with another point.
    pub(super) fn stays_flat_with(&self, point: Point) -> bool {
        let ends = self.places().keys().next().zip(self.places().keys().next_back());
        ends.is_none_or(|(&first, &last)| orient2d(first, last, point) == 0)
    }

    /// The vertex or the edge at a place, if all points lie on one line.
    pub(super) fn locate_on_line(&self, place: Point) -> Location {
        if let Some(here) = self.place(place) {
            return Location::Vertex(here.name());
        }
        let before = self.places().range(..place).next_back();
        let after = self.places().range((Excluded(place), Unbounded)).next();
        match before.zip(after) {
            Some(((&p, one), (&q, other))) if orient2d(p, q, place) == 0 => {
                let (one, other) = (one.name(), other.name());
                Location::Edge([one.min(other), one.max(other)])
            }
            _ => Location::None,
        }
    }

    /// The name of the place nearest to `place`, of several that with the smaller x, then y. O(n).
    pub(super) fn nearest_of_all(&self, place: Point) -> Option<u32> {
        let distance = |p: Point| {
            let [x, y] = [p.x.abs_diff(place.x), p.y.abs_diff(place.y)].map(u128::from);
            x * x + y * y
        };
        // Of equal ones `min_by_key` keeps the first, and the places are in lexicographic order.
        let nearest = self.places().iter().min_by_key(|&(&p, _)| distance(p));
        nearest.map(|(_, place): (_, &Place)| place.name())
    }
}
