//! Natural neighbours of a place, and the means of their values.
//!
//! The cavity of a place has the triangles whose circumcircle contains it. Their outer edges form a ring, whose corners
//! are the natural neighbours. A tour visits the triangles of the cavity from edge to edge; between two edges of the
//! ring that meet at a corner, it passes exactly the triangles around that corner, in order. Their circumcentres, and
//! those of the place with each of the two edges, are the corners of the region that a new cell takes from that of the
//! corner (Sibson, *A vector identity for the Dirichlet tessellation*, 1980).

use alloc::vec::Vec;

use super::large::mean_of_large;
use super::record::{after, Record, NONE};
use crate::lattice::scaled;

/// An edge of the ring as seen from the place, with its first corner and its value.
#[derive(Clone, Copy)]
struct RingEdge {
    from: [f64; 2],
    to: [f64; 2],
    /// The value of the corner at which the edge ends.
    value: f64,
    /// The circumcentres of the tour between this edge and the next, which end at this place of the list.
    centers_end: usize,
}

/// The lists that queries reuse.
#[derive(Default)]
pub(super) struct Tour {
    ring: Vec<RingEdge>,
    centers: Vec<[f64; 2]>,
    /// The end of the circumcentres before the first edge, which also belong behind those of the last.
    prefix: usize,
    /// A record, the edges of it that are left, and the next one.
    stack: Vec<(u32, u8, usize)>,
}

fn cross(one: [f64; 2], other: [f64; 2]) -> f64 {
    one[0] * other[1] - one[1] * other[0]
}

fn dot(one: [f64; 2], other: [f64; 2]) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}

fn minus(one: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    [one[0] - other[0], one[1] - other[1]]
}

/// The centre of the circle through the origin and two places.
fn center_with_origin(b: [f64; 2], c: [f64; 2]) -> [f64; 2] {
    let (twice, bb, cc) = (2.0 * cross(b, c), dot(b, b), dot(c, c));
    [(c[1] * bb - b[1] * cc) / twice, (b[0] * cc - c[0] * bb) / twice]
}

/// The centre of a circle through three places.
fn center([a, b, c]: [[f64; 2]; 3]) -> [f64; 2] {
    let [x, y] = center_with_origin(minus(b, a), minus(c, a));
    [x + a[0], y + a[1]]
}

impl Tour {
    /// Tours the cavity of a place inside a record. Returns whether the ring is complete, which it is in every
    /// triangulation.
    fn run(&mut self, records: &[Record], start: u32, q: [f64; 2], with_centers: bool) -> bool {
        self.ring.clear();
        self.centers.clear();
        self.stack.clear();
        self.enter(records, start, 0, 3, q, with_centers);
        // Three edges and a return for each record, and the end.
        let most = 4 * records.len() + 1;
        for _ in 0..most {
            let Some((at, left, k)) = self.stack.pop() else { return true };
            if left == 0 {
                // Back in the triangle before, whose next edge begins at the same corner.
                if let (Some(&(parent, ..)), true) = (self.stack.last(), with_centers) {
                    self.add_center(&records[parent as usize], q);
                }
                continue;
            }
            self.stack.push((at, left - 1, after(k)));
            let record = &records[at as usize];
            let next = record.behind[k];
            if next != NONE && records[next as usize].conflicts(q) {
                let back = records[next as usize].edge_to(at);
                self.enter(records, next, after(back), 2, q, with_centers);
            } else {
                let (from, to) = (minus(record.corners[k], q), minus(record.corners[after(k)], q));
                let value = record.values[after(k)];
                self.close();
                self.ring.push(RingEdge { from, to, value, centers_end: 0 });
                if with_centers {
                    self.add_center(record, q);
                }
            }
        }
        false
    }

    /// Ends the list of circumcentres of the last edge.
    fn close(&mut self) {
        let end = self.centers.len();
        match self.ring.last_mut() {
            Some(last) => last.centers_end = end,
            None => self.prefix = end,
        }
    }

    fn enter(&mut self, records: &[Record], at: u32, first: usize, edges: u8, q: [f64; 2], with_centers: bool) {
        self.stack.push((at, edges, first));
        if with_centers {
            self.add_center(&records[at as usize], q);
        }
    }

    fn add_center(&mut self, record: &Record, q: [f64; 2]) {
        self.centers.push(center(record.corners.map(|corner| minus(corner, q))));
    }

    /// The mean with the weights of Laplace: the length of the edge between two cells, divided by the distance of
    /// their points. It is the sum of the cotangents of the two angles that face the line between them.
    pub(super) fn laplace(&mut self, records: &[Record], start: u32, q: [f64; 2]) -> f64 {
        if !self.run(records, start, q, false) {
            return f64::NAN;
        }
        let value = self.mean_by_cotangents(|value| value);
        if value.is_finite() {
            return value;
        }
        let values = self.ring.iter().map(|edge| edge.value);
        mean_of_large(value, values, |shift| self.mean_by_cotangents(|value| scaled(value, -shift)))
    }

    /// The mean with the weights of Sibson: the areas that the cell of the place would take.
    pub(super) fn sibson(&mut self, records: &[Record], start: u32, q: [f64; 2]) -> f64 {
        if !self.run(records, start, q, true) {
            return f64::NAN;
        }
        self.centers.extend_from_within(..self.prefix);
        self.close();
        let value = self.mean_by_areas(|value| value);
        if value.is_finite() {
            return value;
        }
        let values = self.ring.iter().map(|edge| edge.value);
        mean_of_large(value, values, |shift| self.mean_by_areas(|value| scaled(value, -shift)))
    }

    /// The mean of the changed values, weighted by cotangents.
    #[inline(always)]
    fn mean_by_cotangents(&self, change: impl Fn(f64) -> f64) -> f64 {
        let cotangent = |at: [f64; 2], to: [f64; 2]| {
            let (to_q, to) = ([-at[0], -at[1]], minus(to, at));
            dot(to_q, to) / cross(to_q, to).abs()
        };
        let (mut sum, mut weights, mut base) = (0.0, 0.0, None);
        for (k, edge) in self.ring.iter().enumerate() {
            let next = self.ring[if k + 1 == self.ring.len() { 0 } else { k + 1 }];
            let weight = cotangent(edge.from, edge.to) + cotangent(next.to, edge.to);
            let value = change(edge.value);
            let base = *base.get_or_insert(value);
            sum += weight * (value - base);
            weights += weight;
        }
        base.unwrap_or(f64::NAN) + sum / weights
    }

    /// The mean of the changed values, weighted by areas.
    #[inline(always)]
    fn mean_by_areas(&self, change: impl Fn(f64) -> f64) -> f64 {
        let (mut sum, mut weights, mut base, mut begin) = (0.0, 0.0, None, self.prefix);
        for (k, edge) in self.ring.iter().enumerate() {
            let next = self.ring[if k + 1 == self.ring.len() { 0 } else { k + 1 }];
            let first = center_with_origin(edge.from, edge.to);
            let last = center_with_origin(next.from, next.to);
            let weight = area(first, &self.centers[begin..edge.centers_end], last);
            begin = edge.centers_end;
            let value = change(edge.value);
            let base = *base.get_or_insert(value);
            sum += weight * (value - base);
            weights += weight;
        }
        base.unwrap_or(f64::NAN) + sum / weights
    }
}

/// Twice the area of a polygon: its first corner, others, and its last one.
fn area(first: [f64; 2], others: &[[f64; 2]], last: [f64; 2]) -> f64 {
    let (mut twice, mut from) = (0.0, minus(last, first));
    // Seen from the first corner, the edges at it span nothing.
    for &place in others.iter().rev() {
        let to = minus(place, first);
        twice += cross(from, to);
        from = to;
    }
    twice
}
