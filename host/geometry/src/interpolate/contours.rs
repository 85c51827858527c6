//! Contour lines of the surface that is linear on triangles.
//!
//! A corner counts as above a level if its value is the level or more. A triangle with corners above and below has
//! exactly one edge that leads down, counter-clockwise, and one that leads up. The line enters across the first and
//! leaves across the second, so that higher ground lies on its left. No triangle is crossed twice at a level.

use alloc::vec::Vec;

use super::record::{after, Record, NONE};

/// A place at which a contour line crosses an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The ends of the edge, the lower index first.
    pub edge: [u32; 2],
    /// The position of the crossing along the edge: 0 at the first end, 1 at the second.
    pub share: f64,
}

impl Crossing {
    /// The coordinates of the crossing. `points` are the points of the surface, in any coordinates.
    ///
    /// # Panics
    /// If `points` are fewer than those of the surface.
    pub fn place(&self, points: &[[f64; 2]]) -> [f64; 2] {
        let [a, b] = self.edge.map(|index| points[index as usize]);
        [0, 1].map(|axis| a[axis] + self.share * (b[axis] - a[axis]))
    }
}

/// A contour line, with higher ground on its left.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// The crossings along the line. A closed line does not repeat the first at its end.
    pub crossings: Vec<Crossing>,
    /// Whether the line leads back to its beginning; an open one ends on the hull.
    pub is_closed: bool,
}

/// Whether edge `k` of a triangle leads from above the level to below, or the other way.
fn leads(record: &Record, k: usize, level: f64, down: bool) -> bool {
    let is_above = |corner: usize| record.values[corner] >= level;
    is_above(k) == down && is_above(after(k)) != down
}

/// The edge across which the line enters a triangle, or leaves it.
fn edge(record: &Record, level: f64, down: bool) -> Option<usize> {
    (0..3).find(|&k| leads(record, k, level, down))
}

fn crossing(record: &Record, k: usize, level: f64) -> Crossing {
    let other = after(k);
    let (from, to) = if record.ids[k] < record.ids[other] { (k, other) } else { (other, k) };
    let (low, high) = (record.values[from], record.values[to]);
    Crossing { edge: [record.ids[from], record.ids[to]], share: share(low, high, level).clamp(0.0, 1.0) }
}

/// The position of a level between two values, which need not be in order.
fn share(low: f64, high: f64, level: f64) -> f64 {
    if (high - low).is_finite() {
        (level - low) / (high - low)
    } else {
        // The halves of values have differences within the range of doubles.
        (level / 2.0 - low / 2.0) / (high / 2.0 - low / 2.0)
    }
}

/// The contour lines of a level: open ones first, in the order of the triangles at which they begin.
pub(super) fn contours(records: &[Record], level: f64) -> Vec<Contour> {
    let mut lines = Vec::new();
    let mut is_done = alloc::vec![false; records.len()];
    for only_open in [true, false] {
        for first in 0..records.len() {
            let Some(enters) = edge(&records[first], level, true) else { continue };
            if !is_done[first] && (!only_open || records[first].behind[enters] == NONE) {
                lines.push(follow(records, first, level, &mut is_done));
            }
        }
    }
    lines
}

/// Follows a line from the triangle that it enters first.
fn follow(records: &[Record], first: usize, level: f64, is_done: &mut [bool]) -> Contour {
    let mut crossings = Vec::new();
    let mut at = first;
    while !is_done[at] {
        is_done[at] = true;
        let record = &records[at];
        let (Some(enters), Some(leaves)) = (edge(record, level, true), edge(record, level, false)) else { break };
        crossings.push(crossing(record, enters, level));
        if record.behind[leaves] == NONE {
            crossings.push(crossing(record, leaves, level));
            return Contour { crossings, is_closed: false };
        }
        at = record.behind[leaves] as usize;
    }
    Contour { crossings, is_closed: true }
}
