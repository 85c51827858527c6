//! The contexts and the effects of their visits: which context starts, which visits follow, which stars are written,
//! and which locks are released. The rooms `dispatch`, `attempt` and `commit` meet here.

use super::attempt::Attempts;
use super::commit::CommitPath;
use super::dispatch::{ChangeView, Dispatcher};
use super::holes::{HoleMerge, Holes};
use super::types::{
    Arrival, Bundle, Carried, ChangeEvents, Clocks, CommitJob, Completion, ContextId, Deal, Events, Fetched, Follow,
    Limits, LockClear, Moving, SeedProgress, SoloProgress, SoloStart, Start, TestVertices, TriangleId, Upcoming,
    VertexId, Visit, VisitEvents, Write,
};
use crate::predicate::Sides;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Insertions {
    pub clock: Signal<In, Clock>,
    /// Reset drops all work; clear forgets the mesh.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    pub limits: Signal<In, Limits>,
    /// The rule by which points belong to contexts.
    pub deal: Signal<In, Deal>,
    /// The number of points that have come; a point is being stored at this edge (`came`); the clock count.
    pub arrived: Signal<In, VertexId>,
    pub came: Signal<In, Bit>,
    pub now: Signal<In, Clocks>,
    /// The visit that completes in the next clock, none while a solo insertion is at work; and the visit that
    /// completes in this clock.
    pub early: Signal<In, Upcoming>,
    pub completion: Signal<In, Completion>,
    pub seed: Signal<In, SeedProgress>,
    pub solo: Signal<In, SoloProgress>,
    /// The visits that follow the completed visit.
    pub follow: Signal<Out, Follow>,
    /// A context starts to walk; never in a clock in which a completed visit may ask for visits.
    pub start: Signal<Out, Start>,
    /// The completed visit is the look at the first three points.
    pub looks: Signal<Out, Bit>,
    /// The context whose point the vertex memory gives in this clock; and a solo insertion that starts.
    pub fetched: Signal<Out, Fetched>,
    pub solo_start: Signal<Out, SoloStart>,
    /// A record or a link that a commit writes.
    pub write: Signal<Out, Write>,
    /// Records from `records` on are not written yet; `fresh` is the next new id.
    pub records: Signal<Out, TriangleId>,
    pub fresh: Signal<Out, TriangleId>,
    pub clear: Signal<Out, LockClear>,
    /// The lock memory is being cleared after reset.
    pub sweeps: Signal<Out, Bit>,
    /// Every point is finished; or the watchdog has reported (`stuck`).
    pub is_quiet: Signal<Out, Bit>,
    pub stuck: Signal<Out, Bit>,
    /// The events of this edge, except those that only the rest of the engine knows.
    pub events: Signal<Out, Events>,
    /// In a core with changes: an item of a run begins, whose context starts to walk; the mesh has been changed, and
    /// some point of an `Insert` is not finished; and the events that end items.
    pub launches: Vec<Signal<In, Bit>>,
    pub launch: Vec<Signal<In, Start>>,
    pub launch_context: Vec<Signal<In, ContextId>>,
    pub launch_vertex: Vec<Signal<In, VertexId>>,
    pub has_changed: Vec<Signal<In, Bit>>,
    pub is_pending: Vec<Signal<In, Bit>>,
    pub changes: Vec<Signal<Out, ChangeEvents>>,
    /// In such a core: ids are kept for the vertex of the item that begins. A run of deletions is under way, or one of
    /// moves, with the item that begins, or one of either (`hole_runs`). The visit that reads its record, and the
    /// vertices of its test. Whether the corners of the completed visit turn left, and the point against its sides. The
    /// point of a move in place that ends, or a vertex that is out of the mesh, with the word that takes the place of its
    /// point (`late_point`); the vertices that chains carry; a test that enters the queue; the two ids of a solo
    /// insertion; a vertex is put out of the mesh, or has come back. Such a point waits to be written (`late_waits`), so
    /// no vertex goes back into the mesh.
    pub launch_owns: Vec<Signal<In, Bit>>,
    pub deletes: Vec<Signal<In, Bit>>,
    pub moving: Vec<Signal<In, Moving>>,
    pub issued: Vec<Signal<In, Visit>>,
    pub test_vertices: Vec<Signal<Out, TestVertices>>,
    pub turns_left: Vec<Signal<In, Bit>>,
    pub sides: Vec<Signal<In, Sides>>,
    pub hole_runs: Vec<Signal<Out, Bit>>,
    pub late_point: Vec<Signal<Out, Arrival>>,
    pub carried: Vec<Signal<Out, Carried>>,
    pub fill_push: Vec<Signal<Out, Bundle>>,
    pub fill_pushes: Vec<Signal<Out, Bit>>,
    pub solo_first: Vec<Signal<Out, TriangleId>>,
    pub solo_second: Vec<Signal<Out, TriangleId>>,
    pub erases: Vec<Signal<Out, Bit>>,
    pub returns: Vec<Signal<Out, Bit>>,
    pub late_waits: Vec<Signal<In, Bit>>,
    holes: Vec<Holes>,
    merge: Vec<HoleMerge>,
    view: Vec<ChangeView>,
    dispatcher: Dispatcher,
    attempts: Attempts,
    commits: CommitPath,
    job: Signal<Local, CommitJob>,
    early_visit: Signal<Local, Visit>,
    visit_events: Signal<Local, VisitEvents>,
}

impl Insertions {
    pub fn new(config: Config) -> Self {
        Self {
            dispatcher: Dispatcher::new(config),
            attempts: Attempts::new(config),
            commits: CommitPath::new(config),
            ..Self::default()
        }
    }

    /// The insertions of a core with changes.
    pub fn with_changes(config: Config) -> Self {
        Self {
            dispatcher: Dispatcher::with_changes(config),
            attempts: Attempts::with_changes(config),
            launches: vec![Signal::default()],
            launch: vec![Signal::default()],
            launch_context: vec![Signal::default()],
            launch_vertex: vec![Signal::default()],
            has_changed: vec![Signal::default()],
            is_pending: vec![Signal::default()],
            changes: vec![Signal::default()],
            view: vec![ChangeView::default()],
            commits: CommitPath::with_deletions(config),
            launch_owns: vec![Signal::default()],
            deletes: vec![Signal::default()],
            moving: vec![Signal::default()],
            issued: vec![Signal::default()],
            test_vertices: vec![Signal::default()],
            turns_left: vec![Signal::default()],
            sides: vec![Signal::default()],
            hole_runs: vec![Signal::default()],
            late_waits: vec![Signal::default()],
            late_point: vec![Signal::default()],
            carried: vec![Signal::default()],
            fill_push: vec![Signal::default()],
            fill_pushes: vec![Signal::default()],
            solo_first: vec![Signal::default()],
            solo_second: vec![Signal::default()],
            erases: vec![Signal::default()],
            returns: vec![Signal::default()],
            holes: vec![Holes::new(config)],
            merge: vec![HoleMerge::default()],
            ..Self::new(config)
        }
    }
}

impl Logic for Insertions {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, dispatcher, attempts, commits);
        self.dispatcher.reset.next = self.reset.val();
        self.dispatcher.clears.next = self.clears.val();
        self.commits.reset.next = self.reset.val();
        self.commits.clears.next = self.clears.val();

        self.attempts.ring_capacity.next = self.limits.val().ring_capacity;
        self.attempts.early.next = self.early.val();
        self.attempts.completion.next = self.completion.val();
        self.attempts.seeded.next = self.seed.val().seeded;
        self.attempts.now.next = self.now.val();
        self.attempts.contexts.next = self.dispatcher.contexts.val();
        self.attempts.holds_priority.next = self.dispatcher.holds_priority.val();
        self.attempts.start.next = self.dispatcher.start.val();
        self.looks.next = self.attempts.looks.val();
        self.follow.next = self.attempts.follow.val();

        self.dispatcher.built_contexts.next = self.limits.val().built_contexts;
        self.dispatcher.patience.next = self.limits.val().patience;
        self.dispatcher.deal.next = self.deal.val();
        self.dispatcher.arrived.next = self.arrived.val();
        self.dispatcher.came.next = self.came.val();
        self.dispatcher.seed.next = self.seed.val();
        self.dispatcher.solo.next = self.solo.val();
        self.early_visit.next = self.early.val().visit;
        self.dispatcher.early_context.next = self.early_visit.val().context;
        self.dispatcher.is_done.next = self.attempts.is_done.val();
        self.dispatcher.outcome.next = self.attempts.outcome.val();
        self.dispatcher.may_ask.next = self.attempts.follow.val().may_ask;
        self.dispatcher.committed.next = self.commits.committed.val();
        self.dispatcher.released.next = self.commits.released.val();
        self.start.next = self.dispatcher.start.val();
        self.fetched.next = self.dispatcher.fetched.val();
        self.solo_start.next = self.dispatcher.solo_start.val();
        self.is_quiet.next = self.dispatcher.is_quiet.val();
        self.stuck.next = self.dispatcher.stuck.val();

        self.commits.last_id.next = self.limits.val().last_id;
        self.commits.seeds.next = self.seed.val().seeds;
        self.commits.solo_inserts.next = self.solo.val().inserts;
        self.commits.entry.next = self.attempts.entry.val();
        self.commits.inner.next = self.attempts.inner.val();
        self.commits.lock.next = self.attempts.lock.val();
        self.commits.commit.next = self.attempts.commit.val();
        self.commits.releases.next = self.attempts.releases.val();
        self.write.next = self.commits.write.val();
        self.records.next = self.commits.records.val();
        self.fresh.next = self.commits.fresh.val();
        self.clear.next = self.commits.clear.val();
        self.sweeps.next = self.commits.sweeps.val();

        // `Attempts` leaves the events of other blocks low; each event is filled in where it is known.
        self.visit_events.next = self.attempts.events.val();
        self.visit_events.next.test = self.attempts.events.val().test | self.solo.val().tests;
        self.visit_events.next.flip = self.solo.val().flips;
        self.visit_events.next.takes_priority = self.dispatcher.takes_priority.val();
        self.job.next = self.commits.committed.val().job;
        self.events.next.visits = self.visit_events.val();
        self.events.next.seeds = self.seed.val().seeds;
        self.events.next.commit_ends = self.commits.committed.val().valid;
        self.events.next.since = self.job.val().since;
        self.events.next.duplicate = self.attempts.outcome.val().duplicate;
        self.events.next.is_committing = self.commits.is_at_work.val();
        self.events.next.is_releasing = self.commits.clear.val().valid;
        self.events.next.solo_inserts = self.solo.val().inserts;
        self.events.next.solo_duplicate = self.solo.val().ends & (!self.solo.val().inserts);
        self.events.next.is_issuing = false;
        self.events.next.is_writing = false;

        for i in 0..self.launches.len() {
            self.dispatcher.launches[i].next = self.launches[i].val();
            self.dispatcher.launch[i].next = self.launch[i].val();
            self.dispatcher.launch_context[i].next = self.launch_context[i].val();
            self.dispatcher.launch_vertex[i].next = self.launch_vertex[i].val();
            self.dispatcher.has_changed[i].next = self.has_changed[i].val();
            self.dispatcher.is_pending[i].next = self.is_pending[i].val();
            self.view[i].outcome.next = self.attempts.outcome.val();
            self.view[i].commit.next = self.attempts.commit.val();
            self.view[i].vertex.next = self.attempts.vertex[i].val();
            self.view[i].may_ask.next = self.attempts.follow.val().may_ask;
            self.view[i].committed.next = self.commits.committed.val();
            self.view[i].solo.next = self.solo.val();
            self.view[i].contexts.next = self.dispatcher.contexts.val();
            self.view[i].start.next = self.dispatcher.own_start[i].val();
            self.view[i].wishes.next = self.dispatcher.wishes[i].val();
            self.changes[i].next = self.view[i].events.val();
        }

        for i in 0..self.holes.len() {
            self.holes[i].clock.next = self.clock.val();
            self.holes[i].reset.next = self.reset.val();
            self.holes[i].deletes.next = self.deletes[i].val();
            self.holes[i].moving.next = self.moving[i].val();
            self.holes[i].sides.next = self.sides[i].val();
            self.hole_runs[i].next = self.holes[i].runs.val();
            self.view[i].late_waits.next = self.late_waits[i].val();
            self.carried[i].next = self.holes[i].carried.val();
            self.commits.holds[i].next = self.holes[i].writes_next.val();
            self.merge[i].commits.next = self.attempts.commit.val().valid;
            self.view[i].finds.next = self.holes[i].finds.val();
            self.view[i].moved.next = self.holes[i].moved.val();
            self.view[i].moving.next = self.moving[i].val();
            self.holes[i].infinite.next = self.limits.val().infinite;
            self.holes[i].ring_capacity.next = self.limits.val().ring_capacity;
            self.holes[i].start.next = self.dispatcher.start.val();
            self.holes[i].early.next = self.early.val();
            self.holes[i].holds_priority.next = self.dispatcher.holds_priority.val();
            self.holes[i].completion.next = self.completion.val();
            self.holes[i].turns_left.next = self.turns_left[i].val();
            self.holes[i].issued.next = self.issued[i].val();
            self.test_vertices[i].next = self.holes[i].vertices.val();
            self.attempts.early_finds[i].next = self.holes[i].early_finds.val();
            self.attempts.finds[i].next = self.holes[i].finds.val();
            self.attempts.names[i].next = self.holes[i].names.val();
            self.attempts.is_free[i].next = self.holes[i].is_free.val();

            self.merge[i].is_done.next = self.holes[i].is_done.val();
            self.merge[i].opens_star.next = self.holes[i].opens_star.val();
            self.merge[i].follow.next = self.attempts.follow.val();
            self.merge[i].hole_follow.next = self.holes[i].follow.val();
            self.merge[i].outcome.next = self.attempts.outcome.val();
            self.merge[i].hole_outcome.next = self.holes[i].outcome.val();
            self.merge[i].lock.next = self.attempts.lock.val();
            self.merge[i].hole_lock.next = self.holes[i].lock.val();
            self.merge[i].attempt_release.next = self.attempts.releases.val();
            self.merge[i].hole_release.next = self.holes[i].releases.val();
            self.merge[i].may_settle.next = self.holes[i].may_settle.val();
            self.merge[i].ending.next = self.holes[i].ending.val();
            self.merge[i].erased.next = self.holes[i].erased.val();
            self.merge[i].wishes.next = self.dispatcher.wishes[i].val();
            self.view[i].fill_asks.next = self.holes[i].push_valid.val();
            self.merge[i].asks.next = self.holes[i].push_valid.val();
            self.merge[i].attempt_is_done.next = self.attempts.is_done.val();
            self.holes[i].may_end.next = self.merge[i].may_end.val();
            self.holes[i].pushes.next = self.merge[i].pushes.val();
            self.follow.next = self.merge[i].merged_follow.val();
            self.dispatcher.outcome.next = self.merge[i].merged_outcome.val();
            self.dispatcher.is_done.next = self.merge[i].merged_is_done.val();
            self.dispatcher.may_ask.next = self.merge[i].may_ask.val();
            self.dispatcher.fill_ends[i].next = self.merge[i].ends.val();
            self.dispatcher.fill_end[i].next = self.merge[i].granted.val();
            self.dispatcher.erases[i].next = self.merge[i].erases.val();
            self.commits.lock.next = self.merge[i].merged_lock.val();
            self.commits.releases.next = self.merge[i].merged_release.val();
            self.commits.erases[i].next = self.merge[i].erases.val();
            self.commits.erased[i].next = self.merge[i].erased_locks.val();
            self.commits.kept[i].next = self.holes[i].kept.val();
            self.commits.start[i].next = self.dispatcher.start.val();
            self.commits.owns[i].next = self.launches[i].val() & self.launch_owns[i].val();
            self.commits.solo_start[i].next = self.dispatcher.solo_start.val();
            self.commits.solo[i].next = self.solo.val();
            self.commits.moving[i].next = self.moving[i].val();
            self.commits.visit[i].next = self.completion.val().visit;
            self.commits.vertex[i].next = self.attempts.vertex[i].val();
            self.commits.is_duplicate[i].next = self.attempts.outcome.val().duplicate & (!self.holes[i].finds.val());
            self.view[i].owns.next = self.commits.owned[i].val();
            self.commits.moved[i].next = self.holes[i].moved.val();
            self.late_point[i].next = self.commits.late_point[i].val();
            self.solo_first[i].next = self.commits.solo_first[i].val();
            self.solo_second[i].next = self.commits.solo_second[i].val();
            self.erases[i].next = self.merge[i].erases.val();
            self.returns[i].next = self.commits.returns[i].val();
            self.fill_push[i].next = self.holes[i].push.val();
            self.fill_pushes[i].next = self.merge[i].pushes.val();
            self.view[i].outcome.next = self.merge[i].merged_outcome.val();
            self.view[i].may_ask.next = self.merge[i].may_ask.val();
            self.view[i].erased.next = self.holes[i].erased.val();
            self.view[i].fill_end.next = self.merge[i].granted.val();
            self.merge[i].write.next = self.commits.write.val();
            self.merge[i].hole_write.next = self.holes[i].write.val();
            self.write.next = self.merge[i].merged_write.val();
            if self.merge[i].is_done_now.val() {
                self.visit_events.next.aborts = self.merge[i].aborts.val();
                self.visit_events.next.revisit = self.merge[i].revisits.val();
            }
            self.events.next.visits = self.visit_events.val();
        }
    }
}
