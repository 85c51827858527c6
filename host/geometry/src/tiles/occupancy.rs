//! The places where a set has points, and the second question about a triangle: does its disc touch one of them?
//!
//! A disc that reaches beyond its region ([`reach`](super::reach())) may still touch no place with a point there: the
//! large discs of points on a curve are nearly empty. Then no point beyond the region conflicts with the triangle, which
//! is as final as one whose disc stays within the region.

use alloc::vec;
use alloc::vec::Vec;

use super::beyond::Beyond;
use super::region::Region;
use super::square::Square;
use crate::order::z_curve::position;
use crate::point::Point;

/// The most levels of cells: 4,096 by 4,096 cells at most.
const MOST_LEVELS: u32 = 12;
/// The most stretches of cells. Sets that need more have larger cells.
const MOST_STRETCHES: usize = 1 << 16;

/// The cells of a square grid in which a set has points.
///
/// [`OccupiedCells`] collects the points. At most 65,536 stretches of cells along the Z-curve are kept, of 8 bytes
/// each.
///
/// ```
/// use incircle_geometry::tiles::{reach, OccupiedCells, Reach, Region};
/// use incircle_geometry::Point;
///
/// let mut cells = OccupiedCells::new(10);
/// [(0, 0), (4, 0), (0, 4), (900, 900)].map(Point::from).iter().for_each(|&point| cells.add(point));
/// let occupancy = cells.finish();
/// // The disc of these three points reaches 0.83 beyond the region, where no point is.
/// let corners = [(0, 0), (4, 0), (0, 4)].map(Point::from);
/// let region = Region { east: Some(5), north: Some(4), ..Region::WHOLE };
/// assert_eq!(reach(&region, corners), Reach::Beyond);
/// // The point (0, 4) is beyond the region, and on the circle.
/// assert!(!occupancy.beyond(&region).is_clear(corners));
/// let region = Region { north: Some(5), east: Some(5), ..Region::WHOLE };
/// assert!(occupancy.beyond(&region).is_clear(corners));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Occupancy {
    /// Each cell is a square of `2^shift` by `2^shift` places.
    shift: u32,
    /// The occupied cells by their numbers along the Z-curve: the first of a stretch, and the one behind its last.
    stretches: Vec<[u32; 2]>,
}

/// The cells that have points among those seen so far.
#[derive(Clone, Debug)]
pub struct OccupiedCells {
    shift: u32,
    /// A bit for each cell.
    bits: Vec<u64>,
}

impl OccupiedCells {
    /// Begins with a set of no points, whose coordinates should have up to `bits` bits, at most 32: the cells are as small
    /// as that allows. Takes up to 2 MiB.
    pub fn new(bits: u32) -> Self {
        let levels = bits.min(MOST_LEVELS);
        Self { shift: bits.min(u32::BITS) - levels, bits: vec![0; (1usize << (2 * levels)).div_ceil(64)] }
    }

    /// Adds a point. One with more bits than were announced makes all cells larger, until it has one.
    #[inline]
    pub fn add(&mut self, point: Point) {
        loop {
            let cell = position(point.x >> self.shift, point.y >> self.shift);
            if let Some(word) = self.bits.get_mut((cell / 64) as usize) {
                *word |= 1 << (cell % 64);
                return;
            }
            // A point that was left out would make triangles final whose discs it is in.
            self.grow();
        }
    }

    /// Makes as many cells of twice the side.
    #[cold]
    fn grow(&mut self) {
        let words = self.bits.len();
        *self = self.larger();
        self.bits.resize(words, 0);
    }

    /// The occupancy of all points that were added.
    pub fn finish(&self) -> Occupancy {
        let mut occupancy = Occupancy { shift: self.shift, stretches: Vec::new() };
        let words = self.bits.iter().zip(0u32..).filter(|(word, _)| **word != 0);
        let cells = words
            .flat_map(|(word, place)| (0..64).filter(move |bit| word >> bit & 1 == 1).map(move |bit| 64 * place + bit));
        for cell in cells {
            occupancy.push([cell, cell + 1]);
            if occupancy.stretches.len() > MOST_STRETCHES {
                // The cells that follow have numbers of the smaller cells, so they begin again with larger ones.
                return self.larger().finish();
            }
        }
        occupancy
    }

    /// The same points in cells of twice the side.
    fn larger(&self) -> Self {
        let mut bits = vec![0u64; self.bits.len().div_ceil(4)];
        for (place, word) in self.bits.iter().enumerate() {
            let quarters = (0..16).filter(|quarter| word >> (4 * quarter) & 15 != 0);
            bits[place / 4] |= quarters.fold(0, |all, quarter| all | 1 << (16 * (place % 4) + quarter));
        }
        Self { shift: self.shift + 1, bits }
    }
}

impl Occupancy {
    /// The occupancy with these stretches of cells of `2^shift` by `2^shift` places, as [`Occupancy::stretches`] gave
    /// them. `None` if they do not ascend, or if there are cells beyond the grid of 32 bits.
    pub fn of_stretches(shift: u32, stretches: Vec<[u32; 2]>) -> Option<Self> {
        let levels = u32::BITS.checked_sub(shift)?.min(MOST_LEVELS);
        let ascend = stretches.as_flattened().is_sorted_by(|one, other| one < other);
        let fit = stretches.last().is_none_or(|&[_, end]| end <= 1 << (2 * levels));
        (ascend && fit).then_some(Self { shift, stretches })
    }

    /// The binary logarithm of the side of a cell.
    pub fn shift(&self) -> u32 {
        self.shift
    }

    /// The occupied cells, as stretches of their numbers along the Z-curve: the first cell, and the one behind the
    /// last. They ascend and do not touch.
    pub fn stretches(&self) -> &[[u32; 2]] {
        &self.stretches
    }

    /// The occupied cells that have places beyond a region, prepared for many triangles. Takes up to 3 MiB.
    pub fn beyond(&self, region: &Region) -> Beyond {
        let level = u32::BITS.saturating_sub(self.shift).min(MOST_LEVELS);
        Beyond::of(Square { first: 0, level }, self.shift, region, &self.stretches)
    }

    /// Adds cells behind all others.
    fn push(&mut self, stretch: [u32; 2]) {
        match self.stretches.last_mut() {
            Some(last) if last[1] == stretch[0] => last[1] = stretch[1],
            _ => self.stretches.push(stretch),
        }
    }
}
