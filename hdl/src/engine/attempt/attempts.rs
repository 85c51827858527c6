//! Takes each visit that completes to the next step of its context: the heart of the engine.
//!
//! 1. A visit changes the state of its own context only, which is read a clock ahead, and changed and written back in one clock; so
//!    visits of all contexts complete in any order, one a clock.
//! 2. A failed attempt drains: its visits run out, locks that they take are logged, and then all its locks are released (L1).
//! 3. All outputs belong to the visit of this clock. `seeded`, `busy` and the waiting token are looked at a clock ahead.
//!
//! Latency: 1 clock from the early inputs to the outputs; the state is there for the visit of the next clock.
//!
//! A walk finds its triangle, the root is locked, and its three neighbours are tested; the second one joins the cavity, and the visits
//! that this asks for find its two edges final. Visits take two clocks here; the locks of the root and of its neighbours are places 0
//! to 3:
//! ```text
//! early_done      /^^\__/^^\__/^^^^^^^^\__/^^^^^\_____
//! walk_visit      ___/^^\_____________________________
//! root_visit      _________/^^\_______________________
//! test            _______________/^^^^^^^^\__/^^^^^\__
//! asks            ___/^^\__/^^\________/^^\___________
//! visits            .  1  .  3  .  .  .  2  .  .  .  .
//! lock_enable     _________/^^\__/^^^^^^^^\__/^^^^^\__
//! lock_place        .  .  .  0  .  1  2  3  .  4  5  .
//! entry_enable    _______________/^^^^^\_____/^^^^^\__
//! entry_place       .  .  .  .  .  0  2  .  .  1  3  .
//! sleeps          ______________________________/^^\__
//! commit_enable   ______________________________/^^\__
//! ```
//!
//! Source: Bowyer and Watson's cavity; the ring that is split in place is ours.

use super::attempt_lists::AttemptLists;
use super::attempt_points::AttemptPoints;
use super::attempt_step::AttemptStep;
use super::attempt_store::AttemptStore;
use super::next_visits::NextVisits;
use super::visit_case::VisitCase;
use crate::engine::types::{Bundle, CommitJob, Entry, ReleaseJob, Token, Turned, Verdict};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// The completion of visits; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Attempts {
    /// Everything happens at its rising edge.
    pub clock: Signal<In, Clock>,
    /// Entries a boundary list holds, a constant.
    pub ring: Signal<In, Bits<7>>,
    pub early_done: Signal<In, Bit>,
    pub early_token: Signal<In, Token>,
    pub early_turned: Signal<In, Turned>,
    pub token: Signal<In, Token>,
    pub turned: Signal<In, Turned>,
    pub verdict: Signal<In, Verdict>,
    /// The first triangle stands.
    pub seeded: Signal<In, Bit>,
    /// Contexts with a commit or release due; who holds the waiting token.
    pub busy: Signal<In, Bits<24>>,
    pub waiter_valid: Signal<In, Bit>,
    pub waiter: Signal<In, Bits<5>>,
    /// A context takes a point at this edge; the time.
    pub takes: Signal<In, Bit>,
    pub taker: Signal<In, Bits<5>>,
    pub taken_id: Signal<In, Bits<15>>,
    pub now: Signal<In, Bits<22>>,
    /// There are visits to make; there may be, see `VisitCase`; they.
    pub asks: Signal<Out, Bit>,
    pub may_ask: Signal<Out, Bit>,
    pub bundle: Signal<Out, Bundle>,
    /// A visit completes; the context of all outputs below.
    pub is_done: Signal<Out, Bit>,
    pub owner: Signal<Out, Bits<5>>,
    /// None of its visits is out any more; it will try its point again.
    pub sleeps: Signal<Out, Bit>,
    pub keeps: Signal<Out, Bit>,
    /// A root's visit says where a walk for the same point would start next.
    pub root_enable: Signal<Out, Bit>,
    pub root: Signal<Out, Bits<15>>,
    /// A final edge of the boundary.
    pub entry_enable: Signal<Out, Bit>,
    pub entry_place: Signal<Out, Bits<6>>,
    pub entry: Signal<Out, Entry>,
    /// An inner triangle.
    pub inner_enable: Signal<Out, Bit>,
    pub inner_place: Signal<Out, Bits<6>>,
    pub inner_id: Signal<Out, Bits<15>>,
    /// A lock for the log.
    pub lock_enable: Signal<Out, Bit>,
    pub lock_place: Signal<Out, Bits<7>>,
    pub lock_id: Signal<Out, Bits<15>>,
    /// A ring is finished.
    pub commit_enable: Signal<Out, Bit>,
    pub commit_job: Signal<Out, CommitJob>,
    /// Locks are to be released.
    pub release_enable: Signal<Out, Bit>,
    pub release_job: Signal<Out, ReleaseJob>,
    /// It wants the waiting token, meets a foreign lock with it, needs it no more.
    pub asks_to_wait: Signal<Out, Bit>,
    pub waits: Signal<Out, Bit>,
    pub stops_waiting: Signal<Out, Bit>,
    /// Its list overflows; its point is one already; the look at the first three points.
    pub overflows: Signal<Out, Bit>,
    pub duplicate: Signal<Out, Bit>,
    pub looks: Signal<Out, Bit>,
    /// Events for the counters.
    pub walk_visit: Signal<Out, Bit>,
    pub root_visit: Signal<Out, Bit>,
    pub test: Signal<Out, Bit>,
    pub revisit: Signal<Out, Bit>,
    pub gives_up: Signal<Out, Bit>,
    pub retries: Signal<Out, Bit>,
    /// Triangles of the ring that is finished.
    pub cavity_triangles: Signal<Out, Bits<7>>,
    store: AttemptStore,
    points: AttemptPoints,
    meaning: VisitCase,
    step: AttemptStep,
    visits: NextVisits,
    lists: AttemptLists,
    context_index: Signal<Local, Bits<5>>,
    fails: Signal<Local, Bit>,
    stops_at_root: Signal<Local, Bit>,
    count: Signal<Local, Bits<7>>,
    two: Signal<Local, Bits<7>>,
}

impl Attempts {
    /// The attempts of a configuration.
    pub fn new(config: Config) -> Self {
        Self { store: AttemptStore::new(config), points: AttemptPoints::new(config), ..Self::default() }
    }
}

impl Logic for Attempts {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, store, points, meaning, visits);
        self.two.next = 2.into();
        self.context_index.next = self.early_token.val().owner;
        self.owner.next = self.token.val().owner;
        self.is_done.next = self.meaning.is_done.val();

        // The context's state.
        self.store.ring.next = self.ring.val();
        self.store.early_owner.next = self.early_token.val().owner;
        self.store.early_entry.next = self.early_token.val().f_entry;
        self.store.owner.next = self.token.val().owner;
        self.store.f_entry.next = self.token.val().f_entry;
        self.count.next = self.store.attempt.val().count;
        self.points.owner.next = self.token.val().owner;
        self.points.takes.next = self.takes.val();
        self.points.taker.next = self.taker.val();
        self.points.taken_id.next = self.taken_id.val();
        self.points.now.next = self.now.val();

        // What the visit means.
        self.meaning.early_done.next = self.early_done.val();
        self.meaning.early_token.next = self.early_token.val();
        self.meaning.early_turned.next = self.early_turned.val();
        self.meaning.verdict.next = self.verdict.val();
        self.meaning.seeded.next = self.seeded.val();
        self.meaning.is_busy.next = self.busy.val().get_bit(self.context_index.val().index());
        self.meaning.is_waiter.next = self.waiter_valid.val() & (self.waiter.val() == self.early_token.val().owner);
        self.meaning.drains.next = self.store.attempt.val().drains;
        self.meaning.is_full.next = self.store.is_full.val();

        // The state afterwards.
        self.step.attempt.next = self.store.attempt.val();
        self.step.is_last.next = self.store.is_last.val();
        self.step.edge_was_passed.next = self.store.edge_was_passed.val();
        self.step.entry_bit.next = self.store.entry_bit.val();
        self.step.took.next = self.turned.val().took;
        self.step.is_test.next = self.meaning.is_test.val();
        self.step.splits.next = self.meaning.splits.val();
        self.step.repeats.next = self.meaning.repeats.val();
        self.step.gives_up.next = self.meaning.gives_up.val();
        self.step.overflows.next = self.meaning.overflows.val();
        self.store.opens.next = self.meaning.opens.val();
        self.store.splits.next = self.meaning.splits.val();
        self.store.repeats.next = self.meaning.repeats.val();
        self.store.is_test.next = self.meaning.is_test.val();
        self.store.passes_root.next = self.step.passes_root.val();
        self.store.after.next = self.step.after.val();

        // The visits that follow.
        self.visits.early_token.next = self.early_token.val();
        self.visits.early_turned.next = self.early_turned.val();
        self.visits.walks_on.next = self.meaning.walks_on.val();
        self.visits.locates.next = self.meaning.locates.val();
        self.visits.walk_next.next = self.verdict.val().walk_next;
        self.visits.entry.next = self.count.val().get_bits::<6>(0);
        self.asks.next = self.meaning.asks.val();
        self.may_ask.next = self.meaning.may_ask.val();
        self.bundle.next = self.visits.bundle.val();

        // What becomes of the context.
        self.fails.next = self.step.is_over.val() & (!self.step.succeeds.val());
        self.stops_at_root.next = self.meaning.root_duplicate.val() | self.meaning.retries.val();
        self.sleeps.next = self.meaning.looks.val()
            | self.meaning.walk_duplicate.val()
            | self.meaning.gives_up_root.val()
            | self.stops_at_root.val()
            | self.step.is_over.val();
        self.keeps.next = self.meaning.gives_up_root.val() | self.meaning.retries.val() | self.fails.val();
        self.root_enable.next = self.meaning.is_root.val();
        self.root.next = self.token.val().u;
        if self.meaning.retries.val() {
            self.root.next = self.verdict.val().walk_next;
        }
        self.asks_to_wait.next = self.meaning.gives_up_root.val() | self.meaning.gives_up.val();
        self.waits.next = self.meaning.waits.val();
        self.stops_waiting.next =
            self.meaning.walk_duplicate.val() | self.meaning.root_duplicate.val() | self.step.succeeds.val();
        self.overflows.next = self.meaning.overflows.val();
        self.duplicate.next = self.meaning.walk_duplicate.val() | self.meaning.root_duplicate.val();
        self.looks.next = self.meaning.looks.val();

        // What the lists take.
        self.lists.done.next = self.meaning.is_done.val();
        self.lists.token.next = self.token.val();
        self.lists.turned.next = self.turned.val();
        self.lists.attempt.next = self.store.attempt.val();
        self.lists.after.next = self.step.after.val();
        self.lists.p.next = self.points.p.val();
        self.lists.since.next = self.points.since.val();
        self.lists.is_root.next = self.meaning.is_root.val();
        self.lists.settles.next = self.meaning.settles.val();
        self.lists.finds_inner.next = self.step.finds_inner.val();
        self.lists.succeeds.next = self.step.succeeds.val();
        self.lists.fails.next = self.fails.val();
        self.lists.stops_at_root.next = self.stops_at_root.val();
        self.entry_enable.next = self.lists.entry_enable.val();
        self.entry_place.next = self.lists.entry_place.val();
        self.entry.next = self.lists.entry.val();
        self.inner_enable.next = self.lists.inner_enable.val();
        self.inner_place.next = self.lists.inner_place.val();
        self.inner_id.next = self.lists.inner_id.val();
        self.lock_enable.next = self.lists.lock_enable.val();
        self.lock_place.next = self.lists.lock_place.val();
        self.lock_id.next = self.lists.lock_id.val();
        self.commit_enable.next = self.lists.commit_enable.val();
        self.commit_job.next = self.lists.commit_job.val();
        self.release_enable.next = self.lists.release_enable.val();
        self.release_job.next = self.lists.release_job.val();

        // For the counters.
        self.walk_visit.next = self.meaning.is_walk.val();
        self.root_visit.next = self.meaning.is_root.val();
        self.test.next = self.meaning.is_test.val();
        self.revisit.next = self.meaning.repeats.val();
        self.gives_up.next = self.meaning.gives_up_root.val() | self.meaning.gives_up.val();
        self.retries.next = self.meaning.retries.val();
        self.cavity_triangles.next = self.count.val() - self.two.val();
    }
}
