//! Squares over the plane, each with a triangle near its middle, at which walks begin.

use alloc::vec::Vec;

use super::record::Record;

/// Triangles for each bucket.
const TRIANGLES: usize = 1;
/// The most buckets to a side.
const MOST: usize = 1 << 13;

/// A grid of buckets over the box of the points.
#[derive(Clone, Debug)]
pub(super) struct Buckets {
    low: [f64; 2],
    /// Buckets in a unit of length.
    scale: [f64; 2],
    side: usize,
    starts: Vec<u32>,
}

impl Buckets {
    /// The buckets of records; each starts at its first record along the curve, or at one of a bucket nearby.
    pub(super) fn of(records: &[Record]) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for corner in records.iter().flat_map(|record| record.corners) {
            for axis in 0..2 {
                (low[axis], high[axis]) = (low[axis].min(corner[axis]), high[axis].max(corner[axis]));
            }
        }
        let mut side = 1;
        while side < MOST && side * side * TRIANGLES < records.len() {
            side *= 2;
        }
        let scale = [0, 1].map(|axis| {
            let scale = side as f64 / (high[axis] - low[axis]);
            if scale.is_finite() {
                scale
            } else {
                0.0
            }
        });
        let mut buckets = Self { low, scale, side, starts: alloc::vec![u32::MAX; side * side] };
        for (number, record) in records.iter().enumerate() {
            let [a, b, c] = record.corners;
            let bucket = buckets.bucket([0, 1].map(|axis| a[axis] / 3.0 + b[axis] / 3.0 + c[axis] / 3.0));
            buckets.starts[bucket] = buckets.starts[bucket].min(number as u32);
        }
        buckets.fill();
        buckets
    }

    /// Gives empty buckets the start of a neighbour: left, then below, then from the other end.
    fn fill(&mut self) {
        let side = self.side;
        for row in self.starts.chunks_mut(side) {
            let mut known = u32::MAX;
            row.iter_mut().for_each(|start| known = take(start, known));
            row.iter_mut().rev().for_each(|start| known = take(start, known));
        }
        for column in 0..side {
            let mut known = u32::MAX;
            (0..side).for_each(|row| known = take(&mut self.starts[row * side + column], known));
            (0..side).rev().for_each(|row| known = take(&mut self.starts[row * side + column], known));
        }
    }

    fn bucket(&self, q: [f64; 2]) -> usize {
        let [x, y] = [0, 1].map(|axis| {
            // The conversion cuts off at zero.
            (((q[axis] - self.low[axis]) * self.scale[axis]) as usize).min(self.side - 1)
        });
        y * self.side + x
    }

    /// The number of the bucket of a place, row by row.
    pub(super) fn number(&self, q: [f64; 2]) -> u32 {
        // There are at most 2^26 buckets.
        self.bucket(q) as u32
    }

    /// Whether the buckets of two places are at most a few rows and columns apart.
    pub(super) fn are_near(&self, one: [f64; 2], other: [f64; 2]) -> bool {
        const FEW: usize = 8;
        let (one, other) = (self.bucket(one), self.bucket(other));
        let apart = |one: usize, other: usize| one.abs_diff(other) <= FEW;
        apart(one / self.side, other / self.side) && apart(one % self.side, other % self.side)
    }

    /// The record at which the walk to a place begins.
    #[inline]
    pub(super) fn start(&self, q: [f64; 2]) -> u32 {
        self.starts[self.bucket(q)]
    }
}

/// Fills an empty bucket with what is known, and returns what is known behind it.
fn take(start: &mut u32, known: u32) -> u32 {
    if *start == u32::MAX {
        *start = known;
    }
    *start
}
