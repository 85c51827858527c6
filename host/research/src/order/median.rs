//! Hilbert's quadrants with a quarter of the points each: a split at the median of one coordinate, then of each half at
//! its own median of the other coordinate.
//!
//! A split by x first is CGAL's (Delage, *Spatial sorting*, CGAL manual). If the medians of both halves differ, the
//! step between the upper quadrants is long. A split by y first has no such step (Schrijvers, van Bommel, Buchin,
//! EuroCG 2012: Hilbert YX).

use super::pieces::{distribute, hilbert_way, order as order_pieces, part_of, quantiles, Cells, Orientation};
use incircle_geometry::Point;

/// The coordinate that is split first, in the orientation of each copy of the curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum First {
    X,
    Y,
}

/// The key by which points are compared, from their coordinates in an orientation.
type Key = fn([i64; 2]) -> [i64; 2];

/// The points along the curve.
pub(super) fn order(points: &[Point], first: First) -> Vec<u32> {
    order_pieces(points, |piece, orientation| divide(points, first, piece, orientation))
}

fn divide(points: &[Point], first: First, piece: &mut [u32], orientation: Orientation) -> Vec<(usize, Orientation)> {
    let see = |index: u32| orientation.see(points[index as usize]);
    // The other coordinate decides between points that are equal in one.
    let (split, then): (Key, Key) = match first {
        First::X => (|seen| seen, |[u, v]| [v, u]),
        First::Y => (|[u, v]| [v, u], |seen| seen),
    };
    let middle = quantiles(piece.iter().map(|&index| split(see(index))), 2);
    let half = |index: u32| part_of(split(see(index)), &middle);
    let medians = [0, 1].map(|side| {
        let seen: Vec<_> = piece.iter().filter(|&&index| half(index) == side).map(|&index| then(see(index))).collect();
        if seen.is_empty() {
            Vec::new()
        } else {
            quantiles(seen.into_iter(), 2)
        }
    });
    let cell = |index: u32| {
        let side = half(index);
        let quarter = part_of(then(see(index)), &medians[side]);
        match first {
            First::X => (side, quarter),
            First::Y => (quarter, side),
        }
    };
    distribute(piece, Cells { columns: 2, rows: 2 }, &hilbert_way(2, orientation), cell)
}

#[cfg(test)]
mod tests {
    use crate::order::drawing::{draw, longest_step};
    use crate::order::Curve;
    use incircle_geometry::Point;

    #[test]
    fn on_a_lattice_both_are_hilberts_curve() {
        for curve in [Curve::MedianHilbert, Curve::HilbertYx] {
            assert_eq!(draw(curve, 4), ["  5  6  9 10", "  4  7  8 11", "  3  2 13 12", "  0  1 14 15"]);
            assert_eq!(longest_step(curve, 32), 1);
        }
    }

    #[test]
    fn only_the_first_jumps_where_medians_differ() {
        // The left half lies low, the right half high.
        let points: Vec<Point> =
            (0..256).map(|k| Point::new(k % 16 * 10, k / 16 * 10 + if k % 16 < 8 { 0 } else { 400 })).collect();
        let longest = |curve: Curve| {
            let order = curve.order(&points);
            let steps = order.windows(2).map(|pair| {
                let (a, b) = (points[pair[0] as usize], points[pair[1] as usize]);
                a.x.abs_diff(b.x) + a.y.abs_diff(b.y)
            });
            steps.max()
        };
        assert!(longest(Curve::MedianHilbert) > longest(Curve::HilbertYx));
    }
}
