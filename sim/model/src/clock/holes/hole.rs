//! The hole that the star of a deleted vertex leaves. It is filled interval by interval: the triangle on the base of an
//! interval of the ring, from its end to its beginning, has its apex at a vertex between them, and parts the interval
//! in two.
//!
//! The infinite vertex, if the ring has it, ends the first interval. So it is an end of the base and never an apex. On
//! such a base stands a ghost triangle, and its apex is found by the same test: whether a triangle or ghost triangle
//! conflicts with a point.
//!
//! Each vertex but the ends of the first interval is the apex of one triangle, and that triangle takes the id of the
//! star's record on the ring edge that begins at the apex. The ids of the two ends become free.

use super::star::Star;
use super::star::PLACES;
use crate::clock::attempt::Attempt;
use crate::clock::memory::Memory;
use crate::clock::visit::{Bundle, Completion, Visit, LAST_EDGE};
use crate::predicate::{finite_conflict, ghost_conflict, orient2d, Point};

/// The other side of the base of an interval.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in super::super) enum Base {
    /// The ring edge that begins at the end of the interval.
    #[default]
    Ring,
    /// The triangle with its apex at the end of the interval, or at its beginning.
    End,
    Beginning,
}

#[derive(Clone, Copy, Debug, Default)]
pub(in super::super) struct Hole {
    /// The interval of places that is being filled, and the other side of its base.
    pub i: usize,
    pub j: usize,
    pub base: Base,
    /// The best apex so far, and the vertex that is tested against it.
    best: usize,
    challenger: usize,
    /// The apex, once it is known.
    pub apex: Option<usize>,
    /// The end of the first interval.
    pub end: usize,
    /// First and last place of the ring, and the number of places of the list.
    first: usize,
    last: usize,
    places: usize,
    /// Number of intervals that wait, at most 14 in a ring of 32: each has two of the 30 vertices between its ends, an
    /// apex and one behind it, and the interval at work has one.
    pub depth: usize,
    /// Whether nothing may be written, since perhaps no triangle is left.
    pub is_dry: bool,
    /// Number of locks of the attempt.
    pub locks: u32,
    /// Whether the hole has just opened.
    pub(super) is_new: bool,
}

impl Hole {
    /// The hole inside a ring that is complete.
    pub(super) fn of(star: &Star, state: &Attempt, places: usize) -> Self {
        let end = star.infinite.unwrap_or(star.last);
        let is_dry = star.infinite.is_some() && !star.has_triangle_outside;
        let hole = Self {
            first: star.first,
            last: star.last,
            places,
            end,
            is_dry,
            locks: state.logged,
            is_new: true,
            ..Self::default()
        };
        hole.whole()
    }

    /// The same hole with nothing filled, for which records may be written.
    pub(super) fn wet(self) -> Self {
        Self { is_dry: false, ..self }.whole()
    }

    /// The same hole with nothing filled.
    fn whole(self) -> Self {
        Self { depth: 0, ..self }.interval(self.next(self.end), self.end, Base::Ring)
    }

    /// The same hole when its first test is known.
    pub(super) fn looked_at(self) -> Self {
        Self { is_new: false, ..self }
    }

    /// The place after one.
    pub(super) fn next(&self, place: usize) -> usize {
        if place == self.last {
            self.first
        } else {
            (place + 1) % self.places
        }
    }

    /// The same hole with this interval. If it has one vertex between its ends, that is the apex.
    pub(super) fn interval(self, i: usize, j: usize, base: Base) -> Self {
        let best = self.next(i);
        let challenger = self.next(best);
        let apex = (challenger == j).then_some(best);
        Self { i, j, base, best, challenger, apex, ..self }
    }

    /// The hole after the test of the challenger.
    pub(super) fn tested(self, replaces: bool) -> Self {
        let best = if replaces { self.challenger } else { self.best };
        let challenger = self.next(self.challenger);
        Self { best, challenger, apex: (challenger == self.j).then_some(best), ..self }
    }

    /// The visit that tests the challenger. It reads no record.
    pub(super) fn test(&self, context: usize) -> Bundle {
        Bundle::one(Visit {
            context,
            rotates: true,
            locks: false,
            entry: self.i,
            after: self.j,
            cavity_entry: self.best,
            cavity_record: self.challenger as u32,
            record: 0,
        })
    }
}

/// The test of the edge at which the chains round a star have met.
pub(super) fn last_edge(star: &Star, context: usize, places: usize) -> Bundle {
    let hole = Hole { first: star.first, last: star.last, places, ..Hole::default() };
    Bundle::one(Visit {
        context,
        rotates: true,
        locks: false,
        entry: star.first,
        after: star.last,
        cavity_entry: hole.next(star.first),
        cavity_record: LAST_EDGE,
        record: 0,
    })
}

/// Whether the challenger of a test replaces the best apex.
pub(in super::super) fn replaces(visit: &Visit, memory: &Memory) -> bool {
    let entries = &memory.entries[visit.context];
    let places = [visit.after, visit.entry, visit.cavity_entry, visit.cavity_record as usize];
    let v = places.map(|place| entries[place].first_vertex);
    let [a, b, best, challenger] = v.map(|v| memory.vertex(v));
    if v[0] == memory.infinite {
        return ghost_conflict(b, best, challenger);
    }
    let is_left = |p| orient2d(a, b, p) > 0;
    is_left(challenger) && (!is_left(best) || finite_conflict([a, b, best], challenger))
}

/// Whether a vertex keeps its edges at its new place `p`, as far as one visit can tell.
///
/// At the root, its triangle must still turn left. At a record of the star, the triangle must turn left and the edge to
/// the record before must stay. A record outside must not conflict with the place. The last visit tests the edge at
/// which the two chains have met.
pub(in super::super) fn keeps_edges(done: &Completion, p: Point, memory: &Memory) -> bool {
    let Completion { visit, record, .. } = *done;
    let at = |v: u32| memory.vertex(v);
    let entries = &memory.entries[visit.context];
    let turns = |slot: usize| orient2d(at(record.v[(slot + 1) % 3]), at(record.v[(slot + 2) % 3]), p) > 0;
    // The edge to the middle one of three neighbours stays unless they turn left and the circle leaves the place out.
    let stays = |v: [u32; 3]| {
        let r = v.map(at);
        orient2d(r[0], r[1], r[2]) <= 0 || finite_conflict(r, p)
    };
    if visit.is_last_edge() {
        return stays([visit.after, visit.entry, visit.cavity_entry].map(|place| entries[place].first_vertex));
    }
    if !visit.rotates {
        return done.names.is_some_and(turns);
    }
    if visit.is_outside_star() {
        return !done.conflict;
    }
    let is_left = visit.entry < PLACES / 2;
    let slot = if is_left { 1 } else { 2 };
    let mut across = record.v;
    across[slot] = memory.carried[visit.context][usize::from(is_left)];
    turns(slot) && stays(across)
}
