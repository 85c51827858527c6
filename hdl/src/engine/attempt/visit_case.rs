//! The meaning of a completed visit for its context.
//!
//! 1. A root visit or a test that meets a foreign lock aborts its attempt (L1). If its context holds the priority, the
//!    record is visited again instead (L2).
//! 2. A walk ends at the first record that conflicts with the point (L10). It holds no locks, and makes its visit again
//!    if the record is not written yet or is being written (L7), or if the record conflicts with the point while the
//!    context still has locks of its last point (L6).
//! 3. The root is visited again under its lock, because the findings of the walk need not be true any more (L5).
//! 4. At most one of `looks` to `root_duplicate` in the case is high, except that `waits` comes with `revisits`. None
//!    is high for a test of an attempt that drains.
//! 5. Whatever does not depend on the verdict is decided a clock ahead. `is_busy` and `holds_priority` are inputs
//!    of that clock too.
//!
//! Latency: 1 clock from the early inputs; none from `verdict`, `drains` and `is_full`.
//!
//! A walk ends at a record that conflicts with its point. The record is visited again as root and opens the cavity.
//! Then another context holds the lock of a neighbour:
//! ```text
//! early_done      ___/^^\__/^^\__/^^\________
//! early.rotates   _______________/^^\________
//! early.locks     _________/^^^^^^^^\________
//! early.foreign   _______________/^^\________
//! conflict        ______/^^\__/^^\___________
//! is_walk         ______/^^\_________________
//! locates         ______/^^\_________________
//! opens           ____________/^^\___________
//! aborts          __________________/^^\_____
//! asks            ______/^^\__/^^\___________
//! may_ask         ______/^^\__/^^\__/^^\_____
//! ```

use crate::engine::types::{Case, Turned, Upcoming, Verdict, Visit};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct VisitCase {
    pub clock: Signal<In, Clock>,
    /// The visit that completes in the next clock.
    pub early: Signal<In, Upcoming>,
    /// Every first triangle is in the mesh.
    pub seeded: Signal<In, Bit>,
    /// A commit or a release of the context of that visit is due.
    pub is_busy: Signal<In, Bit>,
    /// The context of that visit holds the priority.
    pub holds_priority: Signal<In, Bit>,
    /// The findings of the visit that completes in this clock.
    pub verdict: Signal<In, Verdict>,
    /// The attempt of that visit has aborted; or its list is full.
    pub drains: Signal<In, Bit>,
    pub is_full: Signal<In, Bit>,
    pub found: Signal<Out, Case>,
    /// In a core with changes: whether the record of a test conflicts with the point, which is known sooner than what
    /// `verdict` says of a walk or a root of a deletion. For a test both say the same: none belongs to a deletion.
    pub test_conflicts: Vec<Signal<In, Bit>>,
    completed: DFF<Bit>,
    looked: DFF<Bit>,
    walked: DFF<Bit>,
    /// The record of a walk is whole; or it is torn, and the visit must be made again.
    walk_counts: DFF<Bit>,
    walk_is_torn: DFF<Bit>,
    context_is_busy: DFF<Bit>,
    /// A root visit completes. Its lock belongs to the context now; or the context waits for the lock; or it aborts.
    /// The flags of a test follow in the same order.
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
    is_in_conflict: Signal<Local, Bit>,
    is_corner: Signal<Local, Bit>,
    is_live: Signal<Local, Bit>,
    looks_again: Signal<Local, Bit>,
    passes: Signal<Local, Bit>,
    asks_again: Signal<Local, Bit>,
}

impl VisitCase {
    /// The block of a core with changes.
    pub fn with_changes() -> Self {
        Self { test_conflicts: vec![Signal::default()], ..Self::default() }
    }
}

impl Logic for VisitCase {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, looked, walked, walk_counts, walk_is_torn, context_is_busy, rooted, root_is_held);
        dff_setup!(self, clock, root_is_awaited, root_is_refused, tested, test_counts, test_is_awaited);
        dff_setup!(self, clock, test_is_refused, may_ask_anyway, completed);

        self.visit.next = self.early.val().visit;
        self.turned.next = self.early.val().turned;

        // Everything but the verdict is known a clock ahead. The kind of the visit and the outcome for its lock are
        // therefore decided here, which leaves the next clock to the verdict.
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

        // L7: a torn record says nothing about the point.
        //
        // L6: a root visit logs its lock in the lists of the context, which the commit or release still due reads.
        //
        // L10: the cavity is the same from any of its records, so the walk ends at the first one that it meets.
        self.is_corner.next = self.verdict.val().falls_onto_corner;
        self.is_in_conflict.next = self.verdict.val().conflict & (!self.is_corner.val());
        self.looks_again.next = self.walk_is_torn.q.val()
            | (self.walk_counts.q.val() & self.is_in_conflict.val() & self.context_is_busy.q.val());
        self.found.next.walks_on = self.walk_counts.q.val() & (!self.verdict.val().conflict) & (!self.is_corner.val());
        self.found.next.walk_duplicate = self.walk_counts.q.val() & self.is_corner.val();
        self.found.next.locates =
            self.walk_counts.q.val() & self.is_in_conflict.val() & (!self.context_is_busy.q.val());

        // L5: only findings under the lock count, because another context may have changed the root after the walk.
        self.found.next.aborts_root = self.root_is_refused.q.val();
        self.found.next.opens = self.root_is_held.q.val() & self.is_in_conflict.val();
        self.found.next.root_duplicate = self.root_is_held.q.val() & self.is_corner.val();
        self.found.next.root_changed =
            self.root_is_held.q.val() & (!self.verdict.val().conflict) & (!self.is_corner.val());

        // L1: a foreign lock aborts the attempt whatever the verdict, because the other context may be about
        // to change the record.
        self.is_live.next = self.test_counts.q.val() & (!self.drains.val());
        self.passes.next = self.is_live.val() & self.verdict.val().conflict & (!self.is_full.val());
        self.found.next.aborts = self.test_is_refused.q.val() & (!self.drains.val());
        self.found.next.settles = self.is_live.val() & (!self.verdict.val().conflict);
        self.found.next.overflows = self.is_live.val() & self.verdict.val().conflict & self.is_full.val();
        self.found.next.splits = self.passes.val();

        // L2: the context with the priority waits at a foreign lock. No other context waits with locks held, so waits
        // cannot form a cycle.
        self.asks_again.next = self.root_is_awaited.q.val() | (self.test_is_awaited.q.val() & (!self.drains.val()));
        self.found.next.waits = self.asks_again.val();
        self.found.next.revisits = self.looks_again.val() | self.asks_again.val();
        self.found.next.asks = self.walk_is_torn.q.val()
            | (self.walk_counts.q.val() & (!self.is_corner.val()))
            | (self.root_is_held.q.val() & self.is_in_conflict.val())
            | self.passes.val()
            | self.asks_again.val();
        self.found.next.may_ask =
            self.may_ask_anyway.q.val() | (self.test_counts.q.val() & self.verdict.val().conflict);
        for i in 0..self.test_conflicts.len() {
            self.found.next.may_ask =
                self.may_ask_anyway.q.val() | (self.test_counts.q.val() & self.test_conflicts[i].val());
        }
    }
}
