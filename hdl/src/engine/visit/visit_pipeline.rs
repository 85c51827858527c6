//! The whole path of a visit: queue, triangle memory with locks, rotation, vertex memory, predicates, verdict.
//!
//! 1. Every visit takes the same time. So visits complete in the order of their issue, at most one a clock.
//! 2. A visit whose record is written in the clock in which it is issued, or is not written yet, completes with
//!    `turned.again` (L7). Vertices, neighbours and slot of `turned` and the whole `verdict` are arbitrary then, but
//!    `took` and `foreign` are valid.
//! 3. A visit is judged by the point that its context has 4 clocks after the issue. The user changes that point only
//!    while none of the context's visits is in flight. The star of a vertex that moves has another point, and other
//!    corners ([`MovedStar`]).
//! 4. A read-out never meets a write of its record at one edge, because the user reads only while no
//!    insertion is at work.
//!
//! Latency: `STAGES` = 16 clocks from the issue register to `completion`, 17 from `push`, and 18 round the loop, with
//! the register that drives `push`. The record is there after 2 clocks, the corners after 5, the signs after 15. A
//! read-out takes 3 clocks from `read` to `read_out`.
//!
//! A bundle of two visits of context 1, then a read-out:
//! ```text
//! push            /^^\____________________________________________________________________
//! bundle.context    1  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .
//! bundle.entry      1  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .
//! is_issuing      ___/^^^^^\______________________________________________________________
//! done            ___________________________________________________/^^^^^\______________
//! visit.context     .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  1  1  .  .  .  .  .
//! visit.entry       .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  1  2  .  .  .  .  .
//! read            _________________________________________________________/^^\___________
//! read_done       __________________________________________________________________/^^\__
//! ```

use super::issue::Issue;
use super::moved_star::MovedStar;
use super::test_corners::TestCorners;
use super::visit_judge::VisitJudge;
use super::visit_reader::VisitReader;
use crate::engine::types::{
    context_bits, ring_bits, Arrival, Carried, Completion, ContextId, LockClear, Moving, NearVerdict, Position, Push,
    RecordRead, Start, TestVertices, TriangleId, Turned, Upcoming, VertexId, Visit, Write, WriteEnables, CONTEXT_BITS,
    TURNED_BITS, VISIT_BITS,
};
use crate::leaf::{DelayLine, LutMemory, Unpack};
use crate::mesh::{ReadRecord, TriangleStore, VertexStore};
use crate::predicate::{Point, Sides, POINT_BITS};
use crate::prelude::*;
use incircle_protocol::{triangle_id_bits, vertex_id_bits, Config};

#[derive(LogicBlock, Default)]
pub struct VisitPipeline {
    pub clock: Signal<In, Clock>,
    /// Reset forgets all visits; the memories keep their contents.
    pub reset: Signal<In, Bit>,
    /// The number of the infinite vertex, a constant.
    pub infinite: Signal<In, VertexId>,
    /// Records from this id on are not written yet.
    pub records: Signal<In, TriangleId>,
    /// Visits for the queue.
    pub push: Signal<In, Push>,
    /// The coordinates of the point that a context inserts from now on.
    pub position: Signal<In, Position>,
    /// A visit reads its record in this clock.
    pub is_issuing: Signal<Out, Bit>,
    /// The visit that completes in this clock; and the one that completes in the next clock unless reset comes first.
    pub completion: Signal<Out, Completion>,
    pub early: Signal<Out, Upcoming>,
    /// Signs and values of the three orient2d of the visit that completes in this clock, for the corners as stored, and
    /// the search for the nearest vertex: in a core that answers questions.
    pub sides: Vec<Signal<Out, Sides>>,
    pub nearest: Vec<Signal<Out, NearVerdict>>,
    /// In such a core: a run of deletions or moves is under way; the visit that reads its record, and two clocks later
    /// the vertices of its test if it is one. The vertex memory is asked for a point of a test (`fetches`). Whether the
    /// three corners of the visit that completes turn left.
    pub hole_runs: Vec<Signal<In, Bit>>,
    pub issued: Vec<Signal<Out, Visit>>,
    pub test_vertices: Vec<Signal<In, TestVertices>>,
    pub fetches: Vec<Signal<Out, Bit>>,
    pub turns_left: Vec<Signal<Out, Bit>>,
    /// The item of a move that begins with a context that starts, and the carried vertices of [`MovedStar`].
    pub moving: Vec<Signal<In, Moving>>,
    pub start: Vec<Signal<In, Start>>,
    pub carried: Vec<Signal<In, Carried>>,
    /// A record that the read-out wants, only while no visit is in flight; and the record that has been read.
    pub read: Signal<In, RecordRead>,
    pub read_out: Signal<Out, ReadRecord>,
    /// A write into the triangle memory; `enables` says which columns.
    pub write: Signal<In, Write>,
    pub enables: Signal<In, WriteEnables>,
    /// A point to store in the vertex memory.
    pub arrival: Signal<In, Arrival>,
    /// A vertex to read, only at an edge without an `arrival`; its coordinates come 2 clocks later.
    pub fetch_id: Signal<In, VertexId>,
    pub fetched: Signal<Out, Point>,
    /// A lock to clear at this edge.
    pub clear: Signal<In, LockClear>,
    issue: Issue,
    triangles: TriangleStore,
    vertices: VertexStore,
    reader: VisitReader,
    judge: VisitJudge,
    positions: LutMemory<CONTEXT_BITS, POINT_BITS>,
    is_written: Signal<Local, Bit>,
    is_torn: Signal<Local, Bit>,
    /// The visit in clock 1, and the one in clock 2, must be made again.
    again1: DFF<Bit>,
    again2: DFF<Bit>,
    /// The context of the visit in clock 3, and in clock 4.
    context3: DFF<ContextId>,
    context4: DFF<ContextId>,
    visit_bits: Signal<Local, Bits<VISIT_BITS>>,
    turned_bits: Signal<Local, Bits<TURNED_BITS>>,
    visit_delay: DelayLine<VISIT_BITS>,
    turned_delay: DelayLine<TURNED_BITS>,
    delayed_visit: Unpack<Visit, VISIT_BITS>,
    delayed_turned: Unpack<Turned, TURNED_BITS>,
    /// The record of the visit in clock 15.
    judged: DFF<Turned>,
    point: DFF<Point>,
    /// Bit `k`: the visit issued `k + 1` clocks ago is valid. `completes` holds the valid bit of the last stage.
    valid: DFF<Bits<15>>,
    read_valid1: DFF<Bit>,
    read_valid2: DFF<Bit>,
    completes: DFF<Completion>,
    kept_sides: Vec<DFF<Sides>>,
    kept_near: Vec<DFF<NearVerdict>>,
    kept_turn: Vec<DFF<Bit>>,
    /// The visit in clock 1.
    visit1: Vec<DFF<Visit>>,
    test: Vec<TestCorners>,
    moved: Vec<MovedStar>,
    shifted: Signal<Local, Bits<15>>,
    one: Signal<Local, Bits<15>>,
}

impl VisitPipeline {
    /// The number of clocks from the issue register to `completion`: corners, signs, verdict.
    pub const STAGES: usize = VisitReader::LATENCY + VisitJudge::LATENCY + 1;

    /// # Panics
    ///
    /// If the stages do not add up to the width of the valid register, which is a fault in this source.
    pub fn new(config: Config) -> Self {
        assert_eq!(Self::STAGES, 16, "the valid register has a bit for each stage but the last");
        let signs = VisitReader::LATENCY + VisitJudge::LATENCY;
        Self {
            issue: Issue::new(context_bits(config) + ring_bits(config)),
            triangles: TriangleStore::new(
                triangle_id_bits(config.points) as usize,
                vertex_id_bits(config.points) as usize,
                context_bits(config),
            ),
            positions: LutMemory::new(context_bits(config), POINT_BITS),
            vertices: VertexStore::new(vertex_id_bits(config.points) as usize - 1),
            visit_delay: DelayLine::new(signs - TriangleStore::LATENCY),
            turned_delay: DelayLine::new(signs - VisitReader::TURNED_LATENCY - 1),
            ..Self::default()
        }
    }

    /// The pipeline of a core that answers questions.
    ///
    /// # Panics
    ///
    /// As [`new`](Self::new).
    pub fn with_sides(config: Config) -> Self {
        Self {
            judge: VisitJudge::with_sides(),
            sides: vec![Signal::default()],
            nearest: vec![Signal::default()],
            kept_sides: vec![DFF::default()],
            kept_near: vec![DFF::default()],
            kept_turn: vec![DFF::default()],
            visit1: vec![DFF::default()],
            test: vec![TestCorners::default()],
            moved: vec![MovedStar::new(config)],
            moving: vec![Signal::default()],
            start: vec![Signal::default()],
            carried: vec![Signal::default()],
            hole_runs: vec![Signal::default()],
            issued: vec![Signal::default()],
            test_vertices: vec![Signal::default()],
            fetches: vec![Signal::default()],
            turns_left: vec![Signal::default()],
            ..Self::new(config)
        }
    }
}

impl Logic for VisitPipeline {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, again1, again2, context3, context4, point, valid, read_valid1, read_valid2);
        dff_setup!(self, clock, judged, completes);
        clock!(self, clock, issue, triangles, vertices, reader, positions, judge, visit_delay, turned_delay);
        self.one.next = 1.into();
        self.reader.infinite.next = self.infinite.val();
        self.issue.reset.next = self.reset.val();
        self.issue.push.next = self.push.val();
        self.issue.read.next = self.read.val();
        self.is_issuing.next = self.issue.visit_valid.val();

        // L7: clock 0 marks a record that is not written yet, or is being written at this edge. Columns of such a
        // record may come from two different triangles, so the step of a walk across such a record would mean nothing.
        self.is_written.next = self.issue.visit.val().record < self.records.val();
        self.is_torn.next = self.write.val().valid & (self.write.val().id == self.issue.visit.val().record);
        self.again1.d.next = self.is_torn.val() | (!self.is_written.val());
        self.again2.d.next = self.again1.q.val();

        self.triangles.read_id.next = self.issue.visit.val().record;
        self.triangles.vertices_id.next = self.issue.vertices_id.val();
        self.triangles.links_id.next = self.issue.links_id.val();
        self.triangles.read_locks.next = self.issue.visit_valid.val() & self.issue.visit.val().locks;
        self.triangles.context_id.next = self.issue.visit.val().context;
        self.triangles.write.next = self.write.val();
        self.triangles.enables.next = self.enables.val();
        self.triangles.clear.next = self.clear.val();
        self.reader.visit.next = self.issue.visit.val();
        self.reader.record.next = self.triangles.record.val();
        self.reader.took.next = self.triangles.took.val();
        self.reader.foreign.next = self.triangles.foreign.val();
        self.reader.again.next = self.again2.q.val();
        self.read_valid1.d.next = self.issue.read_valid.val();
        self.read_valid2.d.next = self.read_valid1.q.val();
        self.read_out.next.valid = self.read_valid2.q.val();
        self.read_out.next.record = self.triangles.record.val();

        // Clocks 2 to 5 fetch the corners. The point is read in clock 4, so that it meets its corners in clock 5.
        self.vertices.id0.next = self.triangles.record.val().v0;
        self.vertices.id1.next = self.triangles.record.val().v1;
        self.vertices.id2.next = self.triangles.record.val().v2;
        self.vertices.write.next = self.arrival.val();
        self.reader.stored_corners.next = self.vertices.corners.val();
        self.vertices.fetch_id.next = self.fetch_id.val();
        self.fetched.next = self.vertices.fetched.val();
        self.context3.d.next = self.reader.visit_at_record.val().context;
        self.context4.d.next = self.context3.q.val();
        self.positions.write_address.next = self.position.val().context;
        self.positions.write_data.next = self.position.val().point;
        self.positions.write_enable.next = self.position.val().valid;
        self.positions.read_address.next = self.context4.q.val();
        self.point.d.next = self.positions.read_data.val();

        // Clocks 5 to 15 compute the signs, while delay lines carry the visit and its record alongside.
        self.judge.corners.next = self.reader.corners.val();
        self.judge.p.next = self.point.q.val();
        self.visit_bits.next = self.reader.visit_at_record.val().into();
        self.visit_delay.data_in.next = self.visit_bits.val();
        self.delayed_visit.bits.next = self.visit_delay.data_out.val();
        self.turned_bits.next = self.reader.turned.val().into();
        self.turned_delay.data_in.next = self.turned_bits.val();
        self.delayed_turned.bits.next = self.turned_delay.data_out.val();

        // The delay line ends in clock 14: a register lies between it and the verdict, which is combinational.
        self.judged.d.next = self.delayed_turned.value.val();
        self.judge.turned.next = self.judged.q.val();
        self.early.next.done = self.valid.q.val().get_bit(14);
        self.early.next.visit = self.delayed_visit.value.val();
        self.early.next.turned = self.judged.q.val();
        self.completes.d.next.done = self.valid.q.val().get_bit(14) & (!self.reset.val());
        self.completes.d.next.visit = self.delayed_visit.value.val();
        self.completes.d.next.turned = self.judged.q.val();
        self.completes.d.next.verdict = self.judge.verdict.val();
        self.completion.next = self.completes.q.val();
        for i in 0..self.sides.len() {
            self.kept_sides[i].clock.next = self.clock.val();
            self.kept_sides[i].d.next = self.judge.sides[i].val();
            self.sides[i].next = self.kept_sides[i].q.val();
            self.judge.rotated[i].next = self.reader.turned.val();
            self.kept_near[i].clock.next = self.clock.val();
            self.kept_near[i].d.next = self.judge.nearest[i].val();
            self.nearest[i].next = self.kept_near[i].q.val();
            self.kept_turn[i].clock.next = self.clock.val();
            self.kept_turn[i].d.next = self.judge.turns_left[i].val();
            self.turns_left[i].next = self.kept_turn[i].q.val();

            // A test of a hole has four vertices in the place of a record.
            self.test[i].clock.next = self.clock.val();
            self.test[i].hole_runs.next = self.hole_runs[i].val();
            self.visit1[i].clock.next = self.clock.val();
            self.visit1[i].d.next = self.issue.visit.val();
            self.test[i].valid.next = self.valid.q.val().get_bit(0) & (!self.reset.val());
            self.test[i].visit.next = self.visit1[i].q.val();
            self.test[i].record.next = self.triangles.record.val();
            self.test[i].vertices.next = self.test_vertices[i].val();
            self.issued[i].next = self.issue.visit.val();
            self.reader.record.next = self.test[i].seen.val();
            self.vertices.id0.next = self.test[i].id0.val();
            self.vertices.id1.next = self.test[i].id1.val();
            self.vertices.id2.next = self.test[i].id2.val();
            self.fetches[i].next = self.test[i].fetches.val() | self.moved[i].fetches.val();
            if self.test[i].fetches.val() {
                self.vertices.fetch_id.next = self.test[i].fetch_id.val();
            }
            if self.test[i].is_point.val() {
                self.point.d.next = self.vertices.fetched.val();
            }

            // The star of a vertex that moves is judged by the new place.
            self.moved[i].clock.next = self.clock.val();
            self.moved[i].moving.next = self.moving[i].val();
            self.moved[i].start.next = self.start[i].val();
            self.moved[i].carried.next = self.carried[i].val();
            self.moved[i].valid.next = self.valid.q.val().get_bit(0) & (!self.reset.val());
            self.moved[i].early.next = self.visit1[i].q.val();
            self.moved[i].visit.next = self.reader.visit_at_record.val();
            self.moved[i].record.next = self.triangles.record.val();
            self.moved[i].arrival.next = self.arrival.val();
            self.moved[i].test_fetches.next = self.test[i].fetches.val();
            self.moved[i].corners.next = self.vertices.corners.val();
            self.moved[i].fetched.next = self.vertices.fetched.val();
            self.reader.stored_corners.next = self.moved[i].corners_after.val();
            self.moved[i].turned.next = self.reader.turned.val();
            self.turned_bits.next = self.moved[i].turned_after.val().into();
            // Read after it is driven: in Verilog, an assignment above would take the bits before the mark.
            self.turned_delay.data_in.next = self.turned_bits.val();
            if self.moved[i].fetches.val() {
                self.vertices.fetch_id.next = self.moved[i].fetch_id.val();
            }
            if self.moved[i].is_moved.val() {
                self.point.d.next = self.moved[i].target.val();
            }
        }

        self.shifted.next = self.valid.q.val() << self.one.val();
        self.valid.d.next = self.shifted.val();
        if self.issue.visit_valid.val() {
            self.valid.d.next = self.shifted.val() | self.one.val();
        }
        if self.reset.val() {
            self.valid.d.next = 0.into();
            self.read_valid1.d.next = false;
            self.read_valid2.d.next = false;
        }
    }
}
