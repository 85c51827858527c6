//! The triangles of a surface, each with all that a query needs, in the order of a curve through the plane.

use alloc::vec::Vec;

use super::error::Error;
use crate::double::{incircle, orient2d};
use crate::edges::EdgeList;
use crate::order::hilbert;
use crate::point::Point;

/// Marks that there is no triangle behind an edge.
pub(super) const NONE: u32 = u32::MAX;

/// A triangle. Its edge `k` leads from corner `k` to the next one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record {
    /// The corners, counter-clockwise.
    pub(super) corners: [[f64; 2]; 3],
    /// The values of the corners.
    pub(super) values: [f64; 3],
    /// The indices of the corners.
    pub(super) ids: [u32; 3],
    /// The record behind each edge; [`NONE`] on the hull.
    pub(super) behind: [u32; 3],
}

/// The corner after this one.
#[inline(always)]
pub(super) fn after(k: usize) -> usize {
    if k == 2 {
        0
    } else {
        k + 1
    }
}

impl Record {
    /// The edge behind which the record of this number lies.
    #[inline(always)]
    pub(super) fn edge_to(&self, record: u32) -> usize {
        (0..3).find(|&k| self.behind[k] == record).unwrap_or(0)
    }

    /// Whether a place lies strictly inside the circumcircle.
    #[inline(always)]
    pub(super) fn conflicts(&self, q: [f64; 2]) -> bool {
        let [a, b, c] = self.corners;
        incircle(a, b, c, q).is_gt()
    }
}

/// The records of a triangulation. O(n).
pub(super) fn records(points: &[[f64; 2]], triangles: &[[u32; 3]], values: &[f64]) -> Result<Vec<Record>, Error> {
    if triangles.is_empty() {
        return Err(Error::NoTriangle);
    }
    if points.len() != values.len() {
        return Err(Error::Values { points: points.len(), values: values.len() });
    }
    let mut named = triangles.iter().flatten();
    if let Some(&index) = named.find(|&&index| index as usize >= points.len()) {
        return Err(Error::NoSuchPoint { index, points: points.len() });
    }
    let corners_of = |triangle: &[u32; 3]| triangle.map(|index| points[index as usize]);
    let is_wrong = |triangle: &[u32; 3]| {
        let [a, b, c] = corners_of(triangle);
        let is_finite = [a, b, c].iter().flatten().all(|value| value.is_finite());
        !is_finite || !orient2d(a, b, c).is_gt()
    };
    if let Some(triangle) = triangles.iter().position(is_wrong) {
        return Err(Error::NotCounterClockwise { triangle });
    }
    let order = along_curve(triangles, corners_of);
    let mut places = alloc::vec![0u32; triangles.len()];
    order.iter().enumerate().for_each(|(place, &triangle)| places[triangle as usize] = place as u32);
    let record = |&triangle: &u32| {
        let ids = triangles[triangle as usize];
        let values = ids.map(|index| values[index as usize]);
        Record { corners: corners_of(&ids), values, ids, behind: [NONE; 3] }
    };
    let mut records: Vec<Record> = order.iter().map(record).collect();
    for [one, other] in EdgeList::of(triangles).pairs() {
        let (a, b) = (places[(one / 3) as usize], places[(other / 3) as usize]);
        records[a as usize].behind[(one % 3) as usize] = b;
        records[b as usize].behind[(other % 3) as usize] = a;
    }
    Ok(records)
}

/// The order of triangles along the curve of their first corners' places in 2^16 by 2^16 squares.
fn along_curve(triangles: &[[u32; 3]], corners_of: impl Fn(&[u32; 3]) -> [[f64; 2]; 3]) -> Vec<u32> {
    let middle = |triangle: &[u32; 3]| {
        let [a, b, c] = corners_of(triangle);
        // Thirds first, so that no sum overflows.
        [0, 1].map(|axis| a[axis] / 3.0 + b[axis] / 3.0 + c[axis] / 3.0)
    };
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for place in triangles.iter().map(middle) {
        for axis in 0..2 {
            (low[axis], high[axis]) = (low[axis].min(place[axis]), high[axis].max(place[axis]));
        }
    }
    let square = |triangle: &[u32; 3]| {
        let place = middle(triangle);
        let [x, y] = [0, 1].map(|axis| {
            let share = (place[axis] / 2.0 - low[axis] / 2.0) / (high[axis] / 2.0 - low[axis] / 2.0);
            // The conversion cuts off at both ends, and makes zero of what is not a number.
            (share * 65535.0) as u32
        });
        Point::new(x, y)
    };
    let squares: Vec<Point> = triangles.iter().map(square).collect();
    hilbert(&squares)
}
