//! The point nearest to a place, by steps to nearer neighbours.

use alloc::collections::BTreeSet;
use alloc::vec;
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
    let first = lowest_of_tied(records, at, q);
    records[first.record as usize].values[first.corner]
}

/// The vertex with the lowest index among a nearest one and those at the same distance. These lie on an empty circle
/// around the place, so each is joined to another of them by an edge.
fn lowest_of_tied(records: &[Record], nearest: Vertex, q: [f64; 2]) -> Vertex {
    let id = |vertex: Vertex| records[vertex.record as usize].ids[vertex.corner];
    let place = |vertex: Vertex| records[vertex.record as usize].corners[vertex.corner];
    let mut tied = vec![nearest];
    let mut known = BTreeSet::from([id(nearest)]);
    let mut looked = 0;
    while let Some(&vertex) = tied.get(looked) {
        looked += 1;
        each_neighbor(records, vertex, |other| {
            if nearer_of(q, place(other), place(nearest)).is_eq() && known.insert(id(other)) {
                tied.push(other);
            }
        });
    }
    tied.into_iter().min_by_key(|&vertex| id(vertex)).unwrap_or(nearest)
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
    each_neighbor(records, vertex, |other| {
        if compare(records, q, other, best).is_lt() {
            best = other;
        }
    });
    (compare(records, q, best, vertex).is_lt()).then_some(best)
}

/// Calls `look` with all neighbours of a vertex, some of them twice.
fn each_neighbor(records: &[Record], vertex: Vertex, mut look: impl FnMut(Vertex)) {
    // Around the vertex counter-clockwise, and from the beginning clockwise if the hull comes first.
    for is_left in [true, false] {
        let (mut record, mut corner) = (vertex.record, vertex.corner);
        for _ in 0..records.len() {
            look(Vertex { record, corner: after(corner) });
            look(Vertex { record, corner: after(after(corner)) });
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
}
