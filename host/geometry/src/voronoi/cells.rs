//! The cells of a diagram, one after the other, inside a clip.

use super::clip::Clip;
use super::clipped::ClippedCell;
use super::clipper::Clipper;
use super::diagram::{Cell, Voronoi};
use super::place::Place;
use super::view::{Bend, Side};
use crate::point::Point;

/// Clips the cells of a diagram, one after the other, in memory that is used again.
pub struct Cells<'a> {
    voronoi: &'a Voronoi<'a>,
    clipper: Clipper<'a>,
}

impl<'a> Cells<'a> {
    /// Prepares to clip the cells of a diagram.
    pub fn new(voronoi: &'a Voronoi<'a>, clip: &'a Clip) -> Self {
        Self { voronoi, clipper: Clipper::new(voronoi.points, clip) }
    }

    /// Clips the cell of a point, exactly. A duplicate, or a point that does not exist, has no piece.
    ///
    /// O(k + log m) for a cell of `k` edges that the border of the clip does not come near, with `m` corners of the
    /// clip. Other cells take O(log m) for each of their edges, and as much for each time that the line of one crosses
    /// the border of the clip. After the first cells nothing is allocated.
    pub fn cell(&mut self, point: u32) -> ClippedCell<'_> {
        self.clipper.clear();
        let p = self.voronoi.points.get(point as usize).copied().unwrap_or_default();
        if let Some(cell) = self.voronoi.cell(point) {
            match self.is_clear(&cell, p) {
                true if self.clipper.clip().contains(p) => {
                    let sides = cell.neighbors().iter().map(|&neighbor| Side::Neighbor(neighbor));
                    self.clipper.take(places(self.voronoi, &cell).zip(sides).map(|(place, side)| Bend { place, side }));
                }
                true => {}
                false => self.clipper.cut(p, cell.neighbors().iter().copied()),
            }
        }
        self.clipper.cell(p, point)
    }

    /// Whether the border of the clip surely does not come near the cell.
    fn is_clear(&self, cell: &Cell<'_>, p: Point) -> bool {
        if cell.is_unbounded() {
            return false;
        }
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in places(self.voronoi, cell) {
            let seen = place.seen(p);
            for axis in 0..2 {
                // The error of a coordinate is far below its 2^-50th part.
                let margin = seen[axis].abs() * (1.0 / (1u64 << 50) as f64) + 1.0;
                let value = seen[axis] + f64::from([p.x, p.y][axis]);
                low[axis] = low[axis].min(value - margin);
                high[axis] = high[axis].max(value + margin);
            }
        }
        !self.clipper.clip().may_touch(low, high)
    }
}

/// The corners of a bounded cell, each the centre of a circle through the point and two neighbours.
fn places<'a>(voronoi: &'a Voronoi<'_>, cell: &Cell<'a>) -> impl Iterator<Item = Place> + 'a {
    let neighbors = cell.neighbors();
    let at = |edge: usize| voronoi.points[neighbors[edge] as usize];
    (0..neighbors.len()).map(move |edge| {
        // Consecutive edges of a bounded cell turn left, so the triangle is counter-clockwise.
        Place::Center([at(if edge == 0 { neighbors.len() - 1 } else { edge - 1 }), at(edge)])
    })
}
