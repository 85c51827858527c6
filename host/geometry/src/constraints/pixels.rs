//! Segments between points of the grid, and the pixels that they meet.

use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

use crate::point::Point;

/// A segment between two points, which may be one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment(pub [Point; 2]);

/// A fraction with a positive denominator: a place along a segment.
type Share = [i128; 2];

fn is_less([a, b]: Share, [c, d]: Share) -> bool {
    a * d < c * b
}

/// The vector from one point to another.
fn vector(from: Point, to: Point) -> [i128; 2] {
    [i128::from(to.x) - i128::from(from.x), i128::from(to.y) - i128::from(from.y)]
}

fn cross([a, b]: [i128; 2], [c, d]: [i128; 2]) -> i128 {
    a * d - b * c
}

impl Segment {
    pub fn low(&self, coordinate: impl Fn(Point) -> u32) -> u32 {
        coordinate(self.0[0]).min(coordinate(self.0[1]))
    }

    pub fn high(&self, coordinate: impl Fn(Point) -> u32) -> u32 {
        coordinate(self.0[0]).max(coordinate(self.0[1]))
    }

    /// The segment with its lexicographically smaller end first.
    pub fn rightward(&self) -> Self {
        let [a, b] = self.0;
        Self([a.min(b), a.max(b)])
    }

    /// The side of the segment on which a point lies: 1 at the left, which is above if the segment runs from left to
    /// right; -1 at the right; 0 on its line.
    pub fn side(&self, point: Point) -> i128 {
        cross(vector(self.0[0], self.0[1]), vector(self.0[0], point)).signum()
    }

    /// `Greater` if this segment is steeper than another. Both run from left to right.
    pub fn rises_above(&self, other: &Self) -> Ordering {
        cross(vector(other.0[0], other.0[1]), vector(self.0[0], self.0[1])).cmp(&0)
    }

    /// The first whole x behind or at the crossing of two segments that cross, and whether the crossing is there.
    pub fn stop(&self, other: &Self) -> (u32, bool) {
        let [x, _, whole] = self.place(other);
        let before = x.div_euclid(whole);
        let is_at = before * whole == x;
        ((before + i128::from(!is_at)) as u32, is_at)
    }

    /// Whether two segments cross inside both.
    pub fn crosses(&self, other: &Self) -> bool {
        let overlap = |coordinate: fn(Point) -> u32| {
            self.low(coordinate) <= other.high(coordinate) && other.low(coordinate) <= self.high(coordinate)
        };
        let divides = |one: &Self, other: &Self| one.side(other.0[0]) * one.side(other.0[1]) < 0;
        overlap(|point| point.y) && divides(self, other) && divides(other, self)
    }

    /// The crossing of two segments that cross: both coordinates above one denominator, which is positive.
    fn place(&self, other: &Self) -> [i128; 3] {
        let ([a, b], [c, d]) = (self.0, other.0);
        let (along, across) = (vector(a, b), vector(c, d));
        let (share, whole) = (cross(vector(a, c), across), cross(along, across));
        let sign = whole.signum();
        let coordinate = |start: u32, along: i128| sign * (i128::from(start) * whole + share * along);
        [coordinate(a.x, along[0]), coordinate(a.y, along[1]), sign * whole]
    }

    /// The crossing of two segments that cross, if it is a point of the grid.
    pub fn crossing(&self, other: &Self) -> Option<Point> {
        let [x, y, whole] = self.place(other);
        (x % whole == 0 && y % whole == 0).then(|| Point::new((x / whole) as u32, (y / whole) as u32))
    }

    /// The centre of the pixel in which two segments cross.
    pub fn pixel(&self, other: &Self) -> Point {
        let [x, y, whole] = self.place(other);
        // A coordinate half way between two centres belongs to the larger.
        let nearest = |value: i128| (2 * value + whole).div_euclid(2 * whole) as u32;
        Point::new(nearest(x), nearest(y))
    }

    /// The distance of a point near the line of the segment from that line, in multiples of 2^-20, rounded down.
    pub fn distance(&self, point: Point) -> u64 {
        let along = vector(self.0[0], self.0[1]);
        let square = (along[0] * along[0] + along[1] * along[1]).unsigned_abs();
        // A point in whose pixel the segment passes is less than one step away, so the product is below 2^33.
        let across = cross(along, vector(self.0[0], point)).unsigned_abs();
        ((across * across) << 40).checked_div(square).map_or(0, |square| square.isqrt() as u64)
    }

    /// Whether the segment meets the pixel of a point: the square of side 1 around it with its left and lower sides,
    /// but without its right and upper ones.
    pub fn meets(&self, center: Point) -> bool {
        let [a, b] = self.0;
        // Everything is doubled, so that the corners of the pixel are whole.
        let (start, along) = (vector(center, a).map(|value| 2 * value), vector(a, b).map(|value| 2 * value));
        // The shares of the segment inside: from the first on, which belongs to them, up to the last, which belongs to
        // them if it is said so.
        let (mut first, mut first_is_in): (Share, bool) = ([0, 1], true);
        let (mut last, mut last_is_in): (Share, bool) = ([1, 1], true);
        for axis in 0..2 {
            let (from, step) = (start[axis], along[axis]);
            if step == 0 {
                if !(-1..1).contains(&from) {
                    return false;
                }
                continue;
            }
            // The coordinate is -1 at one share and 1 at the other.
            let (low, high) = ([(-1 - from) * step.signum(), step.abs()], [(1 - from) * step.signum(), step.abs()]);
            let (enters, leaves, enter_is_in) = if step > 0 { (low, high, true) } else { (high, low, false) };
            if is_less(first, enters) {
                (first, first_is_in) = (enters, enter_is_in);
            } else if !is_less(enters, first) {
                first_is_in &= enter_is_in;
            }
            if is_less(leaves, last) {
                (last, last_is_in) = (leaves, !enter_is_in);
            } else if !is_less(last, leaves) {
                last_is_in &= !enter_is_in;
            }
        }
        is_less(first, last) || !is_less(last, first) && first_is_in && last_is_in
    }
}

/// Hot pixels in square cells, so that a segment finds those near it.
pub(super) struct Hot {
    /// Bits of the side of a cell.
    shift: u32,
    /// Cells in a row.
    row: usize,
    /// The end of each cell in `centers`.
    ends: Vec<u32>,
    /// The centres, cell by cell, with the lowest index at each.
    centers: Vec<(Point, u32)>,
}

impl Hot {
    /// Sorts the points, each the centre of a pixel, into about as many cells as there are points.
    pub fn of(points: &[Point]) -> Self {
        let mut distinct: Vec<(Point, u32)> = points.iter().copied().zip(0..).collect();
        distinct.sort_unstable();
        distinct.dedup_by_key(|center| center.0);
        let side = distinct.len().isqrt().max(1);
        let most = points.iter().fold(0, |most, point| most.max(point.x).max(point.y));
        let shift = (u32::BITS - most.leading_zeros()).saturating_sub(side.ilog2());
        let row = most.checked_shr(shift).unwrap_or(0) as usize + 1;
        let mut hot = Self { shift, row, ends: vec![0; row * row + 1], centers: Vec::new() };
        for (center, _) in &distinct {
            let cell = hot.cell(center.x) * row + hot.cell(center.y);
            hot.ends[cell + 1] += 1;
        }
        for place in 1..hot.ends.len() {
            hot.ends[place] += hot.ends[place - 1];
        }
        distinct.sort_by_key(|(center, _)| hot.cell(center.x) * row + hot.cell(center.y));
        hot.centers = distinct;
        hot
    }

    /// The cell of a coordinate along its axis.
    fn cell(&self, coordinate: u32) -> usize {
        (coordinate.checked_shr(self.shift).unwrap_or(0) as usize).min(self.row - 1)
    }

    /// The hot pixels that a segment meets with the indices of their points, in the order along the segment.
    pub fn met_by(&self, segment: &Segment, met: &mut Vec<(Point, u32)>) {
        met.clear();
        let widened = |coordinate: fn(Point) -> u32| {
            let (low, high) = (segment.low(coordinate), segment.high(coordinate));
            self.cell(low.saturating_sub(1))..=self.cell(high.saturating_add(1))
        };
        for column in widened(|point| point.x) {
            let [low, high] = self.rows_in(segment, column);
            let rows = widened(|point| point.y);
            for cell in low.max(*rows.start())..=high.min(*rows.end()) {
                let place = column * self.row + cell;
                let own = &self.centers[self.ends[place] as usize..self.ends[place + 1] as usize];
                met.extend(own.iter().filter(|center| segment.meets(center.0)));
            }
        }
        // The pixels that a line meets follow one another along both axes.
        let along = vector(segment.0[0], segment.0[1]);
        let rank = |&(center, _): &(Point, u32)| {
            let [x, y] = vector(segment.0[0], center);
            x * along[0].signum() + y * along[1].signum()
        };
        met.sort_unstable_by_key(rank);
    }

    /// The first and the last cell of a column near the line of a segment.
    fn rows_in(&self, segment: &Segment, column: usize) -> [usize; 2] {
        let [a, b] = segment.0;
        let [dx, dy] = vector(a, b);
        if dx == 0 || self.row == 1 {
            return [0, self.row - 1];
        }
        let height = |x: i128| i128::from(a.y) + ((x - i128::from(a.x)) * dy).div_euclid(dx);
        // A pixel reaches half a step beyond its cell.
        let (left, right) = ((column as i128) << self.shift, (column as i128 + 1) << self.shift);
        let ends = [height(left - 1), height(right + 1)];
        let cell = |y: i128| self.cell(y.clamp(0, u32::MAX.into()) as u32);
        [cell(ends[0].min(ends[1]) - 2), cell(ends[0].max(ends[1]) + 2)]
    }
}
