//! The rules by which a visit of a question follows another, or an item ends.
//!
//! Hardware twin: the block `QuestionStep`.

use crate::clock::memory::Memory;
use crate::mesh::Record;
use crate::predicate::{orient2d, Point};
use incircle_protocol::{Located, Outcome};

/// A visit of a question.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit {
    pub context: usize,
    pub record: u32,
    /// In the search along the hull: the end of the hull edge of the ghost triangle that was visited before.
    hull_end: Option<u32>,
}

impl Visit {
    pub(super) fn walk(context: usize, record: u32) -> Self {
        Self { context, record, hull_end: None }
    }
}

/// The result of a visit: the next visit, or the end of the item with what it has found.
#[derive(Clone, Copy, Debug)]
pub(super) enum Followed {
    Visit(Visit),
    /// A visit of the search along the hull, after the walk has arrived.
    Search(Visit),
    End(Outcome, Located),
}

impl Followed {
    /// The visit that follows.
    pub(super) fn next(self) -> Option<Visit> {
        match self {
            Self::Visit(visit) | Self::Search(visit) => Some(visit),
            Self::End(..) => None,
        }
    }

    /// Whether a walk has reached the record that holds its place.
    pub(super) fn arrives(self) -> bool {
        match self {
            Self::Visit(_) => false,
            Self::Search(_) => true,
            Self::End(outcome, _) => outcome != Outcome::Outside,
        }
    }
}

/// Finds what follows the visit of this record for the place `p`.
pub(super) fn follow(visit: &Visit, record: Record, p: Point, memory: &Memory) -> Followed {
    let r = record.v.map(|v| memory.vertex(v));
    let sides = [orient2d(r[1], r[2], p), orient2d(r[2], r[0], p), orient2d(r[0], r[1], p)];
    let walk = |record: u32| Followed::Visit(Visit { record, ..*visit });
    if let Some(slot) = record.v.iter().position(|&v| v == memory.infinite) {
        // Counter-clockwise: the infinite vertex, the end of the hull edge, its start.
        let end = record.v[(slot + 1) % 3];
        let before = Visit { record: record.n[(slot + 1) % 3], hull_end: Some(end), ..*visit };
        return match (visit.hull_end, sides[slot] > 0) {
            (None, true) => Followed::Search(before),
            (Some(_), true) => Followed::Visit(before),
            (None, false) => walk(record.n[slot]),
            (Some(hull_end), false) => {
                Followed::End(Outcome::Outside, Located { vertices: [end, hull_end, 0], weights: [0; 3] })
            }
        };
    }
    let lowest = sides.into_iter().min().unwrap_or(0);
    if lowest < 0 {
        let slot = sides.iter().position(|&side| side == lowest).unwrap_or(0);
        return walk(record.n[slot]);
    }
    let mut located = Located::default();
    let mut count = 0;
    for (slot, side) in sides.into_iter().enumerate().filter(|&(_, side)| side != 0) {
        located.vertices[count] = record.v[slot];
        located.weights[count] = side.unsigned_abs();
        count += 1;
    }
    let outcome = [Outcome::Vertex, Outcome::Edge, Outcome::Triangle][count.max(1) - 1];
    Followed::End(outcome, located)
}
