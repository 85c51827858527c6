//! Takes each completed visit to the next step of its context: the heart of the engine.
//!
//! 1. A visit changes the state of its own context only. The state is read a clock ahead, and is changed and written
//!    back in one clock. So visits of different contexts may complete in any mixture, one a clock.
//! 2. An aborted attempt drains: its visits in flight complete, the locks that they take are logged, and then all its
//!    locks are released (L1).
//! 3. All outputs belong to the visit of this clock; `seeded`, busy contexts and the priority are read a clock ahead.
//!
//! Latency: 1 clock from `early` to the outputs; the state is there for the visit of the next clock.
//!
//! A walk finds its record, the root is locked, and the three neighbours are tested. The second one joins the cavity,
//! and the two visits that follow find their edges final. Visits take two clocks here; the locks of the root and its
//! neighbours have the places 0 to 3:
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
//! Source: the cavity of Bowyer and Watson. The ring that is split in place is our own.

use super::aftermath::Aftermath;
use super::attempt_lists::AttemptLists;
use super::attempt_points::AttemptPoints;
use super::attempt_step::AttemptStep;
use super::attempt_store::AttemptStore;
use super::next_visits::NextVisits;
use super::visit_case::VisitCase;
use crate::engine::types::{
    Attempt, Clocks, CommitRequest, Completion, ContextId, ContextSet, ContextState, EntryWrite, Follow, InnerWrite,
    LockWrite, Outcome, ReleaseRequest, RingCount, Start, Turned, Upcoming, Verdict, VertexId, Visit, VisitEvents,
};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Attempts {
    pub clock: Signal<In, Clock>,
    /// The number of entries that a ring can have, a constant.
    pub ring_capacity: Signal<In, RingCount>,
    /// The visit that completes in the next clock, unless it belongs to a solo insertion; and the same
    /// visit a clock later.
    pub early: Signal<In, Upcoming>,
    pub completion: Signal<In, Completion>,
    /// Every first triangle is in the mesh.
    pub seeded: Signal<In, Bit>,
    /// The state of the contexts, of which the busy ones are used; the context of `early` holds the priority of its
    /// team.
    pub contexts: Signal<In, ContextState>,
    pub holds_priority: Signal<In, Bit>,
    /// A context that starts and may take a point at this edge; the clock count.
    pub start: Signal<In, Start>,
    pub now: Signal<In, Clocks>,
    /// A visit completes in this clock.
    pub is_done: Signal<Out, Bit>,
    /// The visits that follow the completed visit.
    pub follow: Signal<Out, Follow>,
    /// The consequences for the context of the completed visit.
    pub outcome: Signal<Out, Outcome>,
    /// The completed visit is the look at the first three points.
    pub looks: Signal<Out, Bit>,
    /// Additions to the lists of the context: a final entry, an inner record, a lock.
    pub entry: Signal<Out, EntryWrite>,
    pub inner: Signal<Out, InnerWrite>,
    pub lock: Signal<Out, LockWrite>,
    /// A ring is complete; or the locks of an attempt are to be released.
    pub commit: Signal<Out, CommitRequest>,
    pub releases: Signal<Out, ReleaseRequest>,
    /// The events of completed visits, for the counters.
    pub events: Signal<Out, VisitEvents>,
    /// In a core with changes: the vertex that the context of the completed visit inserts.
    pub vertex: Vec<Signal<Out, VertexId>>,
    /// In such a core, for the visit that completes: its record is free (M8), or names the vertex of its context, which
    /// counts if the visit is one of a deletion or of a move whose vertex is in the mesh (`finds`); and whether the
    /// visit that completes in the next clock is such a one.
    pub early_finds: Vec<Signal<In, Bit>>,
    pub finds: Vec<Signal<In, Bit>>,
    pub is_free: Vec<Signal<In, Bit>>,
    pub names: Vec<Signal<In, Bit>>,
    store: AttemptStore,
    points: AttemptPoints,
    meaning: VisitCase,
    step: AttemptStep,
    visits: NextVisits,
    aftermath: Aftermath,
    lists: AttemptLists,
    early_visit: Signal<Local, Visit>,
    visit: Signal<Local, Visit>,
    turned: Signal<Local, Turned>,
    verdict: Signal<Local, Verdict>,
    attempt: Signal<Local, Attempt>,
    busy: Signal<Local, ContextSet>,
    context_index: Signal<Local, ContextId>,
    count: Signal<Local, RingCount>,
    two: Signal<Local, RingCount>,
}

impl Attempts {
    pub fn new(config: Config) -> Self {
        Self { store: AttemptStore::new(config), points: AttemptPoints::new(config), ..Self::default() }
    }

    /// The attempts of a core with changes.
    pub fn with_changes(config: Config) -> Self {
        Self {
            vertex: vec![Signal::default()],
            early_finds: vec![Signal::default()],
            finds: vec![Signal::default()],
            is_free: vec![Signal::default()],
            names: vec![Signal::default()],
            meaning: VisitCase::with_changes(),
            ..Self::new(config)
        }
    }
}

impl Logic for Attempts {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, store, points, meaning, visits);
        self.two.next = 2.into();
        self.early_visit.next = self.early.val().visit;
        self.visit.next = self.completion.val().visit;
        self.turned.next = self.completion.val().turned;
        self.verdict.next = self.completion.val().verdict;

        self.store.ring_capacity.next = self.ring_capacity.val();
        self.store.early_visit.next = self.early_visit.val();
        self.store.visit.next = self.visit.val();
        self.attempt.next = self.store.held.val().attempt;
        self.count.next = self.attempt.val().count;
        self.points.context_id.next = self.visit.val().context;
        self.points.start.next = self.start.val();
        self.points.now.next = self.now.val();

        // `busy` is chosen by the early visit: a choice among 24 flags takes long, and the verdict comes late.
        self.context_index.next = self.early_visit.val().context;
        self.busy.next = self.contexts.val().busy;
        self.meaning.early.next = self.early.val();
        self.meaning.verdict.next = self.verdict.val();
        self.meaning.seeded.next = self.seeded.val();
        self.meaning.is_busy.next = self.busy.val().get_bit(self.context_index.val().index());
        self.meaning.holds_priority.next = self.holds_priority.val();
        self.meaning.drains.next = self.attempt.val().drains;
        self.meaning.is_full.next = self.store.held.val().is_full;
        self.is_done.next = self.meaning.found.val().is_done;
        self.looks.next = self.meaning.found.val().looks;

        self.step.held.next = self.store.held.val();
        self.step.took.next = self.turned.val().took;
        self.step.found.next = self.meaning.found.val();
        self.store.found.next = self.meaning.found.val();
        self.store.step.next = self.step.step.val();
        self.store.after.next = self.step.after.val();

        self.visits.early_visit.next = self.early_visit.val();
        self.visits.early_turned.next = self.early.val().turned;
        self.visits.found.next = self.meaning.found.val();
        self.visits.walk_next.next = self.verdict.val().walk_next;
        self.visits.entry.next = self.count.val().get_bits::<6>(0);
        self.follow.next.asks = self.meaning.found.val().asks;
        self.follow.next.may_ask = self.meaning.found.val().may_ask;
        self.follow.next.bundle = self.visits.bundle.val();

        self.aftermath.visit.next = self.visit.val();
        self.aftermath.found.next = self.meaning.found.val();
        self.aftermath.step.next = self.step.step.val();
        self.aftermath.walk_next.next = self.verdict.val().walk_next;
        self.aftermath.hands_over.next = self.lists.commit.val().valid | self.lists.releases.val().valid;
        self.outcome.next = self.aftermath.outcome.val();

        self.lists.completion.next = self.completion.val();
        self.lists.attempt.next = self.attempt.val();
        self.lists.after.next = self.step.after.val();
        self.lists.vertex.next = self.points.vertex.val();
        self.lists.since.next = self.points.since.val();
        self.lists.found.next = self.meaning.found.val();
        self.lists.step.next = self.step.step.val();
        self.lists.fails.next = self.aftermath.fails.val();
        self.lists.stops_at_root.next = self.aftermath.stops_at_root.val();
        self.entry.next = self.lists.entry.val();
        self.inner.next = self.lists.inner.val();
        self.lock.next = self.lists.lock.val();
        self.commit.next = self.lists.commit.val();
        self.releases.next = self.lists.releases.val();
        for i in 0..self.vertex.len() {
            self.vertex[i].next = self.points.vertex.val();
            self.meaning.test_conflicts[i].next = self.verdict.val().conflict & (!self.is_free[i].val());
            if self.is_free[i].val() {
                self.meaning.verdict.next.conflict = false;
            }
            if self.finds[i].val() {
                self.meaning.verdict.next.conflict = self.names[i].val();
                self.meaning.verdict.next.falls_onto_corner = false;
            }
            if self.early_finds[i].val() {
                self.meaning.early.next.done = self.early.val().done & (!self.early_visit.val().rotates);
            }
        }

        // A cavity with `n` boundary edges has `n - 2` records, as the polygon has no vertex inside.
        self.events.next.walk_visit = self.meaning.found.val().is_walk;
        self.events.next.root_visit = self.meaning.found.val().is_root;
        self.events.next.test = self.meaning.found.val().is_test;
        self.events.next.revisit = self.meaning.found.val().revisits;
        self.events.next.overflows = self.meaning.found.val().overflows;
        self.events.next.flip = false;
        self.events.next.aborts = self.aftermath.outcome.val().asks_for_priority;
        self.events.next.root_changed = self.meaning.found.val().root_changed;
        self.events.next.takes_priority = false;
        self.events.next.cavity_ends = self.lists.commit.val().valid;
        self.events.next.cavity_triangles = self.count.val() - self.two.val();
    }
}
