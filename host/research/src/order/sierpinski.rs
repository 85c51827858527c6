//! Sierpiński's curve: the square is cut along its diagonal, then each triangle from the right angle to the
//! middle of its longest side, and so on. Neighbours on the curve share at least a corner, and the end of the
//! curve meets its beginning.
//!
//! Sources: Sierpiński, *Sur une nouvelle courbe continue qui remplit toute une aire plane*, 1912; for the position,
//! Bartholdi and Platzman, *An O(n log n) planar travelling salesman heuristic based on spacefilling curves*, 1982.

use super::square::square;
use incircle_geometry::order::by_key;
use incircle_geometry::Point;

/// The number of levels: two bits for each level, and one for the first diagonal, fit 64 bits.
const LEVELS: u32 = 31;

/// The points along the curve over the square around them.
pub(super) fn order(points: &[Point]) -> Vec<u32> {
    let (corner, extent) = square(points);
    // Points are the middles of cells, in units of half a cell, so that no point lies on a cut between whole cells.
    let bits = (u32::BITS - extent.leading_zeros()).min(LEVELS);
    let middle = |value: u32| 2 * i64::from(value) + 1;
    by_key(points, |point| position(middle(point.x - corner.x), middle(point.y - corner.y), 2 << bits))
}

/// The position on the curve of the place `(x, y)` in a square of side `side`.
///
/// The triangle that holds the place is always brought to one form: the hypotenuse along the left side, the right
/// angle in the middle.
fn position(mut x: i64, mut y: i64, side: i64) -> u64 {
    let mut position = 0;
    if x > y {
        position = 1;
        (x, y) = (side - x, side - y);
    }
    for _ in 0..LEVELS {
        position *= 2;
        if x + y > side {
            position += 1;
            (x, y) = (side - y, x);
        }
        (x, y) = (2 * x, 2 * y);
        position *= 2;
        if y > side {
            position += 1;
            (x, y) = (y - side, side - x);
        }
    }
    position
}

#[cfg(test)]
mod tests {
    use crate::order::drawing::{draw, longest_step};
    use crate::order::Curve;

    #[test]
    fn it_goes_round() {
        let expected = ["  5  6  8  9", "  4  3  7 10", "  1  2 11 12", "  0 15 14 13"];
        assert_eq!(draw(Curve::Sierpinski, 4), expected);
    }

    #[test]
    fn it_never_jumps() {
        for side in [4, 16, 64] {
            // From one cell to a neighbour, or to one that touches a neighbour's corner.
            assert!(longest_step(Curve::Sierpinski, side) <= 3, "{side}");
        }
    }
}
