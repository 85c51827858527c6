//! The order along the Hilbert curve.
//!
//! The curve has order 32 and covers the whole grid, so the order of two points does not depend on the coordinate bits.
//! A table, which the compiler fills, turns four bits of each coordinate at a time into a position.
//!
//! A quadrant's copy of the curve is the first copy with its axes swapped, or with both axes reversed, or with both
//! changes. Two flags are the whole state. Source: Hilbert, *Über die stetige Abbildung einer Linie
//! auf ein Flächenstück*, 1891.

use alloc::vec::Vec;

use crate::point::Point;
use crate::sort::{sort_by_key, Entry, Narrow, Wide};

/// Flag of a state: both axes run backwards in this copy of the curve.
const TURNED: u8 = 1;
/// Flag of a state: the axes are swapped in this copy of the curve.
const SWAPPED: u8 = 2;
/// In an entry of [`STEPS`] the next state lies above the eight bits of position.
const STATE_SHIFT: u32 = 8;

/// For each state and each four bits of x and y, eight bits of position and the next state.
static STEPS: [[u16; 256]; 4] = steps();

const fn steps() -> [[u16; 256]; 4] {
    let mut table = [[0; 256]; 4];
    let mut state = 0;
    while state < 4 {
        let mut xy = 0;
        while xy < 256 {
            table[state][xy] = four_steps(state as u8, xy as u8);
            xy += 1;
        }
        state += 1;
    }
    table
}

/// Walks down four levels of the curve, one bit of each coordinate at a time.
const fn four_steps(mut state: u8, xy: u8) -> u16 {
    let mut position = 0u16;
    let mut bit = 4;
    while bit > 0 {
        bit -= 1;
        let turn = state & TURNED;
        let (x, y) = ((xy >> (4 + bit) & 1) ^ turn, (xy >> bit & 1) ^ turn);
        let (x, y) = if state & SWAPPED != 0 { (y, x) } else { (x, y) };
        position = position << 2 | ((3 * x) ^ y) as u16;
        if y == 0 {
            state ^= SWAPPED;
            if x == 1 {
                state ^= TURNED;
            }
        }
    }
    position | (state as u16) << STATE_SHIFT
}

/// The position of `(x, y)` along the curve, for coordinates below 2^16, in about 5 ns.
fn position_16(x: u32, y: u32) -> u32 {
    position::<4>(x, y) as u32
}

/// The position of `(x, y)` along the curve, for any coordinates. Agrees with [`position_16`] below 2^16.
fn position_32(x: u32, y: u32) -> u64 {
    position::<8>(x, y)
}

/// The position of `(x, y)` from `4 * STEPS_DOWN` bits of each coordinate. Two zero groups of four bits leave the state
/// as it is, so more steps give the same position.
fn position<const STEPS_DOWN: u32>(x: u32, y: u32) -> u64 {
    let mut state = 0;
    let mut position = 0;
    for step in (0..STEPS_DOWN).rev() {
        let xy = (x >> (4 * step) & 15) << 4 | (y >> (4 * step) & 15);
        let entry = STEPS[state][xy as usize];
        position = position << 8 | u64::from(entry & 0xff);
        state = usize::from(entry >> STATE_SHIFT) & 3;
    }
    position
}

/// One pass along the Hilbert curve, as a permutation of `0..points.len()`.
///
/// Equal points stay together, in input order. O(n) by a radix sort of the positions.
pub fn hilbert(points: &[Point]) -> Vec<u32> {
    along_curve(points).into_indices()
}

/// Points sorted along the curve, in the smallest form that holds them.
pub enum Hilbert {
    /// Points with coordinates below 2^16, in 8 bytes per point.
    Narrow(Vec<Narrow>),
    /// Points with any coordinates, in 16 bytes per point.
    Wide(Vec<Wide>),
}

impl Hilbert {
    /// The indices of the points, in the order of the curve.
    pub fn into_indices(self) -> Vec<u32> {
        match self {
            Self::Narrow(entries) => entries.iter().map(Entry::value).collect(),
            Self::Wide(entries) => entries.iter().map(Entry::value).collect(),
        }
    }
}

/// Sorts points by their position along the curve. Equal positions are equal points, and stay in input order. O(n).
pub fn along_curve(points: &[Point]) -> Hilbert {
    let all = points.iter().fold(0, |all, point| all | point.x | point.y);
    if all < 1 << 16 {
        let mut entries: Vec<Narrow> = points
            .iter()
            .zip(0..=u32::MAX)
            .map(|(point, index)| Narrow::new(position_16(point.x, point.y), index))
            .collect();
        sort_by_key(&mut entries);
        Hilbert::Narrow(entries)
    } else {
        let mut entries: Vec<Wide> = points
            .iter()
            .zip(0..=u32::MAX)
            .map(|(point, index)| Wide::new(position_32(point.x, point.y), index))
            .collect();
        sort_by_key(&mut entries);
        Hilbert::Wide(entries)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn visits_every_cell_once_and_moves_one_cell_at_a_time() {
        let side = 64u32;
        let mut cells: Vec<(u64, u32, u32)> =
            (0..side * side).map(|cell| (position_32(cell / side, cell % side), cell / side, cell % side)).collect();
        cells.sort_unstable();
        for (expected, &(position, ..)) in cells.iter().enumerate() {
            assert_eq!(position, expected as u64);
        }
        for pair in cells.windows(2) {
            assert_eq!(pair[0].1.abs_diff(pair[1].1) + pair[0].2.abs_diff(pair[1].2), 1);
        }
    }

    #[test]
    fn both_widths_agree() {
        for k in 0..1000u32 {
            let (x, y) = (k.wrapping_mul(40_503) & 0xffff, k.wrapping_mul(2_654_435_761) >> 16);
            assert_eq!(u64::from(position_16(x, y)), position_32(x, y));
        }
    }
}
