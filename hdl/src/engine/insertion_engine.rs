//! The insertion engine: accepts points, keeps the triangle records, and has many insertions in flight on one pipeline.
//!
//! ```text
//!                 +------- PushPort <-----+--------------+
//!                 v                       | visits       | visits
//!  points -> VisitPipeline -+-------> Insertions       Solo <-+
//!                 ^         |             | stars        |    |
//!                 |         +-> Seeder    |              |    | completed visits
//!                 |         |     | first triangles      |    |
//!                 |         +-----|-------|--------------|----+
//!                 |               v       v              v
//!                 +------------ WritePort: one record or one link in each clock
//! ```
//! Only `Insertions` sets and clears locks: by its visits, and by `clear` into `VisitPipeline`.

use super::holes::LatePoint;
use super::insertions::Insertions;
use super::seed::Seeder;
use super::solo::Solo;
use super::types::{
    Arrival, Bundle, ChangeEvents, Clocks, Completion, ContextId, Deal, EngineState, Events, Limits, Moving,
    NearVerdict, Position, RecordRead, Start, Verdict, VertexId, Write,
};
use super::visit::{PushPort, VisitPipeline};
use super::write::WritePort;
use crate::mesh::ReadRecord;
use crate::predicate::{Point, Sides};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct InsertionEngine {
    pub clock: Signal<In, Clock>,
    /// Reset forgets everything except the memories, and starts the sweep that clears all locks.
    pub reset: Signal<In, Bit>,
    pub limits: Signal<In, Limits>,
    /// The rule by which points belong to contexts; changes only together with `clears`.
    pub deal: Signal<In, Deal>,
    /// The mesh is forgotten at this edge; only while the engine is quiet.
    pub clears: Signal<In, Bit>,
    /// A point that is stored at this edge, and the number of points that have come.
    pub arrival: Signal<In, Arrival>,
    pub arrived: Signal<In, VertexId>,
    /// A record that the read-out wants, only while the engine is quiet; and the record that has been read.
    pub read: Signal<In, RecordRead>,
    pub read_out: Signal<Out, ReadRecord>,
    /// The clock count, from which latencies are taken.
    pub now: Signal<In, Clocks>,
    pub state: Signal<Out, EngineState>,
    /// The write port of the triangle memory, for those who watch the mesh from outside.
    pub write: Signal<Out, Write>,
    /// The events of this edge, for the counters.
    pub events: Signal<Out, Events>,
    /// In a core that answers questions: a run of them is under way, which it is only while the engine is quiet. All
    /// visits are theirs then. A question asks for the visit, or begins with a place; and the visit that completes,
    /// with signs and values of its three orient2d, for the corners as stored, and the search for the nearest vertex.
    pub question_runs: Vec<Signal<In, Bit>>,
    pub question_asks: Vec<Signal<In, Bit>>,
    pub question: Vec<Signal<In, Bundle>>,
    pub question_place: Vec<Signal<In, Position>>,
    pub completed: Vec<Signal<Out, Completion>>,
    pub sides: Vec<Signal<Out, Sides>>,
    pub nearest: Vec<Signal<Out, NearVerdict>>,
    /// An item of a run of changes begins: its context starts to walk (`launch`), to the place of `question_place`. In
    /// the clock after, its point may have to be stored (`launch_stores`). The mesh has been changed, and some point of
    /// an `Insert` is not finished; a run of changes is under way; and the events that end items.
    pub launches: Vec<Signal<In, Bit>>,
    pub launch: Vec<Signal<In, Start>>,
    pub launch_stores: Vec<Signal<In, Bit>>,
    pub launch_arrival: Vec<Signal<In, Arrival>>,
    pub launch_context: Vec<Signal<In, ContextId>>,
    pub launch_vertex: Vec<Signal<In, VertexId>>,
    pub has_changed: Vec<Signal<In, Bit>>,
    pub is_pending: Vec<Signal<In, Bit>>,
    pub change_runs: Vec<Signal<In, Bit>>,
    pub changes: Vec<Signal<Out, ChangeEvents>>,
    /// Ids are kept for the vertex of the item that begins. A run of deletions is under way, or one of moves. A vertex
    /// whose point is wanted, unless the engine itself fetches one (`fetches`), and its point two clocks later. A
    /// vertex is deleted, or has come back with the ids that were kept for it.
    pub launch_owns: Vec<Signal<In, Bit>>,
    pub deletes: Vec<Signal<In, Bit>>,
    pub moving: Vec<Signal<In, Moving>>,
    pub wanted: Vec<Signal<In, VertexId>>,
    pub fetches: Vec<Signal<Out, Bit>>,
    pub fetched: Vec<Signal<Out, Point>>,
    pub erases: Vec<Signal<Out, Bit>>,
    pub returns: Vec<Signal<Out, Bit>>,
    insertions: Insertions,
    late: Vec<LatePoint>,
    pipeline: VisitPipeline,
    solo: Solo,
    seeder: Seeder,
    push_port: PushPort,
    write_port: WritePort,
    completion: Signal<Local, Completion>,
    verdict: Signal<Local, Verdict>,
}

impl InsertionEngine {
    /// Builds the engine of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { insertions: Insertions::new(config), pipeline: VisitPipeline::new(config), ..Self::default() }
    }

    /// Builds the engine of a core that answers questions.
    pub fn with_runs(config: Config) -> Self {
        Self {
            pipeline: VisitPipeline::with_sides(config),
            push_port: PushPort::with_runs(),
            question_runs: vec![Signal::default()],
            question_asks: vec![Signal::default()],
            question: vec![Signal::default()],
            question_place: vec![Signal::default()],
            completed: vec![Signal::default()],
            sides: vec![Signal::default()],
            nearest: vec![Signal::default()],
            insertions: Insertions::with_changes(config),
            launches: vec![Signal::default()],
            launch: vec![Signal::default()],
            launch_stores: vec![Signal::default()],
            launch_arrival: vec![Signal::default()],
            launch_context: vec![Signal::default()],
            launch_vertex: vec![Signal::default()],
            has_changed: vec![Signal::default()],
            is_pending: vec![Signal::default()],
            change_runs: vec![Signal::default()],
            solo: Solo::with_deletions(),
            launch_owns: vec![Signal::default()],
            deletes: vec![Signal::default()],
            moving: vec![Signal::default()],
            late: vec![LatePoint::default()],
            wanted: vec![Signal::default()],
            fetches: vec![Signal::default()],
            fetched: vec![Signal::default()],
            erases: vec![Signal::default()],
            returns: vec![Signal::default()],
            changes: vec![Signal::default()],
            ..Self::new(config)
        }
    }
}

impl Logic for InsertionEngine {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, insertions, pipeline, solo, seeder, push_port, write_port);
        self.insertions.reset.next = self.reset.val();
        self.pipeline.reset.next = self.reset.val();
        self.solo.reset.next = self.reset.val();
        self.seeder.reset.next = self.reset.val();
        self.push_port.reset.next = self.reset.val();
        self.write_port.reset.next = self.reset.val();
        self.insertions.clears.next = self.clears.val();
        self.seeder.clears.next = self.clears.val();

        self.state.next.start_is_open = self.seeder.start_is_open.val();
        self.state.next.collinear = self.seeder.collinear.val();
        self.state.next.is_quiet = self.insertions.is_quiet.val();
        self.state.next.stuck = self.insertions.stuck.val();
        self.state.next.sweeps = self.insertions.sweeps.val();
        self.state.next.records = self.insertions.records.val();
        self.read_out.next = self.pipeline.read_out.val();
        self.write.next = self.write_port.write.val();

        self.completion.next = self.pipeline.completion.val();
        self.verdict.next = self.pipeline.completion.val().verdict;
        self.pipeline.infinite.next = self.limits.val().infinite;
        self.pipeline.records.next = self.insertions.records.val();
        self.pipeline.push.next = self.push_port.push.val();
        self.pipeline.position.next.valid = self.insertions.fetched.val().valid;
        self.pipeline.position.next.context = self.insertions.fetched.val().context;
        self.pipeline.position.next.point = self.pipeline.fetched.val();
        self.pipeline.read.next = self.read.val();
        self.pipeline.write.next = self.write_port.write.val();
        self.pipeline.enables.next = self.write_port.enables.val();
        self.pipeline.arrival.next = self.arrival.val();
        self.pipeline.fetch_id.next = self.insertions.start.val().id;
        self.pipeline.clear.next = self.insertions.clear.val();

        // The progress of a solo insertion may mask `early` a clock ahead, for it changes only with no visit in flight.
        self.insertions.limits.next = self.limits.val();
        self.insertions.deal.next = self.deal.val();
        self.insertions.arrived.next = self.arrived.val();
        self.insertions.came.next = self.arrival.val().came;
        self.insertions.now.next = self.now.val();
        self.insertions.early.next = self.pipeline.early.val();
        self.insertions.early.next.done =
            self.pipeline.early.val().done & (!self.solo.progress.val().is_at_work) & (!self.reset.val());
        self.insertions.completion.next = self.completion.val();
        self.insertions.seed.next = self.seeder.progress.val();
        self.insertions.solo.next = self.solo.progress.val();

        self.seeder.infinite.next = self.limits.val().infinite;
        self.seeder.deal.next = self.deal.val();
        self.seeder.arrival.next = self.arrival.val();
        self.seeder.arrived.next = self.arrived.val();
        self.seeder.looks.next = self.insertions.looks.val();
        self.seeder.verdict.next = self.verdict.val();
        self.solo.start.next = self.insertions.solo_start.val();
        self.solo.records.next = self.insertions.fresh.val();
        self.solo.completion.next = self.completion.val();

        self.push_port.follow.next = self.insertions.follow.val();
        self.push_port.start.next = self.insertions.start.val();
        self.push_port.solo_is_at_work.next = self.solo.progress.val().is_at_work;
        self.push_port.solo.next = self.solo.push.val();
        self.write_port.commit.next = self.insertions.write.val();
        self.write_port.solo.next = self.solo.write.val();
        self.write_port.seed.next = self.seeder.write.val();
        self.events.next = self.insertions.events.val();
        self.events.next.is_issuing = self.pipeline.is_issuing.val();
        self.events.next.is_writing = self.write_port.write.val().valid;

        // The visits of a question go through the pipeline alone: no other block sees them, and they are not counted.
        for i in 0..self.question_runs.len() {
            self.push_port.question_asks[i].next = self.question_asks[i].val();
            self.push_port.question[i].next = self.question[i].val();
            if self.question_runs[i].val() {
                self.pipeline.position.next = self.question_place[i].val();
                self.insertions.early.next.done = false;
                self.events.next.is_issuing = false;
            }
            self.completed[i].next = self.pipeline.completion.val();
            self.sides[i].next = self.pipeline.sides[i].val();
            self.nearest[i].next = self.pipeline.nearest[i].val();
        }

        // An item of a run of changes is an insertion whose vertex and point do not come from the vertex memory. The
        // counters leave out its duplicate, because the vertex keeps no id.
        for i in 0..self.launches.len() {
            self.insertions.launches[i].next = self.launches[i].val();
            self.insertions.launch[i].next = self.launch[i].val();
            self.insertions.launch_context[i].next = self.launch_context[i].val();
            self.insertions.launch_vertex[i].next = self.launch_vertex[i].val();
            self.insertions.has_changed[i].next = self.has_changed[i].val();
            self.insertions.is_pending[i].next = self.is_pending[i].val();
            self.changes[i].next = self.insertions.changes[i].val();
            if self.launches[i].val() {
                self.pipeline.position.next = self.question_place[i].val();
            }
            if self.launch_stores[i].val() {
                self.pipeline.arrival.next = self.launch_arrival[i].val();
            }
            self.insertions.launch_owns[i].next = self.launch_owns[i].val();
            self.insertions.deletes[i].next = self.deletes[i].val();
            self.insertions.issued[i].next = self.pipeline.issued[i].val();
            self.insertions.turns_left[i].next = self.pipeline.turns_left[i].val();
            self.pipeline.hole_runs[i].next =
                self.insertions.hole_runs[i].val() & (!self.solo.progress.val().is_at_work);
            self.insertions.moving[i].next = self.moving[i].val();
            self.insertions.sides[i].next = self.pipeline.sides[i].val();
            self.pipeline.moving[i].next = self.moving[i].val();
            self.pipeline.start[i].next = self.insertions.start.val();
            self.pipeline.carried[i].next = self.insertions.carried[i].val();
            self.late[i].clock.next = self.clock.val();
            self.late[i].reset.next = self.reset.val();
            self.late[i].comes.next = self.insertions.late_point[i].val();
            self.late[i].fetches.next = self.pipeline.fetches[i].val();
            self.insertions.late_waits[i].next = self.late[i].waits.val();
            if self.late[i].writes.val() {
                self.pipeline.arrival.next = self.late[i].arrival.val();
            }
            self.pipeline.test_vertices[i].next = self.insertions.test_vertices[i].val();
            // Fetches and writes of points share a port. While a point waits, nobody else may read its vertex.
            self.fetches[i].next =
                self.pipeline.fetches[i].val() | self.late[i].waits.val() | self.launch_stores[i].val();
            self.fetched[i].next = self.pipeline.fetched.val();
            self.erases[i].next = self.insertions.erases[i].val();
            self.returns[i].next = self.insertions.returns[i].val();
            self.solo.records.next = self.insertions.solo_first[i].val();
            self.solo.own_third[i].next = self.insertions.solo_second[i].val();
            if self.change_runs[i].val() {
                self.pipeline.fetch_id.next = self.wanted[i].val();
            }
            if self.insertions.fill_pushes[i].val() {
                self.push_port.question_asks[i].next = true;
                self.push_port.question[i].next = self.insertions.fill_push[i].val();
            }
            if self.change_runs[i].val() {
                self.events.next.duplicate = false;
                self.events.next.solo_duplicate = false;
            }
        }
    }
}
