//! The search for the vertex nearest to a place. From a corner of a record two chains of visits go round the corner,
//! one each way, until there are no more spokes that make an angle of less than 90 degrees with the direction to the
//! place. A nearer vertex becomes the centre.
//!
//! Hardware twin: the blocks `NearLogic` and `NearSearch`.

use super::visits::{Aim, Bundle, Visit};
use crate::clock::memory::Memory;
use crate::mesh::Record;
use crate::predicate::{dot, orient2d, Point};

/// The corner of a record nearest to the place, and where a search round it goes on. Of each pair, the first is that of
/// the chain to the right, which leaves the record across the spoke to the next corner. The chain to the left leaves
/// across the spoke to the corner before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub slot: usize,
    /// Whether a chain begins in the record if the search does.
    begins: [bool; 2],
    /// Whether a chain that has come to the record goes on.
    goes_on: [bool; 2],
}

impl Near {
    /// Looks at a record. A spoke to the infinite vertex has no direction: it lies between two hull edges that are
    /// 180 degrees apart or more.
    pub(super) fn of(record: &Record, p: Point, memory: &Memory) -> Self {
        let r = record.v.map(|v| memory.vertex(v));
        let is_finite = |slot: usize| record.v[slot] != memory.infinite;
        let by_point = |&slot: &usize| (dot(p, r[slot], r[slot]), r[slot]);
        let slot = (0..3).filter(|&slot| is_finite(slot)).min_by_key(by_point).unwrap_or(0);
        let [next, before] = [(slot + 1) % 3, (slot + 2) % 3];
        let [finite_next, finite_before] = [next, before].map(is_finite);
        let [turn_next, turn_before] = [next, before].map(|far| orient2d(r[slot], r[far], p));
        let [behind_next, behind_before] = [next, before].map(|far| dot(r[slot], r[far], p) <= 0);
        let past = [finite_next && behind_next && turn_next >= 0, finite_before && behind_before && turn_before <= 0];
        // The direction away from the place lies in the record: a chain that has come here has seen all spokes of its
        // half. A search that begins here goes round once, to the left.
        let is_behind = finite_next && finite_before && turn_next < 0 && turn_before > 0;
        // The same for a record at the hull, which a chain enters or leaves across the infinite spoke.
        let leaves_hull = [!finite_next && turn_before >= 0, !finite_before && turn_next <= 0];
        let enters_hull = [!finite_before && turn_next < 0, !finite_next && turn_before > 0];
        let begins = [!(past[0] || leaves_hull[0] || is_behind), !(past[1] || leaves_hull[1])];
        let goes_on = [0, 1].map(|way| !(past[way] || leaves_hull[way] || enters_hull[way] || is_behind));
        Self { slot, begins, goes_on }
    }
}

/// The search of a context.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Search {
    /// Changes with each new centre. A visit of another parity looked for the centre before, and counts no more.
    parity: bool,
    /// Whether a visit of the chain to the right, and of that to the left, is in flight.
    goes: [bool; 2],
}

/// The result of a visit of a search.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// The visits that follow, none if another visit of the context is in flight.
    Visits(Bundle),
    /// The vertex is the nearest.
    Found(u32),
}

impl Search {
    /// The walk has ended in this record.
    pub(super) fn begin(&mut self, visit: &Visit, record: &Record, near: &Near) -> Step {
        *self = Self::default();
        self.go_round(visit, record, near)
    }

    /// A visit of a chain has completed.
    pub(super) fn follow(&mut self, visit: &Visit, record: &Record, near: &Near, left: bool, parity: bool) -> Step {
        if parity != self.parity {
            return Step::Visits(Bundle::default());
        }
        // The record is entered across the edge opposite the corner that is new, and the centre is at that edge.
        let slot = (0..3).find(|&slot| record.n[slot] == visit.from).unwrap_or(0);
        let way = usize::from(left);
        if near.slot == slot {
            self.parity = !self.parity;
            self.goes[way] = false;
            return self.go_round(visit, record, near);
        }
        let record = record.rotated(near.slot);
        if near.goes_on[way] {
            return Step::Visits(Bundle::one(across(visit, &record, left, parity)));
        }
        self.goes[way] = false;
        match self.goes[1 - way] {
            true => Step::Visits(Bundle::default()),
            false => Step::Found(record.v[0]),
        }
    }

    /// Begins to go round the nearest corner of a record.
    fn go_round(&mut self, visit: &Visit, record: &Record, near: &Near) -> Step {
        let is_in_flight = self.goes.contains(&true);
        let turned = record.rotated(near.slot);
        self.goes = near.begins;
        let mut bundle = Bundle::default();
        for left in [true, false] {
            if near.begins[usize::from(left)] {
                bundle.add(across(visit, &turned, left, self.parity));
            }
        }
        if !bundle.is_empty() {
            return Step::Visits(bundle);
        }
        // An item ends only when none of its visits is in flight. The same visit once more comes behind them all.
        match is_in_flight {
            true => Step::Visits(Bundle::one(Visit { aim: Aim::Look, from: visit.record, ..*visit })),
            false => Step::Found(turned.v[0]),
        }
    }
}

/// The visit of a chain that leaves a record, whose centre comes first.
fn across(visit: &Visit, record: &Record, left: bool, parity: bool) -> Visit {
    let next = if left { record.n[1] } else { record.n[2] };
    Visit { context: visit.context, record: next, from: visit.record, aim: Aim::Around { left, parity } }
}
