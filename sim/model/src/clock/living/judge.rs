//! What a visit finds out: the predicates of a record and the points of its context.

use super::sight::Sight;
use super::visit::{Ask, Visit};
use crate::clock::memory::Memory;
use crate::mesh::Record;
use crate::predicate::{dot, finite_conflict, ghost_conflict, orient2d, Point};

/// The results of the predicates for a record.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Verdict {
    /// Whether the record is free, and its links lead on.
    pub is_free: bool,
    /// Slot of the infinite vertex in a ghost triangle.
    pub ghost: Option<usize>,
    /// Whether the record conflicts with the point: of a test of corners, whether the other vertex replaces the apex.
    pub conflict: bool,
    /// Whether the record holds the place.
    pub holds: bool,
    /// Slot of the corner that has the point.
    pub corner: Option<usize>,
    /// The record at which a walk goes on.
    pub next: u32,
    /// The three orient2d of the place with the edges of the record.
    pub sides: [i64; 3],
    /// Whether the vertex that moves keeps its edges, as far as this visit can tell.
    pub keeps: bool,
    /// Slot of the corner nearest to the place, and whether each of the two spokes at it, that to the next corner
    /// first, is more than 90 degrees past the place.
    pub nearest: usize,
    pub passes: [bool; 2],
}

/// Distance and point, by which corners are compared.
type Nearness = (u64, Point);

/// The distance of a point, and the point for ties.
fn nearness(q: Point, place: Point) -> Nearness {
    let (x, y) = (u64::from(q.x.abs_diff(place.x)), u64::from(q.y.abs_diff(place.y)));
    (x * x + y * y, q)
}

/// Evaluates the predicates of a visit.
pub(super) fn judge(visit: &Visit, record: &Record, sight: &Sight, memory: &Memory) -> Verdict {
    match visit.ask {
        Ask::Corners { corners, other } => of_corners(corners, other, sight, memory),
        _ if record.v == [memory.infinite; 3] => Verdict { is_free: true, next: record.n[0], ..Verdict::default() },
        Ask::Star { left, carried } => of_star(record, left, carried, sight, memory),
        Ask::Test { .. } | Ask::Outside { .. } => of_record(record, sight.to, memory),
        _ => of_place(record, sight, memory),
    }
}

/// Ghost slot, conflict, sides and next step for a point.
fn of_record(record: &Record, p: Point, memory: &Memory) -> Verdict {
    let r = record.v.map(|v| memory.vertex(v));
    let sides = [orient2d(r[1], r[2], p), orient2d(r[2], r[0], p), orient2d(r[0], r[1], p)];
    let ghost = record.v.iter().position(|&v| v == memory.infinite);
    let corner = (0..3).find(|&k| Some(k) != ghost && r[k] == p);
    let first_two = usize::from(sides[1] < sides[0]);
    let lowest = if sides[2] < sides[first_two] { 2 } else { first_two };
    let (conflict, holds, next) = match ghost {
        Some(g) => (ghost_conflict(r[(g + 1) % 3], r[(g + 2) % 3], p), sides[g] > 0, record.n[g]),
        None => (corner.is_none() && finite_conflict(r, p), sides[lowest] >= 0, record.n[lowest]),
    };
    Verdict { ghost, conflict, holds, corner, next, sides, ..Verdict::default() }
}

/// What a walk, a root visit and a visit around the nearest vertex ask for.
fn of_place(record: &Record, sight: &Sight, memory: &Memory) -> Verdict {
    let verdict = of_record(record, sight.place, memory);
    let r = record.v.map(|v| memory.vertex(v));
    let finite = (0..3).filter(|&k| Some(k) != verdict.ghost);
    let by_point = |&k: &usize| nearness(r[k], sight.place);
    let by_number = |&k: &usize| (nearness(r[k], sight.place).0, record.v[k]);
    let nearest = if sight.by_number { finite.min_by_key(by_number) } else { finite.min_by_key(by_point) };
    let nearest = nearest.unwrap_or(0);
    let center = r[nearest];
    let passes = [1, 2].map(|step| {
        let (far, p) = ((nearest + step) % 3, sight.place);
        let turn = orient2d(center, r[far], p);
        let leaves = if step == 2 { turn <= 0 } else { turn >= 0 };
        Some(far) != verdict.ghost && dot(center, r[far], p) <= 0 && leaves
    });
    Verdict { nearest, passes, ..verdict }
}

/// Whether the vertex of the star keeps its edges at its new place: the triangle still turns left, and the edge to the
/// record before stays.
fn of_star(record: &Record, left: bool, carried: u32, sight: &Sight, memory: &Memory) -> Verdict {
    let slot = record.v.iter().position(|&v| v == sight.vertex).unwrap_or(0);
    let [_, a, b] = record.rotated(slot).v;
    let [before, at, next] = if left { [carried, a, b] } else { [a, b, carried] };
    let is_finite = [before, at, next].iter().all(|&v| v != memory.infinite);
    let keeps = is_finite && orient2d(sight.to, memory.vertex(a), memory.vertex(b)) > 0;
    Verdict { keeps: keeps && keeps_edge([before, at, next], sight.to, memory), ..Verdict::default() }
}

/// Whether the edge from a new place to the middle one of three neighbours stays.
fn keeps_edge([before, at, next]: [u32; 3], to: Point, memory: &Memory) -> bool {
    !finite_conflict([to, memory.vertex(before), memory.vertex(at)], memory.vertex(next))
}

/// Whether `other` is a better apex over the edge of the first two corners than the third; of a move, whether the last
/// edge of the star stays.
fn of_corners(corners: [u32; 3], other: u32, sight: &Sight, memory: &Memory) -> Verdict {
    if other == sight.vertex {
        return Verdict { keeps: keeps_edge(corners, sight.to, memory), ..Verdict::default() };
    }
    let [a, b] = [corners[0], corners[1]].map(|v| memory.vertex(v));
    let left = |v: u32| Some(memory.vertex(v)).filter(|&p| v != memory.infinite && orient2d(a, b, p) > 0);
    let conflict = match (left(corners[2]), left(other)) {
        (Some(best), Some(other)) => finite_conflict([a, b, best], other),
        (None, Some(_)) => true,
        // The infinite vertex is an apex where no vertex lies to the left.
        (None, None) => other == memory.infinite,
        (Some(_), None) => false,
    };
    Verdict { conflict, ..Verdict::default() }
}
