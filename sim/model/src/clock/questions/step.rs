//! The rules by which a visit of a question follows another, or an item ends.
//!
//! Hardware twin: the block `QuestionStep`.

use super::near::{Near, Search, Step};
use super::visits::{Aim, Bundle, Visit};
use crate::clock::memory::Memory;
use crate::mesh::Record;
use crate::predicate::{orient2d, Point};
use incircle_protocol::{Located, Outcome, RunKind};

/// The result of a visit: the visits that follow, or the end of the item with what it has found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Followed {
    pub visits: Bundle,
    pub end: Option<(Outcome, Located)>,
    /// Whether a walk has reached the record that holds its place.
    pub arrives: bool,
}

impl Followed {
    fn visit(visit: Visit) -> Self {
        Self { visits: Bundle::one(visit), end: None, arrives: false }
    }

    fn end(outcome: Outcome, located: Located) -> Self {
        Self { visits: Bundle::default(), end: Some((outcome, located)), arrives: false }
    }

    fn of(step: Step) -> Self {
        match step {
            Step::Visits(visits) => Self { visits, end: None, arrives: false },
            Step::Found(vertex) => Self::end(Outcome::Vertex, Located { vertices: [vertex, 0, 0], weights: [0; 3] }),
        }
    }

    fn arrived(self) -> Self {
        Self { arrives: true, ..self }
    }
}

/// Finds what follows the visit of this record for the place `p` in a run of this kind.
pub(super) fn follow(
    kind: RunKind,
    visit: &Visit,
    record: Record,
    p: Point,
    search: &mut Search,
    memory: &Memory,
) -> Followed {
    match visit.aim {
        Aim::Around { left, parity } => {
            let near = Near::of(&record, p, memory);
            Followed::of(search.follow(visit, &record, &near, left, parity))
        }
        Aim::Look => Followed::of(search.begin(visit, &record, &Near::of(&record, p, memory))),
        Aim::Hull { end } => follow_hull(visit, &record, p, end, memory),
        Aim::Walk => match walk(&record, p, memory) {
            Some(next) => Followed::visit(Visit::walk(visit.context, next)),
            None if kind == RunKind::Nearest => {
                Followed::of(search.begin(visit, &record, &Near::of(&record, p, memory))).arrived()
            }
            None => arrive(visit, &record, p, memory).arrived(),
        },
    }
}

/// The three orient2d of a place with the sides of a record.
fn sides(record: &Record, p: Point, memory: &Memory) -> [i64; 3] {
    let r = record.v.map(|v| memory.vertex(v));
    [orient2d(r[1], r[2], p), orient2d(r[2], r[0], p), orient2d(r[0], r[1], p)]
}

fn ghost_slot(record: &Record, memory: &Memory) -> Option<usize> {
    record.v.iter().position(|&v| v == memory.infinite)
}

/// The next record of a walk, or `None` if this record holds the place.
fn walk(record: &Record, p: Point, memory: &Memory) -> Option<u32> {
    // M8: a free record leads on.
    if record.v == [memory.infinite; 3] {
        return Some(record.n[0]);
    }
    let sides = sides(record, p, memory);
    if let Some(slot) = ghost_slot(record, memory) {
        return Some(record.n[slot]).filter(|_| sides[slot] <= 0);
    }
    let lowest = sides.into_iter().min().unwrap_or(0);
    let slot = sides.iter().position(|&side| side == lowest).unwrap_or(0);
    Some(record.n[slot]).filter(|_| lowest < 0)
}

/// The walk of a `Locate` or `Interpolate` has reached the record that holds its place.
fn arrive(visit: &Visit, record: &Record, p: Point, memory: &Memory) -> Followed {
    if let Some(slot) = ghost_slot(record, memory) {
        return Followed::visit(hull_before(visit, record, slot));
    }
    let mut located = Located::default();
    let mut count = 0;
    for (slot, side) in sides(record, p, memory).into_iter().enumerate().filter(|&(_, side)| side != 0) {
        located.vertices[count] = record.v[slot];
        located.weights[count] = side.unsigned_abs();
        count += 1;
    }
    let outcome = [Outcome::Vertex, Outcome::Edge, Outcome::Triangle][count.max(1) - 1];
    Followed::end(outcome, located)
}

/// The ghost triangle before one that sees the place has been visited.
fn follow_hull(visit: &Visit, record: &Record, p: Point, hull_end: u32, memory: &Memory) -> Followed {
    let slot = ghost_slot(record, memory).unwrap_or(0);
    if sides(record, p, memory)[slot] > 0 {
        return Followed::visit(hull_before(visit, record, slot));
    }
    let vertices = [record.v[(slot + 1) % 3], hull_end, 0];
    Followed::end(Outcome::Outside, Located { vertices, weights: [0; 3] })
}

/// The visit of the ghost triangle before one on the hull. Counter-clockwise, a ghost triangle has the infinite vertex,
/// the end of the hull edge, its start.
fn hull_before(visit: &Visit, record: &Record, slot: usize) -> Visit {
    let far = (slot + 1) % 3;
    Visit { record: record.n[far], aim: Aim::Hull { end: record.v[far] }, ..*visit }
}
