//! The validator's way to points near a place: squares of equal size with the points in each.

use alloc::vec;
use alloc::vec::Vec;

use super::exact::ExactPoint;

/// The points at some indices, in squares. All roundings keep the order of coordinates, so that a point between two
/// others lies in a column or row between theirs, too.
pub(super) struct Buckets<P> {
    /// Points with the smallest x and with the smallest y; `None` without points.
    low: Option<[P; 2]>,
    /// Columns and rows for each unit of length.
    scale: [f64; 2],
    /// The number of columns, which is that of rows.
    side: usize,
    /// The end of each square in `members`.
    ends: Vec<usize>,
    members: Vec<u32>,
}

impl<P: ExactPoint> Buckets<P> {
    /// Sorts the points at these indices, which must exist, into squares. O(n).
    pub(super) fn of(points: &[P], indices: &[u32]) -> Self {
        let at = |index: &u32| points[*index as usize];
        let low = indices.iter().map(at).fold(None, |low: Option<[P; 2]>, point| {
            let [x, y] = low.unwrap_or([point; 2]);
            let is_lower = |other: P, axis: usize| point.offset(&other)[axis] < 0.0;
            Some([if is_lower(x, 0) { point } else { x }, if is_lower(y, 1) { point } else { y }])
        });
        let side = (1..).take_while(|side| side * side <= indices.len()).last().unwrap_or(1);
        let mut buckets = Self { low, scale: [0.0; 2], side, ends: vec![0; side * side + 1], members: vec![] };
        let span = |axis: usize| indices.iter().map(|index| buckets.offset(&at(index))[axis]).fold(0.0, f64::max);
        // A span that is zero, or too large for doubles, makes a single column.
        let scale = |span: f64| Some(side as f64 / span).filter(|scale| scale.is_finite()).unwrap_or(0.0);
        buckets.scale = [scale(span(0)), scale(span(1))];
        let squares: Vec<usize> = indices.iter().map(|index| buckets.square(&at(index))).collect();
        squares.iter().for_each(|&square| buckets.ends[square + 1] += 1);
        for square in 1..buckets.ends.len() {
            buckets.ends[square] += buckets.ends[square - 1];
        }
        buckets.members = vec![0; indices.len()];
        for (&index, &square) in indices.iter().zip(&squares) {
            buckets.members[buckets.ends[square]] = index;
            buckets.ends[square] += 1;
        }
        buckets
    }

    /// The vector from the corner of all squares to a point.
    fn offset(&self, point: &P) -> [f64; 2] {
        self.low.map_or([0.0; 2], |[x, y]| [point.offset(&x)[0], point.offset(&y)[1]])
    }

    /// A point in units of squares.
    fn place(&self, point: &P) -> [f64; 2] {
        let offset = self.offset(point);
        [0, 1].map(|axis| if self.scale[axis] == 0.0 { 0.0 } else { offset[axis] * self.scale[axis] })
    }

    /// The column or row of a coordinate in units of squares. Conversions saturate.
    fn cell(&self, value: f64) -> usize {
        (value as usize).min(self.side - 1)
    }

    fn square(&self, point: &P) -> usize {
        let [x, y] = self.place(point);
        self.cell(x) * self.side + self.cell(y)
    }

    /// The points of a column in the rows from one to another.
    fn in_column(&self, column: usize, rows: [usize; 2]) -> &[u32] {
        let first = column * self.side + rows[0];
        let begin = first.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.members[begin..self.ends[column * self.side + rows[1]]]
    }

    /// Calls `take` with all points in the rectangle around some points, and perhaps with others.
    pub(super) fn around(&self, corners: [P; 3], mut take: impl FnMut(u32)) {
        let places = corners.map(|corner| self.place(&corner));
        let bound =
            |axis: usize, pick: fn(f64, f64) -> f64| places.iter().map(|place| place[axis]).fold(places[0][axis], pick);
        let rows = [self.cell(bound(1, f64::min)), self.cell(bound(1, f64::max))];
        for column in self.cell(bound(0, f64::min))..=self.cell(bound(0, f64::max)) {
            self.in_column(column, rows).iter().for_each(|&index| take(index));
        }
    }
}
