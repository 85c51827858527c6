//! What a visit that completes means for its context.
//!
//! 1. Who meets a lock of another context gives up (L1), unless it holds the waiting token: then it asks again (L2).
//! 2. A walk holds no locks. It looks again at a record that is not written yet or being written (L7), and at its goal while the
//!    context still has locks of its last point (L6).
//! 3. The located triangle is visited again under its lock, so what the walk saw need not be true any more (L5).
//! 4. At most one of `looks` to `root_duplicate` is high; none is for a test of an attempt that drains.
//! 5. What does not depend on the verdict is decided a clock ahead; so are `is_busy` and `is_waiter`.
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
//! gives_up        __________________/^^\_____
//! asks            ______/^^\__/^^\___________
//! may_ask         ______/^^\__/^^\__/^^\_____
//! ```

use crate::engine::types::{Token, Turned, Verdict};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What a visit means; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct VisitCase {
    /// Everything happens at its rising edge.
    pub clock: Signal<In, Clock>,
    pub early_done: Signal<In, Bit>,
    pub early_token: Signal<In, Token>,
    pub early_turned: Signal<In, Turned>,
    /// The first triangle stands.
    pub seeded: Signal<In, Bit>,
    /// A commit or a release of the context of that visit is due.
    pub is_busy: Signal<In, Bit>,
    /// This context holds the waiting token.
    pub is_waiter: Signal<In, Bit>,
    /// What the visit that completes in this clock has found out.
    pub verdict: Signal<In, Verdict>,
    /// Its attempt has failed; its list is full.
    pub drains: Signal<In, Bit>,
    pub is_full: Signal<In, Bit>,
    /// A visit completes.
    pub is_done: Signal<Out, Bit>,
    /// Which kind of visit it is.
    pub is_walk: Signal<Out, Bit>,
    pub is_root: Signal<Out, Bit>,
    pub is_test: Signal<Out, Bit>,
    /// The look at the first three points.
    pub looks: Signal<Out, Bit>,
    /// The same visit is made again; because another context holds the lock.
    pub repeats: Signal<Out, Bit>,
    pub waits: Signal<Out, Bit>,
    /// The walk goes on; it has found the point's triangle.
    pub walks_on: Signal<Out, Bit>,
    pub locates: Signal<Out, Bit>,
    /// The root is locked and holds the point: its neighbours are tested.
    pub opens: Signal<Out, Bit>,
    /// The root no longer holds the point.
    pub retries: Signal<Out, Bit>,
    /// A test passes through its edge; its edge is final.
    pub splits: Signal<Out, Bit>,
    pub settles: Signal<Out, Bit>,
    /// A test would pass, and the list is full.
    pub overflows: Signal<Out, Bit>,
    /// Another context holds the lock, of the root or of a tested triangle.
    pub gives_up_root: Signal<Out, Bit>,
    pub gives_up: Signal<Out, Bit>,
    /// The point falls onto a corner.
    pub walk_duplicate: Signal<Out, Bit>,
    pub root_duplicate: Signal<Out, Bit>,
    /// Visits follow: it repeats, walks on, locates, opens or splits.
    pub asks: Signal<Out, Bit>,
    /// They may, as far as is known soon: it is no test that finds its edge final.
    pub may_ask: Signal<Out, Bit>,
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

        // A clock ahead: the kind of visit, and what became of its lock.
        self.walks.next = self.early_done.val() & (!self.early_token.val().rotates) & (!self.early_token.val().locks);
        self.visits_root.next =
            self.early_done.val() & (!self.early_token.val().rotates) & self.early_token.val().locks;
        self.tests.next = self.early_done.val() & self.early_token.val().rotates;
        self.foreign.next = self.early_turned.val().foreign;
        self.looked.d.next = self.walks.val() & (!self.seeded.val());
        self.walked.d.next = self.walks.val() & self.seeded.val();
        self.walk_counts.d.next = self.walks.val() & self.seeded.val() & (!self.early_turned.val().again);
        self.walk_is_torn.d.next = self.walks.val() & self.seeded.val() & self.early_turned.val().again;
        self.context_is_busy.d.next = self.is_busy.val();
        self.rooted.d.next = self.visits_root.val();
        self.root_is_held.d.next = self.visits_root.val() & (!self.foreign.val());
        self.root_is_awaited.d.next = self.visits_root.val() & self.foreign.val() & self.is_waiter.val();
        self.root_is_refused.d.next = self.visits_root.val() & self.foreign.val() & (!self.is_waiter.val());
        self.tested.d.next = self.tests.val();
        self.test_counts.d.next = self.tests.val() & (!self.foreign.val());
        self.test_is_awaited.d.next = self.tests.val() & self.foreign.val() & self.is_waiter.val();
        self.test_is_refused.d.next = self.tests.val() & self.foreign.val() & (!self.is_waiter.val());
        self.may_ask_anyway.d.next = self.early_done.val() & ((!self.early_token.val().rotates) | self.foreign.val());
        self.completed.d.next = self.early_done.val();
        self.is_done.next = self.completed.q.val();
        self.is_walk.next = self.walked.q.val();
        self.is_root.next = self.rooted.q.val();
        self.is_test.next = self.tested.q.val();
        self.looks.next = self.looked.q.val();

        // A walk. L7: a torn record says nothing. L6: a commit still reads what the next cavity would overwrite.
        self.is_located.next = self.verdict.val().located & (!self.verdict.val().falls_onto_corner);
        self.is_corner.next = self.verdict.val().located & self.verdict.val().falls_onto_corner;
        self.looks_again.next = self.walk_is_torn.q.val()
            | (self.walk_counts.q.val() & self.is_located.val() & self.context_is_busy.q.val());
        self.walks_on.next = self.walk_counts.q.val() & (!self.verdict.val().located);
        self.walk_duplicate.next = self.walk_counts.q.val() & self.is_corner.val();
        self.locates.next = self.walk_counts.q.val() & self.is_located.val() & (!self.context_is_busy.q.val());

        // The visit of the root. L5: only what is seen under the lock counts.
        self.gives_up_root.next = self.root_is_refused.q.val();
        self.opens.next = self.root_is_held.q.val() & self.is_located.val();
        self.root_duplicate.next = self.root_is_held.q.val() & self.is_corner.val();
        self.retries.next = self.root_is_held.q.val() & (!self.verdict.val().located);

        // A test. L1: a foreign lock fails the attempt, whatever the verdict.
        self.is_live.next = self.test_counts.q.val() & (!self.drains.val());
        self.passes.next = self.is_live.val() & self.verdict.val().conflict & (!self.is_full.val());
        self.gives_up.next = self.test_is_refused.q.val() & (!self.drains.val());
        self.settles.next = self.is_live.val() & (!self.verdict.val().conflict);
        self.overflows.next = self.is_live.val() & self.verdict.val().conflict & self.is_full.val();
        self.splits.next = self.passes.val();

        // Visits that follow. L2: the holder of the waiting token asks again instead of failing.
        self.asks_again.next = self.root_is_awaited.q.val() | (self.test_is_awaited.q.val() & (!self.drains.val()));
        self.waits.next = self.asks_again.val();
        self.repeats.next = self.looks_again.val() | self.asks_again.val();
        self.asks.next = self.walk_is_torn.q.val()
            | (self.walk_counts.q.val() & (!self.is_corner.val()))
            | (self.root_is_held.q.val() & self.is_located.val())
            | self.passes.val()
            | self.asks_again.val();
        self.may_ask.next = self.may_ask_anyway.q.val() | (self.test_counts.q.val() & self.verdict.val().conflict);
    }
}
