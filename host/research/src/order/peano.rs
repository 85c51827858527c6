//! Peano's curve: nine squares in a serpentine, column by column, each with a mirrored copy so that the ends meet.
//!
//! Source: Peano, *Sur une courbe, qui remplit toute une aire plane*, 1890.

use super::square::square;
use incircle_geometry::order::by_key;
use incircle_geometry::Point;

/// Most levels of the curve: 9^20 fits 64 bits, and 3^20 is more than 2^31.
const LEVELS: u32 = 20;

/// The points along the curve over the square around them. Cells are a third of a grid step to a whole grid step wide,
/// so each has at most one grid point.
pub(super) fn order(points: &[Point]) -> Vec<u32> {
    let (corner, extent) = square(points);
    let levels = levels_for(extent);
    let (side, cells) = (u64::from(extent) + 1, 3u64.pow(levels));
    let scaled = |value: u32| u64::from(value) * cells / side;
    by_key(points, |point| position(scaled(point.x - corner.x), scaled(point.y - corner.y), levels))
}

/// The number of levels whose cells are no wider than a grid step.
fn levels_for(extent: u32) -> u32 {
    (0..LEVELS).find(|&levels| 3u64.pow(levels) > u64::from(extent)).unwrap_or(LEVELS)
}

/// The position of a cell on the curve of `levels` levels.
///
/// A copy is mirrored in x if the row numbers of the levels above have an odd sum, and in y if the column numbers do.
fn position(x: u64, y: u64, levels: u32) -> u64 {
    let (mut mirror_x, mut mirror_y) = (false, false);
    let mut position = 0;
    for level in (0..levels).rev() {
        let digit = |value: u64, is_mirrored: bool| {
            let digit = value / 3u64.pow(level) % 3;
            if is_mirrored {
                2 - digit
            } else {
                digit
            }
        };
        let (column, row) = (digit(x, mirror_x), digit(y, mirror_y));
        let along = if column == 1 { 2 - row } else { row };
        position = 9 * position + 3 * column + along;
        mirror_x ^= row == 1;
        mirror_y ^= column == 1;
    }
    position
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::order::drawing::{draw, longest_step};
    use crate::order::Curve;

    #[test]
    fn it_is_a_serpentine() {
        assert_eq!(draw(Curve::Peano, 3), ["  2  3  8", "  1  4  7", "  0  5  6"]);
    }

    #[test]
    fn it_never_jumps() {
        for side in [9, 27, 81] {
            assert_eq!(longest_step(Curve::Peano, side), 1);
        }
    }

    #[test]
    fn the_widest_square_has_cells_enough() {
        assert_eq!((levels_for(0), levels_for(2), levels_for(3), levels_for((1 << 31) - 1)), (0, 1, 2, 20));
        assert_eq!(position(3u64.pow(20) - 1, 3u64.pow(20) - 1, 20), 9u64.pow(20) - 1);
    }
}
