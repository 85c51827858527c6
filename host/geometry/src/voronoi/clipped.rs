//! A cell inside a clip, its pieces and their rings.

use core::cmp::Ordering;

use super::clip::Clip;
use super::corner::Corner;
use super::place::Place;
use super::view::{Bend, Side};
use crate::point::Point;
use crate::predicate::orient2d;

/// A cell inside a clip: no piece, one, or several if the clip is not convex.
#[derive(Clone, Copy)]
pub struct ClippedCell<'a> {
    pub(super) p: Point,
    pub(super) point: u32,
    pub(super) points: &'a [Point],
    pub(super) clip: &'a Clip,
    pub(super) bends: &'a [Bend],
    pub(super) counts: &'a [usize],
}

/// A piece of a clipped cell: a polygon, perhaps with holes.
#[derive(Clone, Copy)]
pub struct Piece<'a> {
    cell: ClippedCell<'a>,
    ring: Ring<'a>,
}

/// The border of a piece, counter-clockwise, or of a hole in one, clockwise.
#[derive(Clone, Copy)]
pub struct Ring<'a> {
    p: Point,
    bends: &'a [Bend],
    is_hole: bool,
}

impl<'a> ClippedCell<'a> {
    /// The index of the point to which the cell belongs.
    pub fn point(&self) -> u32 {
        self.point
    }

    /// All rings of the cell: the borders of its pieces, and those of holes.
    pub fn rings(&self) -> impl Iterator<Item = Ring<'a>> + 'a {
        let (p, clip, mut rest) = (self.p, self.clip, self.bends);
        self.counts.iter().map(move |&count| {
            let (bends, others) = rest.split_at(count.min(rest.len()));
            rest = others;
            // A hole that the border of a cell meets becomes part of the border of a piece.
            let is_of_hole = |bend: &Bend| matches!(bend.side, Side::Clip(edge) if clip.rings.is_of_hole(edge));
            Ring { p, bends, is_hole: bends.iter().all(is_of_hole) }
        })
    }

    /// The pieces of the cell, with positive areas and no common inner place. There is at most one in a convex clip.
    pub fn pieces(&self) -> impl Iterator<Item = Piece<'a>> + 'a {
        let cell = *self;
        self.rings().filter(|ring| !ring.is_hole).map(move |ring| Piece { cell, ring })
    }

    /// The points whose cells share an edge of positive length with the cell inside the clip: the edge does not merely
    /// run along the border of the clip. In the order of the edges of the pieces; a neighbour comes once for each edge.
    pub fn neighbors(&self) -> impl Iterator<Item = u32> + 'a {
        self.bends.iter().filter_map(|bend| match bend.side {
            Side::Neighbor(neighbor) => Some(neighbor),
            Side::Clip(_) => None,
        })
    }

    /// The area in squares of the grid.
    ///
    /// The sum is worked out in doubles, on coordinates seen from the point. It is off by at most `k (k + 8) 2^-53 r²`
    /// for `k` corners, of which the farthest lies at the distance `r` from the point. The result is the same on every
    /// machine.
    pub fn area(&self) -> f64 {
        self.rings().map(|ring| ring.twice_area() / 2.0).sum()
    }
}

impl<'a> Piece<'a> {
    /// The corners of the outer border with the edges that begin there, counter-clockwise.
    pub fn corners(&self) -> impl Iterator<Item = (Corner, Side)> + 'a {
        self.ring.corners()
    }

    /// The holes of the piece. Only a clip with holes has them. O(k) for each hole of the cell, with `k` corners of the
    /// cell.
    pub fn holes(&self) -> impl Iterator<Item = Ring<'a>> + 'a {
        let (cell, outer) = (*self, self.ring);
        cell.cell.rings().filter(move |ring| ring.is_hole && cell.cell.surrounds(outer, *ring))
    }

    /// The area; see [`ClippedCell::area`].
    pub fn area(&self) -> f64 {
        self.ring.twice_area() / 2.0 + self.holes().map(|hole| hole.twice_area() / 2.0).sum::<f64>()
    }
}

impl<'a> ClippedCell<'a> {
    /// Whether a hole lies in the piece with this border. A hole may touch the border with corners, but no piece that
    /// it does not belong to has all of them.
    fn surrounds(&self, outer: Ring<'_>, hole: Ring<'_>) -> bool {
        hole.bends.iter().all(|bend| match bend.place {
            Place::Corner(corner) => self.side(outer, corner).is_ge(),
            Place::Center(_) | Place::Crossing(_) => false,
        })
    }

    /// Whether a grid point lies inside a ring (`Greater`), on it (`Equal`) or outside (`Less`).
    fn side(&self, ring: Ring<'_>, point: Point) -> Ordering {
        let mut side = Ordering::Less;
        for (k, bend) in ring.bends.iter().enumerate() {
            let next = &ring.bends[if k + 1 == ring.bends.len() { 0 } else { k + 1 }];
            // The side of the point on the line through the edge: left of it is greater.
            let line = match bend.side {
                Side::Clip(edge) => {
                    let [a, b] = self.clip.rings.edge(edge as usize);
                    orient2d(a, b, point).cmp(&0)
                }
                // Borders have the point of the cell on their left.
                Side::Neighbor(neighbor) => Place::Corner(point).side(self.p, self.points[neighbor as usize]),
            };
            let [from, to] = [bend, next].map(|bend| bend.place.corner(self.p));
            let [begin, end] = [from, to].map(|end| [end.compare_x(point.x), end.compare_y(point.y)]);
            let is_between = |axis: usize| begin[axis] != end[axis] || begin[axis].is_eq();
            if line.is_eq() && is_between(0) && is_between(1) {
                return Ordering::Equal;
            }
            // Half open, so that a corner on the ray to the right counts once.
            let (begins_above, ends_above) = (begin[1].is_gt(), end[1].is_gt());
            if begins_above != ends_above && line.is_gt() == ends_above {
                side = side.reverse();
            }
        }
        side
    }
}

impl<'a> Ring<'a> {
    /// The corners with the edges that begin there.
    pub fn corners(&self) -> impl Iterator<Item = (Corner, Side)> + 'a {
        let p = self.p;
        self.bends.iter().map(move |bend| (bend.place.corner(p), bend.side))
    }

    /// Whether the ring is a hole.
    pub fn is_hole(&self) -> bool {
        self.is_hole
    }

    /// Twice the area, negative for a hole.
    fn twice_area(&self) -> f64 {
        let Some(last) = self.bends.last() else { return 0.0 };
        let (mut twice, mut from) = (0.0, last.place.seen(self.p));
        for bend in self.bends {
            let to = bend.place.seen(self.p);
            twice += from[0] * to[1] - from[1] * to[0];
            from = to;
        }
        twice
    }
}
