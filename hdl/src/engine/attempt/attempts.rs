//! Takes each visit that completes to the next step of its context: the heart of the engine.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | everything happens at its rising edge |
//! | `ring` | in | 7 | entries a boundary list holds, a constant |
//! | `early_done`, `early_token`, `early_turned` | in | | a visit completes in the next clock that is no insertion alone's |
//! | `token`, `turned`, `verdict` | in | | the visit that completes, one clock after it stood there |
//! | `seeded` | in | 1 | the first triangle stands |
//! | `busy`, `waiter_valid`, `waiter` | in | 24, 1, 5 | contexts with a commit or release due; who holds the waiting token |
//! | `takes`, `taker`, `taken_id`, `now` | in | 1, 5, 15, 22 | a context takes a point at this edge; the time |
//! | `asks`, `may_ask`, `bundle` | out | 1, 1, Bundle | there are visits to make; there may be, see `VisitCase`; they |
//! | `is_done`, `owner` | out | 1, 5 | a visit completes; the context of all outputs below |
//! | `sleeps`, `keeps` | out | 1 | none of its visits is out any more; it will try its point again |
//! | `root_enable`, `root` | out | 1, 15 | a root's visit says where a walk for the same point would start next |
//! | `entry_enable`, `entry_place`, `entry` | out | 1, 6, Entry | a final edge of the boundary |
//! | `inner_enable`, `inner_place`, `inner_id` | out | 1, 6, 15 | an inner triangle |
//! | `lock_enable`, `lock_place`, `lock_id` | out | 1, 7, 15 | a lock for the log |
//! | `commit_enable`, `commit_job` | out | 1, CommitJob | a ring is finished |
//! | `release_enable`, `release_job` | out | 1, ReleaseJob | locks are to be released |
//! | `asks_to_wait`, `waits`, `stops_waiting` | out | 1 | it wants the waiting token, meets a foreign lock with it, needs it no more |
//! | `overflows`, `duplicate`, `looks` | out | 1 | its list overflows; its point is one already; the look at the first three points |
//! | `walk_visit`, `root_visit`, `test`, `revisit`, `gives_up`, `retries` | out | 1 | events for the counters |
//! | `cavity_triangles` | out | 7 | triangles of the ring that is finished |
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
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Entries a list holds.
    pub ring: Signal<In, Bits<7>>,
    /// A visit completes in the next clock.
    pub early_done: Signal<In, Bit>,
    /// The visit.
    pub early_token: Signal<In, Token>,
    /// Its record.
    pub early_turned: Signal<In, Turned>,
    /// The visit that completes.
    pub token: Signal<In, Token>,
    /// Its record.
    pub turned: Signal<In, Turned>,
    /// What it found out.
    pub verdict: Signal<In, Verdict>,
    /// The first triangle stands.
    pub seeded: Signal<In, Bit>,
    /// Contexts with a commit or release due.
    pub busy: Signal<In, Bits<24>>,
    /// Somebody holds the waiting token.
    pub waiter_valid: Signal<In, Bit>,
    /// Who.
    pub waiter: Signal<In, Bits<5>>,
    /// A context takes a point.
    pub takes: Signal<In, Bit>,
    /// Which context.
    pub taker: Signal<In, Bits<5>>,
    /// The vertex it takes.
    pub taken_id: Signal<In, Bits<15>>,
    /// The time.
    pub now: Signal<In, Bits<22>>,
    /// There are visits to make.
    pub asks: Signal<Out, Bit>,
    /// There may be.
    pub may_ask: Signal<Out, Bit>,
    /// The visits.
    pub bundle: Signal<Out, Bundle>,
    /// A visit completes.
    pub is_done: Signal<Out, Bit>,
    /// The context at work.
    pub owner: Signal<Out, Bits<5>>,
    /// No visit of it is out.
    pub sleeps: Signal<Out, Bit>,
    /// It tries again.
    pub keeps: Signal<Out, Bit>,
    /// Its goal is known.
    pub root_enable: Signal<Out, Bit>,
    /// The goal.
    pub root: Signal<Out, Bits<15>>,
    /// An edge is final.
    pub entry_enable: Signal<Out, Bit>,
    /// Its place.
    pub entry_place: Signal<Out, Bits<6>>,
    /// The edge.
    pub entry: Signal<Out, Entry>,
    /// An inner triangle.
    pub inner_enable: Signal<Out, Bit>,
    /// Its place.
    pub inner_place: Signal<Out, Bits<6>>,
    /// Its id.
    pub inner_id: Signal<Out, Bits<15>>,
    /// A lock was taken.
    pub lock_enable: Signal<Out, Bit>,
    /// Its place in the log.
    pub lock_place: Signal<Out, Bits<7>>,
    /// The record.
    pub lock_id: Signal<Out, Bits<15>>,
    /// A ring is finished.
    pub commit_enable: Signal<Out, Bit>,
    /// The ring.
    pub commit_job: Signal<Out, CommitJob>,
    /// Locks are to be released.
    pub release_enable: Signal<Out, Bit>,
    /// The locks.
    pub release_job: Signal<Out, ReleaseJob>,
    /// It wants the waiting token.
    pub asks_to_wait: Signal<Out, Bit>,
    /// It meets a foreign lock with it.
    pub waits: Signal<Out, Bit>,
    /// It needs it no more.
    pub stops_waiting: Signal<Out, Bit>,
    /// Its list overflows.
    pub overflows: Signal<Out, Bit>,
    /// Its point is a duplicate.
    pub duplicate: Signal<Out, Bit>,
    /// The look at the first three points.
    pub looks: Signal<Out, Bit>,
    /// Event: a walk's visit.
    pub walk_visit: Signal<Out, Bit>,
    /// Event: a root's visit.
    pub root_visit: Signal<Out, Bit>,
    /// Event: a test.
    pub test: Signal<Out, Bit>,
    /// Event: a visit is made again.
    pub revisit: Signal<Out, Bit>,
    /// Event: an attempt is given up for a foreign lock.
    pub gives_up: Signal<Out, Bit>,
    /// Event: a root had changed.
    pub retries: Signal<Out, Bit>,
    /// Triangles of a finished ring.
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
