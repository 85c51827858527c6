//! The points in a rectangle.

use alloc::collections::BTreeSet;
use alloc::vec;
use alloc::vec::Vec;

use super::plane::{Side, INFINITE};
use super::triangulation::Triangulation;
use super::walk::Place;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// A rectangle with its sides parallel to the axes, and with its border.
struct Rectangle<S> {
    low: S,
    high: S,
}

impl<S: Site> Rectangle<S> {
    /// The rectangle of two opposite corners.
    fn of(one: S, other: S) -> Self {
        let [left, right] = if one.compare_x(other).is_le() { [one, other] } else { [other, one] };
        let [bottom, top] = if one.compare_y(other).is_le() { [one, other] } else { [other, one] };
        Self { low: S::corner(left, bottom), high: S::corner(right, top) }
    }

    fn corners(&self) -> [S; 4] {
        let Self { low, high } = *self;
        [low, S::corner(high, low), high, S::corner(low, high)]
    }

    fn holds(&self, p: S) -> bool {
        let Self { low, high } = *self;
        low.compare_x(p).is_le() && low.compare_y(p).is_le() && p.compare_x(high).is_le() && p.compare_y(high).is_le()
    }

    /// Whether the rectangle has a point of the edge from `a` to `b`. If not, a line parallel to one of the axes or to
    /// the edge separates them.
    fn touches(&self, a: S, b: S) -> bool {
        let Self { low, high } = *self;
        let outside = |compare: fn(S, S) -> core::cmp::Ordering| {
            compare(a, low).is_lt() && compare(b, low).is_lt() || compare(a, high).is_gt() && compare(b, high).is_gt()
        };
        if outside(S::compare_x) || outside(S::compare_y) {
            return false;
        }
        let turns = self.corners().map(|corner| S::orient2d(a, b, corner));
        !(turns.iter().all(|turn| turn.is_gt()) || turns.iter().all(|turn| turn.is_lt()))
    }
}

impl<P: PlanePoint> Triangulation<P> {
    /// The indices of the places in a rectangle or on its border, in rising order. Any two opposite corners name the
    /// rectangle. None if a coordinate is infinite or not a number.
    ///
    /// O(t log t) for the `t` triangles that the rectangle touches, beside the search for a corner; O(h) for the hull
    /// if all corners are outside.
    ///
    /// ```
    /// let mesh = incircle_geometry::Triangulation::from((0..25).map(|k| [k % 5, k / 5]))?;
    /// assert_eq!(mesh.within_rectangle([3, 2], [2, 3]), [12, 13, 17, 18]);
    /// # Ok::<(), incircle_geometry::living::Error>(())
    /// ```
    pub fn within_rectangle(&self, corner: P, opposite: P) -> Vec<u32> {
        let (one, other, base) = (corner.site(), opposite.site(), self.base());
        if !one.is_finite() || !other.is_finite() {
            return Vec::new();
        }
        let rectangle = Rectangle::of(one, other);
        let mut found: BTreeSet<u32> = BTreeSet::new();
        if base.is_plane() {
            self.flood(&rectangle, &mut found);
        } else {
            let line = base.line.range(rectangle.low..=rectangle.high);
            found.extend(line.filter(|entry| rectangle.holds(*entry.0)).map(|entry| *entry.1));
        }
        let mut names: Vec<u32> = found.into_iter().map(|vertex| self.name(vertex)).collect();
        names.sort_unstable();
        names
    }

    /// Goes through all triangles that the rectangle touches. They hang together by edges that it touches, because the
    /// rectangle and the hull are convex.
    fn flood(&self, rectangle: &Rectangle<P::Site>, found: &mut BTreeSet<u32>) {
        let (base, plane) = (self.base(), &self.base().plane);
        let start = self.touched(rectangle);
        let mut seen: BTreeSet<u32> = start.into_iter().collect();
        let mut open: Vec<u32> = start.map_or(Vec::new(), |triangle| vec![triangle]);
        while let Some(triangle) = open.pop() {
            let inside = plane.get(triangle).vertices.into_iter().filter(|&v| rectangle.holds(base.site(v)));
            found.extend(inside);
            for side in (0..3).map(|slot| Side::new(triangle, slot)) {
                let (other, ends) = (plane.across(side), plane.ends(side).map(|vertex| base.site(vertex)));
                let goes_on = plane.apex(other) != INFINITE && rectangle.touches(ends[0], ends[1]);
                if goes_on && seen.insert(other.triangle()) {
                    open.push(other.triangle());
                }
            }
        }
    }

    /// A triangle that the rectangle touches: one with a corner, else one on the hull.
    fn touched(&self, rectangle: &Rectangle<P::Site>) -> Option<u32> {
        let (base, plane) = (self.base(), &self.base().plane);
        for corner in rectangle.corners() {
            match self.find(corner) {
                Place::Triangle(triangle) => return Some(triangle),
                Place::Edge(side) => return Some(side.triangle()),
                Place::Vertex(vertex) => {
                    let finite = |side: &Side| plane.get(side.triangle()).infinite_slot().is_none();
                    return base.star(vertex).find(finite).map(Side::triangle);
                }
                Place::Outside(_) | Place::Between(..) | Place::Nowhere => {}
            }
        }
        let mut hull = base.ghosts(plane.ghost).map(|ghost| Side::new(ghost, plane.get(ghost).slot_of(INFINITE)));
        let touches = |side: &Side| {
            let [a, b] = plane.ends(*side).map(|vertex| base.site(vertex));
            rectangle.touches(a, b)
        };
        hull.find(touches).map(|side| plane.across(side).triangle())
    }
}
