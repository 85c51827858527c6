//! What a visit that completes means for its context.
//!
//! 1. Who meets a lock of another context gives up (L1), unless it holds the priority: then it asks again (L2).
//! 2. A walk holds no locks. It looks again at a record that is not written yet or being written (L7), and at its goal while the
//!    context still has locks of its last point (L6).
//! 3. The located triangle is visited again under its lock, so what the walk saw need not be true any more (L5).
//! 4. At most one of `looks` to `root_duplicate` of the case is high; none is for a test of an attempt that drains.
//! 5. What does not depend on the verdict is decided a clock ahead; so are `is_busy` and `holds_priority`.
//!
//! Latency: 1 clock from the early inputs; none from `verdict`, `drains` and `is_full`.
//!
//! A walk that ends at its goal, which is visited again and opens; a neighbour whose lock another context holds:
//! ```text
//! early_done      ___/^^\__/^^\__/^^\________
//! early.rotates   _______________/^^\________
//! early.locks     _________/^^^^^^^^\________
//! early.foreign   _______________/^^\________
//! located         ______/^^\__/^^\___________
//! is_walk         ______/^^\_________________
//! locates         ______/^^\_________________
//! opens           ____________/^^\___________
//! aborts          __________________/^^\_____
//! asks            ______/^^\__/^^\___________
//! may_ask         ______/^^\__/^^\__/^^\_____
//! ```

use crate::engine::types::{Case, Turned, Upcoming, Verdict, Visit};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What a visit means; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct VisitCase {
    pub clock: Signal<In, Clock>,
    /// The visit that completes in the next clock.
    pub early: Signal<In, Upcoming>,
    /// The first triangle stands.
    pub seeded: Signal<In, Bit>,
    /// A commit or a release of the context of that visit is due.
    pub is_busy: Signal<In, Bit>,
    /// This context holds the priority.
    pub holds_priority: Signal<In, Bit>,
    /// What the visit that completes in this clock has found out.
    pub verdict: Signal<In, Verdict>,
    /// Its attempt has failed; its list is full.
    pub drains: Signal<In, Bit>,
    pub is_full: Signal<In, Bit>,
    pub found: Signal<Out, Case>,
    completed: DFF<Bit>,
    looked: DFF<Bit>,
    walked: DFF<Bit>,
    /// A walk's record counts, or it must look again.
    walk_counts: DFF<Bit>,
    walk_is_torn: DFF<Bit>,
    context_is_busy: DFF<Bit>,
    /// The lock of a root or of a tested triangle is the context's own, or it waits for it, or gives up.
    rooted: DFF<Bit>,
    root_is_held: DFF<Bit>,
    root_is_awaited: DFF<Bit>,
    root_is_refused: DFF<Bit>,
    tested: DFF<Bit>,
    test_counts: DFF<Bit>,
    test_is_awaited: DFF<Bit>,
    test_is_refused: DFF<Bit>,
    may_ask_anyway: DFF<Bit>,
    visit: Signal<Local, Visit>,
    turned: Signal<Local, Turned>,
    walks: Signal<Local, Bit>,
    visits_root: Signal<Local, Bit>,
    tests: Signal<Local, Bit>,
    foreign: Signal<Local, Bit>,
    is_located: Signal<Local, Bit>,
    is_corner: Signal<Local, Bit>,
    is_live: Signal<Local, Bit>,
    looks_again: Signal<Local, Bit>,
    passes: Signal<Local, Bit>,
    asks_again: Signal<Local, Bit>,
}

impl Logic for VisitCase {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, looked, walked, walk_counts, walk_is_torn, context_is_busy, rooted, root_is_held);
        dff_setup!(self, clock, root_is_awaited, root_is_refused, tested, test_counts, test_is_awaited);
        dff_setup!(self, clock, test_is_refused, may_ask_anyway, completed);

        self.visit.next = self.early.val().visit;
        self.turned.next = self.early.val().turned;

        // A clock ahead: the kind of visit, and what became of its lock.
        self.walks.next = self.early.val().done & (!self.visit.val().rotates) & (!self.visit.val().locks);
        self.visits_root.next = self.early.val().done & (!self.visit.val().rotates) & self.visit.val().locks;
        self.tests.next = self.early.val().done & self.visit.val().rotates;
        self.foreign.next = self.turned.val().foreign;
        self.looked.d.next = self.walks.val() & (!self.seeded.val());
        self.walked.d.next = self.walks.val() & self.seeded.val();
        self.walk_counts.d.next = self.walks.val() & self.seeded.val() & (!self.turned.val().again);
        self.walk_is_torn.d.next = self.walks.val() & self.seeded.val() & self.turned.val().again;
        self.context_is_busy.d.next = self.is_busy.val();
        self.rooted.d.next = self.visits_root.val();
        self.root_is_held.d.next = self.visits_root.val() & (!self.foreign.val());
        self.root_is_awaited.d.next = self.visits_root.val() & self.foreign.val() & self.holds_priority.val();
        self.root_is_refused.d.next = self.visits_root.val() & self.foreign.val() & (!self.holds_priority.val());
        self.tested.d.next = self.tests.val();
        self.test_counts.d.next = self.tests.val() & (!self.foreign.val());
        self.test_is_awaited.d.next = self.tests.val() & self.foreign.val() & self.holds_priority.val();
        self.test_is_refused.d.next = self.tests.val() & self.foreign.val() & (!self.holds_priority.val());
        self.may_ask_anyway.d.next = self.early.val().done & ((!self.visit.val().rotates) | self.foreign.val());
        self.completed.d.next = self.early.val().done;
        self.found.next.is_done = self.completed.q.val();
        self.found.next.is_walk = self.walked.q.val();
        self.found.next.is_root = self.rooted.q.val();
        self.found.next.is_test = self.tested.q.val();
        self.found.next.looks = self.looked.q.val();

        // A walk. L7: a torn record says nothing. L6: a commit still reads what the next cavity would overwrite.
        self.is_located.next = self.verdict.val().located & (!self.verdict.val().falls_onto_corner);
        self.is_corner.next = self.verdict.val().located & self.verdict.val().falls_onto_corner;
        self.looks_again.next = self.walk_is_torn.q.val()
            | (self.walk_counts.q.val() & self.is_located.val() & self.context_is_busy.q.val());
        self.found.next.walks_on = self.walk_counts.q.val() & (!self.verdict.val().located);
        self.found.next.walk_duplicate = self.walk_counts.q.val() & self.is_corner.val();
        self.found.next.locates = self.walk_counts.q.val() & self.is_located.val() & (!self.context_is_busy.q.val());

        // The visit of the root. L5: only what is seen under the lock counts.
        self.found.next.aborts_root = self.root_is_refused.q.val();
        self.found.next.opens = self.root_is_held.q.val() & self.is_located.val();
        self.found.next.root_duplicate = self.root_is_held.q.val() & self.is_corner.val();
        self.found.next.root_changed = self.root_is_held.q.val() & (!self.verdict.val().located);

        // A test. L1: a foreign lock fails the attempt, whatever the verdict.
        self.is_live.next = self.test_counts.q.val() & (!self.drains.val());
        self.passes.next = self.is_live.val() & self.verdict.val().conflict & (!self.is_full.val());
        self.found.next.aborts = self.test_is_refused.q.val() & (!self.drains.val());
        self.found.next.settles = self.is_live.val() & (!self.verdict.val().conflict);
        self.found.next.overflows = self.is_live.val() & self.verdict.val().conflict & self.is_full.val();
        self.found.next.splits = self.passes.val();

        // Visits that follow. L2: the holder of the priority asks again instead of failing.
        self.asks_again.next = self.root_is_awaited.q.val() | (self.test_is_awaited.q.val() & (!self.drains.val()));
        self.found.next.waits = self.asks_again.val();
        self.found.next.revisits = self.looks_again.val() | self.asks_again.val();
        self.found.next.asks = self.walk_is_torn.q.val()
            | (self.walk_counts.q.val() & (!self.is_corner.val()))
            | (self.root_is_held.q.val() & self.is_located.val())
            | self.passes.val()
            | self.asks_again.val();
        self.found.next.may_ask =
            self.may_ask_anyway.q.val() | (self.test_counts.q.val() & self.verdict.val().conflict);
    }
}
