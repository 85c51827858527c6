//! Hands points to contexts, and knows when every point is finished or the work has come to a halt.
//!
//! 1. The consequences of a visit for its context are noted a clock after the visit completes. From then on the context
//!    may start again, and its foreign locks count.

use super::context_flags::ContextFlags;
use super::finished_points::FinishedPoints;
use super::priorities::Priorities;
use super::starter::Starter;
use super::watchdog::Watchdog;
use crate::engine::types::{
    Clocks, Committed, ContextId, ContextSet, ContextState, Deal, Fetched, FillEnd, Outcome, Released, SeedProgress,
    SoloProgress, SoloStart, Start, VertexId,
};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct Dispatcher {
    pub clock: Signal<In, Clock>,
    /// Reset and clear put all contexts to sleep.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// Constants: the contexts that are built, and the number of clocks without a finished point before the watchdog
    /// reports.
    pub built_contexts: Signal<In, ContextSet>,
    pub patience: Signal<In, Clocks>,
    /// The rule by which points belong to contexts.
    pub deal: Signal<In, Deal>,
    /// The number of points that have come; a point is being stored at this edge (`came`).
    pub arrived: Signal<In, VertexId>,
    pub came: Signal<In, Bit>,
    /// The progress of the first triangles.
    pub seed: Signal<In, SeedProgress>,
    /// The context of the visit that completes in the next clock; it holds the priority of its team.
    pub early_context: Signal<In, ContextId>,
    pub holds_priority: Signal<Out, Bit>,
    /// A visit completes, with these consequences; while it may ask for visits (`may_ask`), no context starts.
    pub is_done: Signal<In, Bit>,
    pub outcome: Signal<In, Outcome>,
    pub may_ask: Signal<In, Bit>,
    /// The last write of a commit is requested; or the last lock of a context is cleared.
    pub committed: Signal<In, Committed>,
    pub released: Signal<In, Released>,
    /// The progress of a solo insertion.
    pub solo: Signal<In, SoloProgress>,
    /// A context that starts to walk, and later the coordinates of the point that it has taken.
    pub start: Signal<Out, Start>,
    pub fetched: Signal<Out, Fetched>,
    /// The state of all contexts.
    pub contexts: Signal<Out, ContextState>,
    /// A context starts the solo insertion of its point.
    pub solo_start: Signal<Out, SoloStart>,
    /// The priority is taken at this edge, for the counters.
    pub takes_priority: Signal<Out, Bit>,
    /// Every point is finished; or the watchdog has reported (`stuck`).
    pub is_quiet: Signal<Out, Bit>,
    pub stuck: Signal<Out, Bit>,
    /// In a core with changes: an item of a run begins, whose context starts to walk; a context that starts without one
    /// (`own_start`), or would if the queue is free (`wishes`); and what [`FinishedPoints`] and [`Starter`] must know.
    pub launches: Vec<Signal<In, Bit>>,
    pub launch: Vec<Signal<In, Start>>,
    pub launch_context: Vec<Signal<In, ContextId>>,
    pub launch_vertex: Vec<Signal<In, VertexId>>,
    pub own_start: Vec<Signal<Out, Start>>,
    pub wishes: Vec<Signal<Out, Bit>>,
    pub has_changed: Vec<Signal<In, Bit>>,
    pub is_pending: Vec<Signal<In, Bit>>,
    /// In such a core: an item ends with its hole; and the last write of a deletion is requested.
    pub fill_ends: Vec<Signal<In, Bit>>,
    pub fill_end: Vec<Signal<In, FillEnd>>,
    pub erases: Vec<Signal<In, Bit>>,
    found: DFF<Outcome>,
    taken1: DFF<Bit>,
    taken2: DFF<Bit>,
    taker1: DFF<ContextId>,
    taker2: DFF<ContextId>,
    flags: ContextFlags,
    priorities: Priorities,
    starter: Starter,
    finished_points: FinishedPoints,
    watchdog: Watchdog,
}

impl Dispatcher {
    pub fn new(config: Config) -> Self {
        Self { starter: Starter::new(config), priorities: Priorities::new(config), ..Self::default() }
    }

    /// The dispatcher of a core with changes.
    pub fn with_changes(config: Config) -> Self {
        Self {
            starter: Starter::with_changes(config),
            flags: ContextFlags::with_changes(),
            priorities: Priorities::with_changes(config),
            fill_ends: vec![Signal::default()],
            fill_end: vec![Signal::default()],
            erases: vec![Signal::default()],
            finished_points: FinishedPoints::with_changes(),
            launches: vec![Signal::default()],
            launch: vec![Signal::default()],
            launch_context: vec![Signal::default()],
            launch_vertex: vec![Signal::default()],
            own_start: vec![Signal::default()],
            wishes: vec![Signal::default()],
            has_changed: vec![Signal::default()],
            is_pending: vec![Signal::default()],
            ..Self::new(config)
        }
    }
}

impl Logic for Dispatcher {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, found, taken1, taken2, taker1, taker2);
        clock!(self, clock, flags, priorities, starter, finished_points, watchdog);
        self.flags.reset.next = self.reset.val();
        self.starter.reset.next = self.reset.val();
        self.finished_points.reset.next = self.reset.val();
        self.watchdog.reset.next = self.reset.val();
        self.flags.clears.next = self.clears.val();
        self.starter.clears.next = self.clears.val();
        self.finished_points.clears.next = self.clears.val();

        // The outcome of a visit is known late in the clock, so all flags take it from a register.
        self.found.d.next = self.outcome.val();
        if self.reset.val() {
            self.found.d.next.sleeps = false;
            self.found.d.next.will_retry = false;
            self.found.d.next.hands_over = false;
            self.found.d.next.asks_for_priority = false;
            self.found.d.next.waits = false;
            self.found.d.next.returns_priority = false;
            self.found.d.next.overflows = false;
            self.found.d.next.duplicate = false;
        }

        self.flags.built_contexts.next = self.built_contexts.val();
        self.flags.outcome.next = self.found.q.val();
        self.flags.start.next = self.starter.start.val();
        self.flags.released.next = self.released.val();
        self.flags.committed.next = self.committed.val();
        self.flags.solo_ends.next = self.solo.val().ends;
        self.flags.solo_context.next = self.solo.val().context;
        self.contexts.next = self.flags.contexts.val();

        self.priorities.planned.next = self.starter.planned.val();
        self.priorities.early_context.next = self.early_context.val();
        self.priorities.outcome.next = self.found.q.val();
        self.priorities.passed.next = self.starter.passed.val();
        self.holds_priority.next = self.priorities.holds_priority.val();
        self.takes_priority.next = self.priorities.takes_priority.val();
        self.starter.may_retry.next = self.priorities.may_retry.val();

        self.starter.deal.next = self.deal.val();
        self.starter.arrived.next = self.arrived.val();
        self.starter.came.next = self.came.val();
        self.starter.seeded.next = self.seed.val().seeded;
        self.starter.contexts.next = self.flags.contexts.val();
        self.starter.solo_is_at_work.next = self.solo.val().is_at_work;
        self.starter.is_done.next = self.is_done.val();
        self.starter.is_blocked.next = self.may_ask.val();
        self.starter.outcome.next = self.found.q.val();
        self.start.next = self.starter.start.val();
        self.solo_start.next = self.starter.solo_start.val();

        // The vertex memory answers after 2 clocks, so the context is delayed as long.
        self.taken1.d.next = self.starter.start.val().takes & (!self.reset.val());
        self.taken2.d.next = self.taken1.q.val() & (!self.reset.val());
        self.taker1.d.next = self.starter.start.val().context;
        self.taker2.d.next = self.taker1.q.val();
        self.fetched.next.valid = self.taken2.q.val();
        self.fetched.next.context = self.taker2.q.val();

        self.finished_points.arrived.next = self.arrived.val();
        self.finished_points.seeds.next = self.seed.val().seeds;
        self.finished_points.commit_ends.next = self.committed.val().valid;
        self.finished_points.solo_ends.next = self.solo.val().ends;
        self.finished_points.duplicate.next = self.found.q.val().duplicate;
        self.finished_points.has_no_start.next = self.seed.val().has_no_start;
        self.finished_points.all_rest.next = self.flags.contexts.val().all_rest;
        self.is_quiet.next = self.finished_points.is_quiet.val();
        self.watchdog.patience.next = self.patience.val();
        self.watchdog.finishes.next = self.finished_points.finishes.val();
        self.watchdog.is_quiet.next = self.finished_points.is_quiet.val();
        self.stuck.next = self.watchdog.stuck.val();
        for i in 0..self.launches.len() {
            self.starter.only_retries[i].next = self.has_changed[i].val();
            self.starter.launches[i].next = self.launches[i].val();
            self.starter.launch_context[i].next = self.launch_context[i].val();
            self.starter.launch_vertex[i].next = self.launch_vertex[i].val();
            self.own_start[i].next = self.starter.start.val();
            self.wishes[i].next = self.starter.wishes[i].val();
            if self.launches[i].val() {
                self.start.next = self.launch[i].val();
                self.flags.start.next = self.launch[i].val();
            }
            self.finished_points.has_changed[i].next = self.has_changed[i].val();
            self.finished_points.is_pending[i].next = self.is_pending[i].val();
            self.flags.fill_end[i].next = self.fill_end[i].val();
            self.priorities.fill_end[i].next = self.fill_end[i].val();
            if self.fill_ends[i].val() | self.erases[i].val() {
                self.watchdog.finishes.next = true;
            }
        }
    }
}
