//! Wakes sleeping contexts: a pointer goes round them, one a clock, and a walk starts where one is due.
//!
//! 1. A context starts a retry if it is asleep, keeps its point, has no commit or release due, and has rested. Retries
//!    start only in every fourth round of the pointer, which spreads them (L1), and not beside a context that has
//!    waited for long (L3).
//! 2. A context starts with a new point if it is asleep, has none, and its next point has come. Until the first context
//!    of a team has taken point 16 of its job, no other context of the team works (L8).
//! 3. A start waits while the queue or the port of the vertex memory may be taken. While a start is due, the pointer
//!    waits in every clock in which a visit completes, because the visits that follow are known late.
//! 4. The walk of a retry starts at the root of the context's last attempt, and so does the walk to a new point if the
//!    context has had a commit. Otherwise the walk starts at the first record of the context's mesh.
//! 5. A context that asks for a solo insertion starts it when all contexts rest, none is at work, and the pointer has
//!    passed the context.
//! 6. While the pointer goes round for the first time no context starts: `PlanTable` writes down the first vertex of
//!    each.
//! 7. The pointer is two contexts ahead. In the clock after it has stood at a context, the next vertex of that context
//!    is there, and the starter decides whether the context is due and where it would start. In the clock after that
//!    the context starts, unless the queue is taken.
//!
//! Latency: 2 clocks from the pointer to `starts`.
//!
//! There are two contexts. Context 0 takes vertex 2 when that has come, the pointer has gone round once and the queue
//! is free. Then context 0 falls asleep, keeps its point, and retries from record 9 in the next fourth round:
//! ```text
//! arrived           2  3  3  3  3  3  3  3  3  3  3  3  3  3  3  3
//! came            ___/^^\_________________________________________
//! is_done         ____________/^^^^^\_____________________________
//! is_blocked      ____________/^^\________________________________
//! asleep            3  3  3  3  3  3  2  2  3  3  3  3  3  2  2  2
//! retrying          0  0  0  0  0  0  0  0  1  1  1  1  1  0  0  0
//! context           .  .  0  1  0  0  0  1  0  1  0  1  0  1  0  1
//! starts          _______________/^^\_________________/^^\________
//! takes           _______________/^^\_____________________________
//! taken_id          .  .  .  .  .  2  .  .  .  .  .  .  .  .  .  .
//! record            .  .  .  .  .  0  .  .  .  .  .  .  9  .  .  .
//! ```
//!
//! Source: points that are dealt to contexts lie in the vertex memory, which is the queue of all contexts.

use super::due_check::DueCheck;
use super::next_point::{Passed, Planned};
use super::open_teams::OpenTeams;
use super::plan_table::PlanTable;
use super::start_pointer::StartPointer;
use crate::engine::types::{
    context_bits, ContextId, ContextSet, ContextState, Deal, Outcome, SoloStart, Start, TriangleId, VertexId,
    CONTEXT_BITS, TRIANGLE_BITS, VERTEX_BITS,
};
use crate::leaf::LutMemory;
use crate::prelude::*;
use incircle_protocol::Config;

crate::packed! {
    /// A context two clocks behind the pointer, with all that its start needs.
    pub struct Candidate {
        pub context: ContextId,
        pub team: ContextId,
        pub id: VertexId,
        /// The vertex `id` is none of the first 16 of its job; the context takes `plan` after it.
        pub is_dealt: bool,
        pub plan: VertexId,
        /// The point that the context has.
        pub point: VertexId,
        /// The record at which the walk would start.
        pub from: TriangleId,
        /// The context asks for a solo insertion.
        pub is_solo: bool,
    }
}

#[derive(LogicBlock, Default)]
pub struct Starter {
    pub clock: Signal<In, Clock>,
    /// Reset and clear bring the pointer back to context 0.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// The rule by which points belong to contexts.
    pub deal: Signal<In, Deal>,
    /// The number of points that have come; a point is being stored (`came`) and takes the port of the vertex memory.
    pub arrived: Signal<In, VertexId>,
    pub came: Signal<In, Bit>,
    /// Every first triangle is in the mesh.
    pub seeded: Signal<In, Bit>,
    /// The state of all contexts.
    pub contexts: Signal<In, ContextState>,
    /// No other context of the team of `passed` has waited for long.
    pub may_retry: Signal<In, Bit>,
    /// A solo insertion is at work.
    pub solo_is_at_work: Signal<In, Bit>,
    /// A visit completes; the queue may be taken at this edge by the visits that follow (`is_blocked`).
    pub is_done: Signal<In, Bit>,
    pub is_blocked: Signal<In, Bit>,
    /// The consequences of a visit, among them the record at which the next walk starts.
    pub outcome: Signal<In, Outcome>,
    /// In the first round of the pointer, a context and its team; and the context that the pointer has left last.
    pub planned: Signal<Out, Planned>,
    pub passed: Signal<Out, Passed>,
    /// A context that starts to walk.
    pub start: Signal<Out, Start>,
    /// A context starts the solo insertion of its point.
    pub solo_start: Signal<Out, SoloStart>,
    /// In a core with changes: contexts take no points here, because all points come as items of runs; and the context
    /// that begins an item, with its vertex.
    pub only_retries: Vec<Signal<In, Bit>>,
    pub launches: Vec<Signal<In, Bit>>,
    pub launch_context: Vec<Signal<In, ContextId>>,
    pub launch_vertex: Vec<Signal<In, VertexId>>,
    /// In such a core: a context starts in this clock unless the queue or the port is taken; known sooner than `start`.
    pub wishes: Vec<Signal<Out, Bit>>,
    /// The context that the pointer has left last, and the point that it has.
    left: DFF<Passed>,
    left_point: DFF<VertexId>,
    /// The context before that one; it is due for a retry (`wants_again`) or with a new point (`wants_new`).
    candidate: DFF<Candidate>,
    wants_again: DFF<Bit>,
    wants_new: DFF<Bit>,
    teams: OpenTeams,
    points: LutMemory<CONTEXT_BITS, VERTEX_BITS>,
    roots: LutMemory<CONTEXT_BITS, TRIANGLE_BITS>,
    pointer: StartPointer,
    plans: PlanTable,
    check: DueCheck,
    contexts_at_work: Signal<Local, ContextId>,
    wants: Signal<Local, Bit>,
    lacks_port: Signal<Local, Bit>,
    begins: Signal<Local, Bit>,
    moves: Signal<Local, Bit>,
    is_taken: Signal<Local, Bit>,
    solo: Signal<Local, ContextSet>,
    index: Signal<Local, ContextId>,
    one_turn: Signal<Local, ContextId>,
}

impl Starter {
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        let table = || LutMemory::new(bits, VERTEX_BITS);
        Self {
            teams: OpenTeams::new(config),
            points: table(),
            plans: PlanTable::new(config),
            roots: table(),
            ..Self::default()
        }
    }

    /// The starter of a core with changes.
    pub fn with_changes(config: Config) -> Self {
        Self {
            only_retries: vec![Signal::default()],
            launches: vec![Signal::default()],
            launch_context: vec![Signal::default()],
            launch_vertex: vec![Signal::default()],
            wishes: vec![Signal::default()],
            ..Self::new(config)
        }
    }
}

impl Logic for Starter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left, left_point, candidate, wants_again, wants_new);
        clock!(self, clock, points, pointer, plans, roots, teams);
        self.one_turn.next = 1.into();
        self.contexts_at_work.next = self.deal.val().contexts;
        self.solo.next = self.contexts.val().solo;
        self.index.next = self.left.q.val().context;

        self.points.read_address.next = self.pointer.pointer.val().turn;
        self.plans.pointer.next = self.pointer.pointer.val();
        self.plans.is_planned.next = self.pointer.is_planned.val();
        self.plans.passed.next = self.left.q.val();
        self.plans.deal.next = self.deal.val();
        self.pointer.restarts.next = self.reset.val() | self.clears.val();
        self.pointer.deal.next = self.deal.val();
        self.planned.next = self.pointer.planned.val();
        self.teams.planned.next = self.pointer.planned.val();
        self.passed.next = self.left.q.val();

        self.check.contexts.next = self.contexts.val();
        self.check.passed.next = self.left.q.val();
        self.check.arrived.next = self.arrived.val();
        self.check.seeded.next = self.seeded.val();
        self.check.is_planned.next = self.pointer.is_planned.val();
        self.check.rests_over.next = self.pointer.rests_over.val();
        self.teams.asked.next = self.left.q.val().team;
        self.check.is_open.next = self.teams.is_open.val();
        self.check.may_retry.next = self.may_retry.val();
        self.check.may_be_starting.next =
            (self.wants_again.q.val() | self.wants_new.q.val()) & (self.contexts_at_work.val() == self.one_turn.val());
        self.roots.read_address.next = self.left.q.val().context;

        // The pointer moves on `is_done` and not on `is_blocked`, which comes too late in the clock to steer it. A
        // start that is made while the pointer waits must not be made twice, so each start clears its own wish below.
        self.wants.next = (self.wants_again.q.val() | self.wants_new.q.val()) & (!self.contexts.val().solo_valid);
        self.lacks_port.next = self.wants_new.q.val() & self.came.val();
        self.moves.next = !(self.wants.val() & (self.is_done.val() | self.lacks_port.val()));
        self.pointer.moves.next = self.moves.val();
        self.begins.next = self.wants.val() & (!self.is_blocked.val()) & (!self.lacks_port.val());
        self.is_taken.next = self.wants_new.q.val() & self.begins.val();
        self.start.next.valid = self.begins.val();
        self.start.next.context = self.candidate.q.val().context;
        self.start.next.record = self.candidate.q.val().from;
        self.start.next.takes = self.is_taken.val();
        self.start.next.id = self.candidate.q.val().id;
        self.solo_start.next.valid =
            self.contexts.val().all_rest & (!self.solo_is_at_work.val()) & self.candidate.q.val().is_solo;
        self.solo_start.next.context = self.candidate.q.val().context;
        self.solo_start.next.vertex = self.candidate.q.val().point;
        self.solo_start.next.record = self.candidate.q.val().from;

        self.points.write_address.next = self.candidate.q.val().context;
        self.points.write_data.next = self.candidate.q.val().id;
        self.points.write_enable.next = self.is_taken.val();
        self.plans.write.next.valid = self.is_taken.val();
        self.plans.write.next.context = self.candidate.q.val().context;
        self.plans.write.next.id = self.candidate.q.val().plan;
        self.roots.write_address.next = self.outcome.val().context;
        self.roots.write_data.next = self.outcome.val().root;
        self.roots.write_enable.next = self.outcome.val().root_enable;

        // L8: the first context of a team alone takes points until it has taken point 16 of its job.
        self.teams.opens.next = self.is_taken.val() & self.candidate.q.val().is_dealt;
        self.teams.opened.next = self.candidate.q.val().team;
        if self.begins.val() {
            self.wants_again.d.next = false;
            self.wants_new.d.next = false;
        }
        if self.moves.val() {
            self.candidate.d.next.context = self.left.q.val().context;
            self.candidate.d.next.id = self.left.q.val().id;
            self.candidate.d.next.team = self.left.q.val().team;
            self.candidate.d.next.is_dealt = self.left.q.val().is_dealt;
            self.candidate.d.next.plan = self.plans.following.val().id;
            self.candidate.d.next.point = self.left_point.q.val();
            self.wants_again.d.next = self.check.wants_again.val();
            self.wants_new.d.next = self.check.wants_new.val();
            self.candidate.d.next.is_solo =
                self.solo.val().get_bit(self.index.val().index()) & (!self.solo_is_at_work.val());
            self.candidate.d.next.from = self.plans.following.val().first_record;
            if self.check.has_root.val() {
                self.candidate.d.next.from = self.roots.read_data.val();
            }
            self.left.d.next = self.plans.shown.val();
            self.left_point.d.next = self.points.read_data.val();
        }
        for i in 0..self.launches.len() {
            self.wishes[i].next = self.wants.val();
            if self.only_retries[i].val() {
                self.wants_new.d.next = false;
            }
            if self.launches[i].val() {
                self.points.write_address.next = self.launch_context[i].val();
                self.points.write_data.next = self.launch_vertex[i].val();
                self.points.write_enable.next = true;
            }
        }
        if self.reset.val() | self.clears.val() {
            self.wants_again.d.next = false;
            self.wants_new.d.next = false;
            self.candidate.d.next.is_solo = false;
        }
    }
}
