//! Hilbert's and Peano's curves, split where the points are: at the medians of x and y at once, or at the thirds.
//!
//! The curves have no jumps, because all parts meet in the same lines, but a part may have any share of the points.
//! Source: Schrijvers, van Bommel, Buchin, *Delaunay triangulations on the word RAM: towards a practical worst-case
//! optimal algorithm*, EuroCG 2012.

use super::pieces::{
    distribute, hilbert_way, order as order_pieces, part_of, peano_way, quantiles, Cells, Orientation, Way,
};
use incircle_geometry::Point;

/// The points along the adaptive Hilbert curve.
pub(super) fn hilbert(points: &[Point]) -> Vec<u32> {
    order_pieces(points, |piece, orientation| {
        let cells = Cells { columns: 2, rows: 2 };
        split(points, piece, orientation, cells, &hilbert_way(2, orientation))
    })
}

/// The points along the adaptive Peano curve.
pub(super) fn peano(points: &[Point]) -> Vec<u32> {
    order_pieces(points, |piece, orientation| {
        let cells = Cells { columns: 3, rows: 3 };
        split(points, piece, orientation, cells, &peano_way(cells, orientation))
    })
}

/// Splits a piece into columns of equal numbers of points, and into rows of equal numbers of points. The other
/// coordinate decides between points that are equal in one.
pub(super) fn split(
    points: &[Point],
    piece: &mut [u32],
    orientation: Orientation,
    cells: Cells,
    way: &Way,
) -> Vec<(usize, Orientation)> {
    let see = |index: u32| orientation.see(points[index as usize]);
    let swapped = |[u, v]: [i64; 2]| [v, u];
    let columns = quantiles(piece.iter().map(|&index| see(index)), cells.columns);
    let rows = quantiles(piece.iter().map(|&index| swapped(see(index))), cells.rows);
    distribute(piece, cells, way, |index| (part_of(see(index), &columns), part_of(swapped(see(index)), &rows)))
}

#[cfg(test)]
mod tests {
    use crate::order::drawing::{draw, longest_step};
    use crate::order::Curve;

    #[test]
    fn on_lattices_they_are_the_plain_curves() {
        let hilbert = draw(Curve::AdaptiveHilbert, 4);
        assert_eq!(hilbert, ["  5  6  9 10", "  4  7  8 11", "  3  2 13 12", "  0  1 14 15"]);
        assert_eq!(draw(Curve::AdaptivePeano, 3), ["  2  3  8", "  1  4  7", "  0  5  6"]);
        assert_eq!((longest_step(Curve::AdaptiveHilbert, 32), longest_step(Curve::AdaptivePeano, 27)), (1, 1));
    }
}
