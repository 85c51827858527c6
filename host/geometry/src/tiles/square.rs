//! Squares of cells along the Z-curve.

use crate::order::z_curve::point_at;

/// A square of `4^level` cells that follow each other along the Z-curve.
#[derive(Clone, Copy)]
pub(super) struct Square {
    pub(super) first: u64,
    pub(super) level: u32,
}

impl Square {
    pub(super) fn cells(self) -> core::ops::Range<u64> {
        self.first..self.first + (1 << (2 * self.level))
    }

    /// The least and the greatest place, if each cell has `2^shift` by `2^shift` places.
    pub(super) fn corners(self, shift: u32) -> [[i64; 2]; 2] {
        let cell = point_at(self.first);
        let low = [cell.x, cell.y].map(|cell| i64::from(cell) << shift);
        [low, low.map(|low| low + (1 << (self.level + shift)) - 1)]
    }

    pub(super) fn quarters(self) -> [Self; 4] {
        let level = self.level - 1;
        [0, 1, 2, 3].map(|quarter| Self { first: self.first + (quarter << (2 * level)), level })
    }
}
