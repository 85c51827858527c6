//! The star of a solo insertion: the star record at work, the record outside it, the visits that read both, and the
//! writes that change them.
//!
//! 1. The star record at work has the new vertex `p` in slot 0: `v = (p, a, b)`, `n = (outer, after, preceding)`.
//! 2. The second mend makes the split root the star record at work. A test without conflict makes the following star
//!    record the one at work.
//! 3. A flip turns the two records at the edge into two star records. The first, between `a` and the apex, stays at
//!    work; the second takes the id of the outside record.
//! 4. All inputs that change go into registers first, so phases and visits take effect a clock later. The context, the
//!    new vertex, the next new id and the located record stand still for longer than that.
//!
//! Latency: 2 clocks from a visit that completes to `write`; `bundle`, `tests` and `flips` come a clock earlier.

use super::solo_visit::SoloVisit;
use super::solo_writes::SoloWrites;
use super::star_state::{Beyond, SoloPhase, SoloTurn, StarTriangle};
use crate::engine::types::{Bundle, Completion, ContextId, Slot, TriangleId, Turned, Verdict, VertexId, Visit, Write};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct SoloStar {
    pub clock: Signal<In, Clock>,
    /// Reset drops the write.
    pub reset: Signal<In, Bit>,
    /// The phase of the insertion; and within the phase, the number of the record, link or write (`step`).
    pub phase: Signal<In, SoloPhase>,
    pub step: Signal<In, Bits<2>>,
    /// The context and its point.
    pub context_id: Signal<In, ContextId>,
    pub vertex: Signal<In, VertexId>,
    /// The next new id.
    pub records: Signal<In, TriangleId>,
    /// The located record: its id and its content.
    pub root_id: Signal<In, TriangleId>,
    pub root: Signal<In, Turned>,
    /// The visit that completes in this clock.
    pub completion: Signal<In, Completion>,
    /// The visit that is due, if one is.
    pub bundle: Signal<Out, Bundle>,
    /// A test is complete; or a flip is (`flips`).
    pub tests: Signal<Out, Bit>,
    pub flips: Signal<Out, Bit>,
    /// The star record at work is the last one of the round; looked at when its test completes.
    pub is_round: Signal<Out, Bit>,
    /// A record or a link, from a register.
    pub write: Signal<Out, Write>,
    /// In a core with deletions: the second new id.
    pub own_third: Vec<Signal<In, TriangleId>>,
    done_phase: DFF<SoloPhase>,
    turn: DFF<SoloTurn>,
    ends_flip: DFF<Bit>,
    comes: DFF<Bit>,
    visited: DFF<TriangleId>,
    found: DFF<Turned>,
    is_conflict: DFF<Bit>,
    triangle: DFF<StarTriangle>,
    beyond: DFF<Beyond>,
    request: DFF<Write>,
    /// Two values that are settled long before they are used: the last star record of the round, and the second new id.
    is_last: DFF<Bit>,
    third: DFF<TriangleId>,
    visits: SoloVisit,
    writes: SoloWrites,
    visit: Signal<Local, Visit>,
    verdict: Signal<Local, Verdict>,
    rests: Signal<Local, Bit>,
    is_flipped: Signal<Local, Bit>,
    one: Signal<Local, Slot>,
    first_write: Signal<Local, Slot>,
    last_write: Signal<Local, Slot>,
    is_first: Signal<Local, Bit>,
    is_second: Signal<Local, Bit>,
    is_last_write: Signal<Local, Bit>,
    one_more: Signal<Local, TriangleId>,
}

impl SoloStar {
    /// The block of a core with deletions.
    pub fn with_deletions() -> Self {
        Self { own_third: vec![Signal::default()], ..Self::default() }
    }
}

impl Logic for SoloStar {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, done_phase, turn, ends_flip, comes, visited, found, is_conflict);
        dff_setup!(self, clock, triangle, beyond, request, is_last, third);
        self.first_write.next = 0.into();
        self.one.next = 1.into();
        self.last_write.next = 2.into();
        self.one_more.next = 1.into();
        self.visit.next = self.completion.val().visit;
        self.verdict.next = self.completion.val().verdict;
        self.is_last.d.next = self.triangle.q.val().b == self.root.val().v1;
        self.third.d.next = self.records.val() + self.one_more.val();
        for i in 0..self.own_third.len() {
            self.third.d.next = self.own_third[i].val();
        }
        self.is_round.next = self.is_last.q.val();
        self.write.next = self.request.q.val();

        self.is_first.next = self.step.val() == self.first_write.val();
        self.is_second.next = self.step.val() == self.one.val();
        self.is_last_write.next = self.step.val() == self.last_write.val();
        self.done_phase.d.next = self.phase.val();
        self.turn.d.next.split1 = self.phase.val().is_split & self.is_first.val();
        self.turn.d.next.split2 = self.phase.val().is_split & self.is_second.val();
        self.turn.d.next.split3 = self.phase.val().is_split & self.is_last_write.val();
        self.turn.d.next.flip1 = self.phase.val().is_flip & self.is_first.val();
        self.turn.d.next.flip2 = self.phase.val().is_flip & self.is_second.val();
        self.turn.d.next.mend1 = self.phase.val().is_mend & self.is_first.val();
        self.turn.d.next.mend2 = self.phase.val().is_mend & self.is_second.val();
        self.ends_flip.d.next = self.phase.val().is_flip & self.is_last_write.val() & (!self.reset.val());
        self.comes.d.next = self.completion.val().done;
        self.visited.d.next = self.visit.val().record;
        self.found.d.next = self.completion.val().turned;
        self.is_conflict.d.next = self.verdict.val().conflict;
        self.tests.next = self.done_phase.q.val().is_test & self.comes.q.val();
        self.flips.next = self.ends_flip.q.val();

        self.visits.context_id.next = self.context_id.val();
        self.visits.phase.next = self.done_phase.q.val();
        self.visits.is_second.next = self.turn.q.val().mend2;
        self.visits.root_id.next = self.root_id.val();
        self.visits.root.next = self.root.val();
        self.visits.triangle.next = self.triangle.q.val();
        self.bundle.next = self.visits.bundle.val();
        self.writes.turn.next = self.turn.q.val();
        self.writes.is_test.next = self.done_phase.q.val().is_test;
        self.writes.vertex.next = self.vertex.val();
        self.writes.second.next = self.records.val();
        self.writes.third.next = self.third.q.val();
        self.writes.root_id.next = self.root_id.val();
        self.writes.root.next = self.root.val();
        self.writes.triangle.next = self.triangle.q.val();
        self.writes.beyond.next = self.beyond.q.val();
        self.writes.visited.next = self.visited.q.val();
        self.writes.slot.next = self.found.q.val().slot;

        // If the outside record leads back to the star record at work already, a write of that link would be wasted.
        self.rests.next = self.done_phase.q.val().is_test & self.comes.q.val() & (!self.is_conflict.q.val());
        self.is_flipped.next = self.triangle.q.val().back != self.triangle.q.val().id;
        self.request.d.next = self.writes.write.val();
        self.request.d.next.valid = self.done_phase.q.val().is_split
            | self.done_phase.q.val().is_flip
            | (self.done_phase.q.val().is_mend & self.comes.q.val())
            | (self.rests.val() & self.is_flipped.val());

        if self.done_phase.q.val().is_mend {
            self.triangle.d.next.id = self.root_id.val();
        }
        if self.done_phase.q.val().is_fetch & self.comes.q.val() {
            self.triangle.d.next.a = self.found.q.val().v1;
            self.triangle.d.next.b = self.found.q.val().v2;
            self.triangle.d.next.outer = self.found.q.val().n0;
            self.triangle.d.next.after = self.found.q.val().n1;
            self.triangle.d.next.preceding = self.found.q.val().n2;
            self.triangle.d.next.back = self.triangle.q.val().id;
        }
        if self.done_phase.q.val().is_test & self.comes.q.val() {
            self.beyond.d.next.apex = self.found.q.val().v0;
            self.beyond.d.next.apex_after_a = self.found.q.val().n1;
            self.beyond.d.next.apex_before_b = self.found.q.val().n2;
        }
        if self.rests.val() {
            self.triangle.d.next.id = self.triangle.q.val().after;
        }
        if self.ends_flip.q.val() {
            self.triangle.d.next.b = self.beyond.q.val().apex;
            self.triangle.d.next.after = self.triangle.q.val().outer;
            self.triangle.d.next.back = self.triangle.q.val().outer;
            self.triangle.d.next.outer = self.beyond.q.val().apex_after_a;
        }
        if self.reset.val() {
            // A phase that was under way must not write once the reset is over.
            self.done_phase.d.next.is_locate = false;
            self.done_phase.d.next.is_split = false;
            self.done_phase.d.next.is_mend = false;
            self.done_phase.d.next.is_fetch = false;
            self.done_phase.d.next.is_test = false;
            self.done_phase.d.next.is_flip = false;
            self.request.d.next.valid = false;
        }
    }
}
