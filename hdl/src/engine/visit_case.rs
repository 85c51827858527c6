//! What a visit that completes means for its context.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `done`, `token`, `turned`, `verdict` | in | | the visit that completes |
//! | `seeded` | in | 1 | the first triangle stands |
//! | `is_busy` | in | 1 | a commit or a release of the context is due |
//! | `is_waiter` | in | 1 | the context holds the waiting token |
//! | `drains`, `is_full` | in | 1 | its attempt has failed; its list is full |
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
//!
//! 1. Who meets a lock of another context gives up, unless it holds the waiting token: then it asks again.
//! 2. A walk holds no locks. It looks again at a record that is not written yet or being written, and at its goal while the context
//!    still has locks of its last point.
//! 3. The located triangle is visited again under its lock, so what the walk saw need not be true any more.
//! 4. At most one of `looks` to `root_duplicate` is high; none is for a test of an attempt that drains.
//!
//! Latency: none (combinational).

use super::{Token, Turned, Verdict};
use rust_hdl_core::prelude::*;

/// What a visit means; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct VisitCase {
    /// A visit completes.
    pub done: Signal<In, Bit>,
    /// The visit.
    pub token: Signal<In, Token>,
    /// Its record.
    pub turned: Signal<In, Turned>,
    /// What it found out.
    pub verdict: Signal<In, Verdict>,
    /// The first triangle stands.
    pub seeded: Signal<In, Bit>,
    /// A commit or a release is due.
    pub is_busy: Signal<In, Bit>,
    /// The context waits at foreign locks.
    pub is_waiter: Signal<In, Bit>,
    /// The attempt has failed.
    pub drains: Signal<In, Bit>,
    /// The list is full.
    pub is_full: Signal<In, Bit>,
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
    walks: Signal<Local, Bit>,
    visits_root: Signal<Local, Bit>,
    tests: Signal<Local, Bit>,
    is_clear: Signal<Local, Bit>,
    is_located: Signal<Local, Bit>,
    is_corner: Signal<Local, Bit>,
    is_blocked: Signal<Local, Bit>,
    holds_root: Signal<Local, Bit>,
    is_live: Signal<Local, Bit>,
    is_tested: Signal<Local, Bit>,
    looks_again: Signal<Local, Bit>,
    asks_again: Signal<Local, Bit>,
}

impl Logic for VisitCase {
    #[hdl_gen]
    fn update(&mut self) {
        self.walks.next = self.done.val() & (!self.token.val().rotates) & (!self.token.val().locks);
        self.visits_root.next = self.done.val() & (!self.token.val().rotates) & self.token.val().locks;
        self.tests.next = self.done.val() & self.token.val().rotates;
        self.is_walk.next = self.walks.val() & self.seeded.val();
        self.is_root.next = self.visits_root.val();
        self.is_test.next = self.tests.val();
        self.looks.next = self.walks.val() & (!self.seeded.val());

        // A walk.
        self.is_located.next = self.verdict.val().located & (!self.verdict.val().falls_onto_corner);
        self.is_corner.next = self.verdict.val().located & self.verdict.val().falls_onto_corner;
        self.is_clear.next = self.walks.val() & self.seeded.val() & (!self.turned.val().again);
        self.is_blocked.next = self.is_located.val() & self.is_busy.val();
        self.looks_again.next =
            self.walks.val() & self.seeded.val() & (self.turned.val().again | self.is_blocked.val());
        self.walks_on.next = self.is_clear.val() & (!self.verdict.val().located);
        self.walk_duplicate.next = self.is_clear.val() & self.is_corner.val();
        self.locates.next = self.is_clear.val() & self.is_located.val() & (!self.is_busy.val());

        // The visit of the root.
        self.holds_root.next = self.visits_root.val() & (!self.turned.val().foreign);
        self.gives_up_root.next = self.visits_root.val() & self.turned.val().foreign & (!self.is_waiter.val());
        self.opens.next = self.holds_root.val() & self.is_located.val();
        self.root_duplicate.next = self.holds_root.val() & self.is_corner.val();
        self.retries.next = self.holds_root.val() & (!self.verdict.val().located);

        // A test.
        self.is_live.next = self.tests.val() & (!self.drains.val());
        self.is_tested.next = self.is_live.val() & (!self.turned.val().foreign);
        self.gives_up.next = self.is_live.val() & self.turned.val().foreign & (!self.is_waiter.val());
        self.settles.next = self.is_tested.val() & (!self.verdict.val().conflict);
        self.overflows.next = self.is_tested.val() & self.verdict.val().conflict & self.is_full.val();
        self.splits.next = self.is_tested.val() & self.verdict.val().conflict & (!self.is_full.val());

        self.asks_again.next =
            self.turned.val().foreign & self.is_waiter.val() & (self.visits_root.val() | self.is_live.val());
        self.waits.next = self.asks_again.val();
        self.repeats.next = self.looks_again.val() | self.asks_again.val();
    }
}
