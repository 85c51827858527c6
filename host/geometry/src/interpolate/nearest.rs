//! The point nearest to a place, by steps to nearer neighbours.

use core::cmp::Ordering;

use super::record::{after, Record, NONE};
use crate::double::nearer_of;

/// A corner of a record.
#[derive(Clone, Copy)]
struct Vertex {
    record: u32,
    corner: usize,
}

/// The value of the nearest point; of points at one distance, that of the lowest index. In a Delaunay triangulation a
/// point that is not the nearest has a neighbour that is nearer.
pub(super) fn nearest_value(records: &[Record], start: u32, q: [f64; 2]) -> f64 {
    let mut at = Vertex { record: start, corner: 0 };
    for _ in 0..=records.len() {
        let next = nearer_neighbor(records, at, q);
        match next {
            Some(next) => at = next,
            None => break,
        }
    }
    records[at.record as usize].values[at.corner]
}

/// Compares by distance, then by index.
fn compare(records: &[Record], q: [f64; 2], one: Vertex, other: Vertex) -> Ordering {
    let place = |vertex: Vertex| records[vertex.record as usize].corners[vertex.corner];
    let id = |vertex: Vertex| records[vertex.record as usize].ids[vertex.corner];
    nearer_of(q, place(one), place(other)).then_with(|| id(one).cmp(&id(other)))
}

/// The nearest neighbour of a vertex, if it is nearer than the vertex itself.
fn nearer_neighbor(records: &[Record], vertex: Vertex, q: [f64; 2]) -> Option<Vertex> {
    let mut best = vertex;
    let mut look = |record: u32, corner: usize| {
        for corner in [after(corner), after(after(corner))] {
            let other = Vertex { record, corner };
            if compare(records, q, other, best).is_lt() {
                best = other;
            }
        }
    };
    // Around the vertex counter-clockwise, and from the beginning clockwise if the hull comes first.
    for is_left in [true, false] {
        let (mut record, mut corner) = (vertex.record, vertex.corner);
        for _ in 0..records.len() {
            look(record, corner);
            let edge = if is_left { after(after(corner)) } else { corner };
            let next = records[record as usize].behind[edge];
            if next == NONE || next == vertex.record {
                break;
            }
            let back = records[next as usize].edge_to(record);
            corner = if is_left { back } else { after(back) };
            record = next;
        }
    }
    (compare(records, q, best, vertex).is_lt()).then_some(best)
}
