//! What a visit that completes means for its context.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | everything happens at its rising edge |
//! | `early_done`, `early_token`, `early_turned` | in | | the visit that completes in the next clock |
//! | `seeded` | in | 1 | the first triangle stands |
//! | `is_busy` | in | 1 | a commit or a release of the context of that visit is due |
//! | `is_waiter` | in | 1 | this context holds the waiting token |
//! | `verdict` | in | Verdict | what the visit that completes in this clock has found out |
//! | `drains`, `is_full` | in | 1 | its attempt has failed; its list is full |
//! | `is_done` | out | 1 | a visit completes |
//! | `is_walk`, `is_root`, `is_test` | out | 1 | which kind of visit it is |
//! | `looks` | out | 1 | the look at the first three points |
//! | `repeats`, `waits` | out | 1 | the same visit is made again; because another context holds the lock |
//! | `walks_on`, `locates` | out | 1 | the walk goes on; it has found the point's triangle |
//! | `opens` | out | 1 | the root is locked and holds the point: its neighbours are tested |
//! | `retries` | out | 1 | the root no longer holds the point |
//! | `splits`, `settles` | out | 1 | a test passes through its edge; its edge is final |
//! | `overflows` | out | 1 | a test would pass, and the list is full |
//! | `gives_up_root`, `gives_up` | out | 1 | another context holds the lock, of the root or of a tested triangle |
//! | `walk_duplicate`, `root_duplicate` | out | 1 | the point falls onto a corner |
//! | `asks` | out | 1 | visits follow: it repeats, walks on, locates, opens or splits |
//! | `may_ask` | out | 1 | they may, as far as is known soon: it is no test that finds its edge final |
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
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// A visit completes in the next clock.
    pub early_done: Signal<In, Bit>,
    /// The visit.
    pub early_token: Signal<In, Token>,
    /// Its record.
    pub early_turned: Signal<In, Turned>,
    /// The first triangle stands.
    pub seeded: Signal<In, Bit>,
    /// A commit or a release is due.
    pub is_busy: Signal<In, Bit>,
    /// The context waits at foreign locks.
    pub is_waiter: Signal<In, Bit>,
    /// What the visit that completes found out.
    pub verdict: Signal<In, Verdict>,
    /// The attempt has failed.
    pub drains: Signal<In, Bit>,
    /// The list is full.
    pub is_full: Signal<In, Bit>,
    /// A visit completes.
    pub is_done: Signal<Out, Bit>,
    /// Kind of visit.
    pub is_walk: Signal<Out, Bit>,
    /// Kind of visit.
    pub is_root: Signal<Out, Bit>,
    /// Kind of visit.
    pub is_test: Signal<Out, Bit>,
    /// The look at the first three points.
    pub looks: Signal<Out, Bit>,
    /// The same visit again.
    pub repeats: Signal<Out, Bit>,
    /// For a foreign lock.
    pub waits: Signal<Out, Bit>,
    /// The walk goes on.
    pub walks_on: Signal<Out, Bit>,
    /// The walk has found the triangle.
    pub locates: Signal<Out, Bit>,
    /// The cavity is opened.
    pub opens: Signal<Out, Bit>,
    /// The root has changed.
    pub retries: Signal<Out, Bit>,
    /// A test passes.
    pub splits: Signal<Out, Bit>,
    /// An edge is final.
    pub settles: Signal<Out, Bit>,
    /// The list overflows.
    pub overflows: Signal<Out, Bit>,
    /// The root is foreign.
    pub gives_up_root: Signal<Out, Bit>,
    /// A tested triangle is foreign.
    pub gives_up: Signal<Out, Bit>,
    /// A walk finds a duplicate.
    pub walk_duplicate: Signal<Out, Bit>,
    /// The visit of the root does.
    pub root_duplicate: Signal<Out, Bit>,
    /// Visits follow.
    pub asks: Signal<Out, Bit>,
    /// They may.
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
