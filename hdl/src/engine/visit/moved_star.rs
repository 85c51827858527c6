//! Judges the star of a vertex that moves by its new place: that place is the point of each visit that locks. In a
//! record of the star, the vertex opposite the record before stands in for the one that moves, so the circle says
//! whether the edge between the two records stays (M12).
//!
//! 1. Until the vertex of a context is out of the mesh, the visits that turn and lock their record are those of its
//!    star. A visit outside, with place 0 or the mark 32 in `after`, keeps its corners.
//! 2. The test of the last edge, which turns its record, does not lock it and has the mark 64 in `cavity_record`, is
//!    judged by the new place, too.
//! 3. The point of a vertex that is read at the edge at which it is written is arbitrary, and so is a point that is
//!    fetched beside a write, because both use one port: the visit is made again (M14).
//! 4. A chain has one visit in flight, so its carried vertex stays until the visit has read it.
//!
//! Latency: 2 clocks from the record of a visit to its corners and the point, 3 to `turned_after`. Whether a visit
//! fetches a carried vertex, and which, is found in the clock before its record comes.

use crate::engine::types::{
    context_bits, Arrival, Carried, ContextId, Moving, RingEntry, Start, TriangleId, Turned, VertexId, Visit,
    CONTEXT_BITS, VERTEX_BITS,
};
use crate::leaf::LutMemory;
use crate::mesh::Record;
use crate::predicate::{Corners, Point, POINT_BITS};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct MovedStar {
    pub clock: Signal<In, Clock>,
    /// A run of moves is under way, with the item that begins; a context that takes a vertex at this edge.
    pub moving: Signal<In, Moving>,
    pub start: Signal<In, Start>,
    /// The vertices opposite the last records of the chains of a context.
    pub carried: Signal<In, Carried>,
    /// The visit whose record comes in the next clock (`early`), if there is one (`valid`); and the visit that `early`
    /// had a clock ago, with its record.
    pub valid: Signal<In, Bit>,
    pub early: Signal<In, Visit>,
    pub visit: Signal<In, Visit>,
    pub record: Signal<In, Record>,
    /// A point that is written at this edge; and the visit is a test that fetches a point.
    pub arrival: Signal<In, Arrival>,
    pub test_fetches: Signal<In, Bit>,
    /// The vertex memory is asked for the carried vertex.
    pub fetches: Signal<Out, Bit>,
    pub fetch_id: Signal<Out, VertexId>,
    /// Two clocks after a visit: its corners, the point that was fetched, and the corners by which it is judged. The
    /// visit is judged by the new place (`is_moved`).
    pub corners: Signal<In, Corners>,
    pub fetched: Signal<In, Point>,
    pub corners_after: Signal<Out, Corners>,
    pub is_moved: Signal<Out, Bit>,
    pub target: Signal<Out, Point>,
    /// Three clocks after a visit: its record, and the same with the mark of a point that was torn.
    pub turned: Signal<In, Turned>,
    pub turned_after: Signal<Out, Turned>,
    targets: LutMemory<CONTEXT_BITS, POINT_BITS>,
    vertices: LutMemory<CONTEXT_BITS, VERTEX_BITS>,
    inserting: LutMemory<CONTEXT_BITS, 1>,
    left: LutMemory<CONTEXT_BITS, VERTEX_BITS>,
    right: LutMemory<CONTEXT_BITS, VERTEX_BITS>,
    /// In the clock of a record: the vertex that moves is out of the mesh; the visit fetches a vertex, and that vertex.
    out0: DFF<Bit>,
    goes_round0: DFF<Bit>,
    carried0: DFF<VertexId>,
    /// One clock after a visit: its context and record, and the point that was written.
    context1: DFF<ContextId>,
    record1: DFF<Record>,
    written1: DFF<Arrival>,
    goes_round1: DFF<Bit>,
    is_moved1: DFF<Bit>,
    meets_write1: DFF<Bit>,
    context2: DFF<ContextId>,
    is_moved2: DFF<Bit>,
    /// Two clocks after a visit: the slot of the vertex that moves; and the point of its record was torn.
    swaps0: DFF<Bit>,
    swaps1: DFF<Bit>,
    swaps2: DFF<Bit>,
    torn2: DFF<Bit>,
    torn3: DFF<Bit>,
    entry: Signal<Local, RingEntry>,
    first_place: Signal<Local, RingEntry>,
    mark: Signal<Local, RingEntry>,
    record_of_test: Signal<Local, TriangleId>,
    is_out: Signal<Local, Bit>,
    goes_round: Signal<Local, Bit>,
    is_last_edge: Signal<Local, Bit>,
    is_written: Signal<Local, Bit>,
}

impl MovedStar {
    /// The block of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        Self {
            targets: LutMemory::new(bits, POINT_BITS),
            vertices: LutMemory::new(bits, VERTEX_BITS),
            inserting: LutMemory::new(bits, 1),
            left: LutMemory::new(bits, VERTEX_BITS),
            right: LutMemory::new(bits, VERTEX_BITS),
            ..Self::default()
        }
    }
}

impl Logic for MovedStar {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, out0, goes_round0, carried0, context1, record1, written1, goes_round1);
        dff_setup!(self, clock, is_moved1, context2, is_moved2);
        dff_setup!(self, clock, swaps0, swaps1, swaps2, torn2, torn3, meets_write1);
        clock!(self, clock, targets, vertices, inserting, left, right);
        self.targets.write_address.next = self.start.val().context;
        self.targets.write_data.next = self.moving.val().target;
        self.targets.write_enable.next = self.start.val().takes;
        self.vertices.write_address.next = self.start.val().context;
        self.vertices.write_data.next = self.start.val().id;
        self.vertices.write_enable.next = self.start.val().takes;
        self.inserting.write_address.next = self.start.val().context;
        self.inserting.write_data.next = 0.into();
        if self.moving.val().returns {
            self.inserting.write_data.next = 1.into();
        }
        self.inserting.write_enable.next = self.start.val().takes;
        self.left.write_address.next = self.carried.val().context;
        self.left.write_data.next = self.carried.val().left;
        self.left.write_enable.next = self.carried.val().sets_left;
        self.right.write_address.next = self.carried.val().context;
        self.right.write_data.next = self.carried.val().right;
        self.right.write_enable.next = self.carried.val().sets_right;

        // The clock before the record.
        self.first_place.next = 0.into();
        self.mark.next = 32.into();
        self.entry.next = self.early.val().entry;
        self.inserting.read_address.next = self.early.val().context;
        self.left.read_address.next = self.early.val().context;
        self.right.read_address.next = self.early.val().context;
        self.is_out.next = (!self.moving.val().runs) | self.inserting.read_data.val().any();
        self.out0.d.next = self.is_out.val();
        self.goes_round0.d.next = self.valid.val()
            & (!self.is_out.val())
            & self.early.val().rotates
            & self.early.val().locks
            & (self.entry.val() != self.first_place.val())
            & (self.early.val().after != self.mark.val());
        self.carried0.d.next = self.left.read_data.val();
        if self.entry.val().get_bit(5) {
            self.carried0.d.next = self.right.read_data.val();
        }

        // The clock of the record: the carried vertex is fetched beside the corners.
        self.goes_round.next = self.goes_round0.q.val();
        self.fetches.next = self.goes_round.val();
        self.fetch_id.next = self.carried0.q.val();
        self.record_of_test.next = self.visit.val().cavity_record;
        self.is_last_edge.next =
            self.visit.val().rotates & (!self.visit.val().locks) & self.record_of_test.val().get_bit(6);
        self.context1.d.next = self.visit.val().context;
        self.record1.d.next = self.record.val();
        self.written1.d.next = self.arrival.val();
        self.goes_round1.d.next = self.goes_round.val();
        self.meets_write1.d.next = self.arrival.val().came & (self.goes_round.val() | self.test_fetches.val());
        self.is_moved1.d.next = (!self.out0.q.val()) & (self.visit.val().locks | self.is_last_edge.val());

        // The clock after that finds the slot of the vertex that moves.
        self.vertices.read_address.next = self.context1.q.val();
        self.swaps0.d.next = self.goes_round1.q.val() & (self.record1.q.val().v0 == self.vertices.read_data.val());
        self.swaps1.d.next = self.goes_round1.q.val() & (self.record1.q.val().v1 == self.vertices.read_data.val());
        self.swaps2.d.next = self.goes_round1.q.val() & (self.record1.q.val().v2 == self.vertices.read_data.val());
        self.is_written.next = (self.record1.q.val().v0 == self.written1.q.val().id)
            | (self.record1.q.val().v1 == self.written1.q.val().id)
            | (self.record1.q.val().v2 == self.written1.q.val().id);
        self.torn2.d.next = (self.written1.q.val().came & self.is_written.val()) | self.meets_write1.q.val();
        self.torn3.d.next = self.torn2.q.val();
        self.context2.d.next = self.context1.q.val();
        self.is_moved2.d.next = self.is_moved1.q.val();

        self.targets.read_address.next = self.context2.q.val();
        self.target.next = self.targets.read_data.val();
        self.is_moved.next = self.is_moved2.q.val();
        self.corners_after.next = self.corners.val();
        if self.swaps0.q.val() {
            self.corners_after.next.r0 = self.fetched.val();
        }
        if self.swaps1.q.val() {
            self.corners_after.next.r1 = self.fetched.val();
        }
        if self.swaps2.q.val() {
            self.corners_after.next.r2 = self.fetched.val();
        }
        self.turned_after.next = self.turned.val();
        self.turned_after.next.again = self.turned.val().again | self.torn3.q.val();
    }
}
