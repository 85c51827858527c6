//! The consequences of the visits of a deletion: the walk to the vertex, two chains of visits round its star, and the
//! tests that fill the hole.
//!
//! Hardware twin: the blocks `NamedVertex`, `StarCase` and `StarStep`.
//!
//! A visit has its place in `entry`: the root has place 0, the chain to the left goes on to 1, 2, ..., that to the
//! right to -1, -2, ..., in six bits. The record outside has the place of the record of the star.

use super::hole::{last_edge, Hole};
use super::star::{Star, PLACES};
use crate::clock::attempt::Attempt;
use crate::clock::defect::Defect;
use crate::clock::memory::Entry;
use crate::clock::outcome::{Around, Outcome};
use crate::clock::release_job::ReleaseJob;
use crate::clock::visit::{Bundle, Completion, Visit, OUTSIDE};

/// The first visits round a vertex, from its root: to the left, outside, and to the right.
fn first_visits(root: &Completion, slot: usize) -> Bundle {
    let record = root.record.rotated(slot);
    let first = Visit {
        context: root.visit.context,
        rotates: true,
        locks: true,
        entry: 1,
        after: 0,
        cavity_entry: 0,
        cavity_record: root.visit.record,
        record: record.n[1],
    };
    Bundle::three(first, PLACES - 1, record.n[0], record.n[2])
}

impl Outcome {
    /// The consequences of a visit of a deletion.
    pub(in super::super) fn of_deletion(done: &Completion, around: &Around, star: &Star, hole: &Hole) -> Self {
        let out = Self { context: done.visit.context, ..Self::default() };
        match (done.visit.rotates, done.visit.locks) {
            (false, false) => out.walk_to_vertex(done, around),
            (false, true) => out.star_root(done, around),
            (true, true) => out.star_visit(done, around, *star),
            (true, false) if done.visit.is_last_edge() => out.last_edge_test(done, around, star),
            (true, false) => out.hole_test(done, hole),
        }
    }

    /// A walk ends at the first record that names the vertex.
    fn walk_to_vertex(mut self, done: &Completion, around: &Around) -> Self {
        if done.again || done.names.is_some() && around.is_busy(self.context) {
            return self.again(done);
        }
        self.push = Some(match done.names {
            Some(_) => Bundle::root(self.context, done.visit.record),
            // M8: a free record leads on.
            None => Bundle::look(self.context, done.walk_next),
        });
        self
    }

    /// M2: the root is visited under its lock, and must still name the vertex.
    fn star_root(mut self, done: &Completion, around: &Around) -> Self {
        let record = done.visit.record;
        if done.foreign {
            return self.foreign_root(done, around);
        }
        self.lock = Some((0, record));
        let trusted = (around.defect == Some(Defect::TrustsTheWalkToAVertex)).then_some(0);
        let Some(slot) = done.names.or(trusted) else {
            self.release = Some(ReleaseJob { context: self.context, locks: 1 });
            self.root_changed = true;
            return self.abort(done.walk_next);
        };
        let turned = done.record.rotated(slot);
        self.push = Some(first_visits(done, slot));
        self.attempt = Some(Attempt { outstanding: 3, count: 3, logged: 1, ..Attempt::default() });
        self.root = Some(record);
        let [_, a, b] = turned.v;
        let (heads, carried) = ([turned.n[2], turned.n[1]], [b, a]);
        self.star = Some(Star { heads, carried, keeps: done.keeps, ..Star::default() });
        self
    }

    fn star_visit(mut self, done: &Completion, around: &Around, mut star: Star) -> Self {
        let mut state = around.attempt;
        // M4, M5: locks are those of an insertion.
        if !self.takes_lock(done, around, &mut state) {
        } else if done.visit.is_outside_star() {
            self.note_outside(done, &mut star, around);
        } else if done.again {
            // M14: the point of the record before was torn.
            self.push = Some(Bundle::one(done.visit));
            state.outstanding += 1;
        } else {
            self.go_round(done, &mut star, &mut state, around);
        }
        let ends = match around.defect {
            Some(Defect::ReleasesBeforeDrained) => state.outstanding == 0 && !around.attempt.drains || self.aborts,
            _ => state.outstanding == 0,
        };
        if ends {
            self.end_star(&state, &star, around);
        }
        self.attempt = Some(state);
        self.star = Some(star);
        self
    }

    /// M3: the record outside is locked, and becomes an entry of the ring.
    fn note_outside(&mut self, done: &Completion, star: &mut Star, around: &Around) {
        let Completion { visit, record, slot, .. } = *done;
        let place = around.place(visit.entry);
        star.keeps &= done.keeps;
        let [is_infinite, has_infinite] = [record.v[2] == around.infinite, record.v.contains(&around.infinite)];
        if is_infinite {
            star.infinite = Some(place);
        }
        star.has_triangle_outside |= !has_infinite;
        let entry = Entry {
            first_vertex: record.v[2],
            outside_record: visit.record,
            slot,
            cavity_record: visit.cavity_record,
            after: 0,
        };
        self.entry = Some((place, entry));
    }

    /// A record of the star: the record outside is visited, and the chain goes on unless it meets the other one.
    fn go_round(&mut self, done: &Completion, star: &mut Star, state: &mut Attempt, around: &Around) {
        let Completion { visit, record, .. } = *done;
        let is_left = visit.entry < PLACES / 2;
        let (next, outside) = if is_left { (record.n[2], record.n[1]) } else { (record.n[1], record.n[2]) };
        let step = if is_left { 1 } else { PLACES - 1 };
        star.keeps &= done.keeps;
        star.carried[usize::from(is_left)] = record.v[if is_left { 2 } else { 1 }];
        let place = around.place(visit.entry);
        if is_left {
            star.last = place;
        } else {
            star.first = place;
        }
        let around_star = Visit { cavity_record: visit.record, ..visit };
        if next == star.heads[usize::from(!is_left)] {
            self.push = Some(Bundle::one(Visit { after: OUTSIDE, record: outside, ..around_star }));
            state.outstanding += 1;
        } else if state.count == around.config.ring {
            state.drains = true;
            star.is_too_long = true;
        } else {
            let first = Visit { entry: (visit.entry + step) % PLACES, after: visit.entry, record: next, ..around_star };
            self.push = Some(Bundle::pair(first, OUTSIDE, outside));
            state.outstanding += 2;
            state.count += 1;
            star.heads[usize::from(is_left)] = next;
        }
    }

    /// All visits of the star have completed.
    fn end_star(&mut self, state: &Attempt, star: &Star, around: &Around) {
        if !state.drains {
            // M12: a vertex keeps its edges inside the hull alone.
            let keeps = star.keeps || around.defect == Some(Defect::MovesWithoutLook);
            let may_keep = keeps && star.infinite.is_none() || around.stays;
            if around.moves && may_keep {
                self.push = Some(last_edge(star, self.context, around.places()));
            } else {
                self.opens_hole = Some(Hole::of(star, state, around.places()));
            }
            return;
        }
        self.sleeps = true;
        self.release = Some(ReleaseJob { context: self.context, locks: state.logged });
        if star.is_too_long {
            self.duplicate = true;
            self.returns_priority = true;
        } else {
            self.will_retry = true;
        }
    }

    /// M12: the last edge of a star that moves has been tested. If it stays, too, the point alone is written.
    fn last_edge_test(mut self, done: &Completion, around: &Around, star: &Star) -> Self {
        let state = &around.attempt;
        if done.keeps || around.stays || around.defect == Some(Defect::MovesWithoutLook) {
            (self.sleeps, self.duplicate, self.moves_in_place) = (true, true, true);
            self.returns_priority = true;
            self.release = Some(ReleaseJob { context: self.context, locks: state.logged });
        } else {
            self.opens_hole = Some(Hole::of(star, state, around.places()));
        }
        self
    }

    /// A test of four vertices of the ring has completed.
    fn hole_test(mut self, done: &Completion, hole: &Hole) -> Self {
        // M14: a test whose point was torn says nothing.
        if done.again {
            (self.push, self.tests_on) = (Some(hole.test(self.context)), Some(*hole));
            return self;
        }
        let hole = hole.tested(done.replaces);
        match hole.apex {
            Some(_) => self.opens_hole = Some(hole),
            None => {
                self.push = Some(hole.test(self.context));
                self.tests_on = Some(hole);
            }
        }
        self
    }
}
