//! Curves that cut a long box into squares before they fill the box, and take the bounding box anew in every part.
//!
//! In a *wide* box, which is long in the direction in which the curve advances, curves are placed next to each other.
//! In a *tall* box Hilbert's curve goes up through more than two squares and down through as many; Peano's curves are
//! placed above each other, an odd number of them, so that the last one still ends in the opposite corner. Source:
//! Schrijvers, van Bommel, Buchin, EuroCG 2012.

use super::adaptive;
use super::pieces::{distribute, hilbert_way, order as order_pieces, peano_way, row_way, Cells, Orientation, Way};
use incircle_geometry::Point;

/// Most squares that a box is cut into at a time. Parts are cut again.
const MOST: i64 = 15;

/// The rule that says where the parts meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Split {
    /// Splits the box evenly.
    Box,
    /// Splits the points evenly.
    Points,
}

/// The points along the squarified Hilbert curve.
pub(super) fn hilbert(points: &[Point], split: Split) -> Vec<u32> {
    order_pieces(points, |piece, orientation| {
        let around = Around::of(points, piece, orientation);
        let (width, height) = (around.size[0], around.size[1]);
        let (cells, way) = if width >= 2 * height {
            let columns = squares(width, height);
            (Cells { columns, rows: 1 }, row_way(columns, orientation))
        } else {
            // There are two columns of squares, and two rows in a box that is nearly square itself.
            let rows = if height >= 2 * width { squares(2 * height, width) } else { 2 };
            (Cells { columns: 2, rows }, hilbert_way(rows, orientation))
        };
        around.divide(points, piece, orientation, split, cells, &way)
    })
}

/// The points along the squarified Peano curve.
pub(super) fn peano(points: &[Point], split: Split) -> Vec<u32> {
    order_pieces(points, |piece, orientation| {
        let around = Around::of(points, piece, orientation);
        let (width, height) = (around.size[0], around.size[1]);
        let cells = if width >= 2 * height {
            Cells { columns: squares(width, height) | 1, rows: 1 }
        } else if height >= 2 * width {
            Cells { columns: 1, rows: squares(height, width) | 1 }
        } else {
            Cells { columns: 3, rows: 3 }
        };
        around.divide(points, piece, orientation, split, cells, &peano_way(cells, orientation))
    })
}

/// The number of squares that fits a box best, at least 2.
fn squares(long: i64, short: i64) -> usize {
    ((2 * long + short) / (2 * short)).clamp(2, MOST) as usize
}

/// The box around the points of a piece, in the orientation of its curve.
struct Around {
    low: [i64; 2],
    /// Grid points along each side.
    size: [i64; 2],
}

impl Around {
    fn of(points: &[Point], piece: &[u32], orientation: Orientation) -> Self {
        let (mut low, mut high) = ([i64::MAX; 2], [i64::MIN; 2]);
        for &index in piece {
            let seen = orientation.see(points[index as usize]);
            for axis in 0..2 {
                low[axis] = low[axis].min(seen[axis]);
                high[axis] = high[axis].max(seen[axis]);
            }
        }
        Self { low, size: [0, 1].map(|axis| high[axis] - low[axis] + 1) }
    }

    fn divide(
        &self,
        points: &[Point],
        piece: &mut [u32],
        orientation: Orientation,
        split: Split,
        cells: Cells,
        way: &Way,
    ) -> Vec<(usize, Orientation)> {
        if split == Split::Points {
            return adaptive::split(points, piece, orientation, cells, way);
        }
        let part =
            |seen: i64, axis: usize, parts: usize| ((seen - self.low[axis]) * parts as i64 / self.size[axis]) as usize;
        distribute(piece, cells, way, |index| {
            let [u, v] = orientation.see(points[index as usize]);
            (part(u, 0, cells.columns), part(v, 1, cells.rows))
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::order::drawing::{draw, draw_box, longest_step, longest_step_in_box};
    use crate::order::Curve;

    #[test]
    fn squares_are_filled_as_ever() {
        for curve in [Curve::SquarifiedHilbert, Curve::SquarifiedAdaptiveHilbert] {
            assert_eq!(draw(curve, 4), ["  5  6  9 10", "  4  7  8 11", "  3  2 13 12", "  0  1 14 15"]);
            assert_eq!(longest_step(curve, 32), 1);
        }
        for curve in [Curve::SquarifiedPeano, Curve::SquarifiedAdaptivePeano] {
            assert_eq!(draw(curve, 3), ["  2  3  8", "  1  4  7", "  0  5  6"]);
            assert_eq!(longest_step(curve, 27), 1);
        }
    }

    #[test]
    fn wide_boxes_are_a_row_of_curves() {
        assert_eq!(draw_box(Curve::SquarifiedHilbert, 6, 2), ["  1  2  5  6  9 10", "  0  3  4  7  8 11"]);
        assert_eq!(longest_step_in_box(Curve::SquarifiedHilbert, 64, 16), 1);
        assert_eq!(longest_step_in_box(Curve::SquarifiedPeano, 27, 9), 1);
    }

    #[test]
    fn tall_boxes_are_gone_up_and_down() {
        assert_eq!(draw_box(Curve::SquarifiedHilbert, 2, 4), ["  3  4", "  2  5", "  1  6", "  0  7"]);
        assert_eq!(longest_step_in_box(Curve::SquarifiedHilbert, 16, 64), 1);
        assert_eq!(longest_step_in_box(Curve::SquarifiedPeano, 9, 27), 1);
    }
}
