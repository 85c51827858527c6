//! Puts the four vertices of a test in the place of a record: three of them as corners, and the fourth as the point.
//!
//! 1. A test turns its record and does not lock it, in a run of deletions or moves. The test of the last edge of a star
//!    that moves has three vertices, and a point of its own ([`MovedStar`](super::MovedStar)).
//!
//! Latency: none from the record to the corners, 2 clocks from there to `is_point`; a visit is looked at in the clock
//! before its record comes.

use crate::engine::types::{TestVertices, VertexId, Visit};
use crate::mesh::Record;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct TestCorners {
    pub clock: Signal<In, Clock>,
    /// A run of deletions or moves is under way, and no solo insertion.
    pub hole_runs: Signal<In, Bit>,
    /// The visit whose record comes in the next clock, if there is one (`valid`).
    pub valid: Signal<In, Bit>,
    pub visit: Signal<In, Visit>,
    /// The record of the visit that `visit` had a clock ago, and the vertices of its test.
    pub record: Signal<In, Record>,
    pub vertices: Signal<In, TestVertices>,
    /// The record with the vertices of the test, and these again.
    pub seen: Signal<Out, Record>,
    pub id0: Signal<Out, VertexId>,
    pub id1: Signal<Out, VertexId>,
    pub id2: Signal<Out, VertexId>,
    /// The visit is a test, and the vertex memory is asked for its fourth vertex.
    pub fetches: Signal<Out, Bit>,
    pub fetch_id: Signal<Out, VertexId>,
    /// The point that comes out of the vertex memory is that of a test.
    pub is_point: Signal<Out, Bit>,
    test0: DFF<Bit>,
    test1: DFF<Bit>,
    test2: DFF<Bit>,
    is_test: Signal<Local, Bit>,
}

impl Logic for TestCorners {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, test0, test1, test2);
        self.test0.d.next =
            self.hole_runs.val() & self.valid.val() & self.visit.val().rotates & (!self.visit.val().locks);
        self.is_test.next = self.test0.q.val();
        self.fetches.next = self.is_test.val();
        self.fetch_id.next = self.vertices.val().challenger;
        self.test1.d.next = self.is_test.val();
        self.test2.d.next = self.test1.q.val();
        self.is_point.next = self.test2.q.val();
        self.seen.next = self.record.val();
        self.id0.next = self.record.val().v0;
        self.id1.next = self.record.val().v1;
        self.id2.next = self.record.val().v2;
        if self.is_test.val() {
            self.seen.next.v0 = self.vertices.val().v0;
            self.seen.next.v1 = self.vertices.val().v1;
            self.seen.next.v2 = self.vertices.val().v2;
            self.id0.next = self.vertices.val().v0;
            self.id1.next = self.vertices.val().v1;
            self.id2.next = self.vertices.val().v2;
        }
    }
}
