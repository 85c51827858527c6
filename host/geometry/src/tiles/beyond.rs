//! The occupied cells beyond a region, as a tree of rectangles.

use alloc::vec::Vec;

use super::disc::Disc;
use super::region::Region;
use super::square::Square;
use crate::point::Point;

/// The most rectangles of a tree. If there would be more, some have larger squares of cells as a whole.
const MOST: usize = 1 << 16;
/// The most rectangles that one question looks at. A disc that follows a curve for long would take too long otherwise.
const MOST_VISITS: usize = 128;

/// The occupied cells of a set that have places beyond a region: [`Occupancy::beyond`](super::Occupancy::beyond) makes
/// them.
#[derive(Clone, Debug)]
pub struct Beyond {
    /// The rectangles, each before those that it contains.
    rectangles: Vec<Rectangle>,
}

/// The smallest rectangle around some occupied cells.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    /// The least and the greatest place, in whole numbers.
    low: [f64; 2],
    high: [f64; 2],
    /// The place in the list behind all rectangles that this one contains.
    next: u32,
    /// Whether it contains no other rectangle.
    is_leaf: bool,
}

impl Beyond {
    /// Whether the closed circumscribed disc of a triangle certainly touches none of the cells. Then no point of the
    /// set that is beyond the region is in the disc or on its circle.
    ///
    /// `false` proves nothing. The corners may turn either way. Takes 0.1 to 2 µs.
    pub fn is_clear(&self, corners: [Point; 3]) -> bool {
        let Some(disc) = Disc::of(corners) else { return false };
        let mut place = 0;
        for _ in 0..MOST_VISITS {
            let Some(found) = self.rectangles.get(place) else { return true };
            if disc.misses(found.low, found.high) {
                place = found.next as usize;
            } else if found.is_leaf {
                return false;
            } else {
                place += 1;
            }
        }
        false
    }

    /// The tree of the cells of a square. `stretches` has the occupied ones.
    pub(super) fn of(square: Square, shift: u32, region: &Region, stretches: &[[u32; 2]]) -> Self {
        let mut beyond = Self { rectangles: Vec::new() };
        beyond.add(square, shift, region, stretches);
        beyond
    }

    /// Adds the cells of a square that have places beyond the region.
    fn add(&mut self, square: Square, shift: u32, region: &Region, stretches: &[[u32; 2]]) {
        let cells = square.cells();
        let first = stretches.partition_point(|&[_, end]| u64::from(end) <= cells.start);
        let count = stretches[first..].partition_point(|&[start, _]| u64::from(start) < cells.end);
        let stretches = &stretches[first..first + count];
        let Some(&[start, end]) = stretches.first() else { return };
        let [low, high] = square.corners(shift);
        if region.contains(low) && region.contains(high) {
            return;
        }
        let [[west, south], [east, north]] = [low, high.map(|most| most + 1)];
        let own = Region { west: Some(west), east: Some(east), south: Some(south), north: Some(north) };
        let is_full = u64::from(start) <= cells.start && cells.end <= u64::from(end);
        let is_leaf = square.level == 0 || is_full && !region.overlaps(&own) || self.rectangles.len() >= MOST;
        let place = self.rectangles.len();
        let wide = |corner: [i64; 2]| corner.map(|coordinate| coordinate as f64);
        self.rectangles.push(Rectangle { low: wide(low), high: wide(high), next: 0, is_leaf });
        if !is_leaf {
            square.quarters().into_iter().for_each(|quarter| self.add(quarter, shift, region, stretches));
            self.tighten(place);
        }
        let end = self.rectangles.len() as u32;
        if let Some(own) = self.rectangles.get_mut(place) {
            own.next = end;
        }
    }

    /// Makes a rectangle the smallest one around those behind it, or removes it if there are none.
    fn tighten(&mut self, place: usize) {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut inner = place + 1;
        while let Some(child) = self.rectangles.get(inner) {
            low = [0, 1].map(|axis| low[axis].min(child.low[axis]));
            high = [0, 1].map(|axis| high[axis].max(child.high[axis]));
            inner = child.next as usize;
        }
        if inner == place + 1 {
            self.rectangles.truncate(place);
            return;
        }
        let own = &mut self.rectangles[place];
        (own.low, own.high) = (low, high);
    }
}
