//! The corners and edges of a cell while it is cut, as its point sees them.

use super::clip::Clip;
use super::corner::vector;
use super::place::Place;
use crate::point::Point;

/// The line on which an edge of a clipped cell lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The border with the cell of the point of this index.
    Neighbor(u32),
    /// The edge of the clip with this number.
    Clip(u32),
}

/// A corner of a ring, with the edge that begins there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bend {
    pub(super) place: Place,
    pub(super) side: Side,
}

/// A point that sees a ring: all that questions need.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) p: Point,
    pub(super) points: &'a [Point],
    pub(super) clip: &'a Clip,
}

impl View<'_> {
    /// The place where an edge of a ring meets the border with `q`.
    pub(super) fn meet(&self, side: Side, q: Point) -> Place {
        match side {
            Side::Clip(edge) => {
                let [a, b] = self.clip.rings.edge(edge as usize);
                Place::Crossing([a, b, q])
            }
            Side::Neighbor(neighbor) => Place::center(self.p, [self.points[neighbor as usize], q]),
        }
    }

    /// The direction of an edge of a ring.
    pub(super) fn direction(&self, side: Side) -> [i64; 2] {
        match side {
            Side::Clip(edge) => {
                let [a, b] = self.clip.rings.edge(edge as usize);
                vector(a, b)
            }
            Side::Neighbor(neighbor) => {
                let [x, y] = vector(self.p, self.points[neighbor as usize]);
                [-y, x]
            }
        }
    }
}
