//! Makes the first triangle and its ghost triangles from the first three points; in a batch, for one job after another.
//!
//! 1. The orientation of the three points is found by a *look*, a visit of a provisional record with their vertices.
//!    The seeder writes that record when the first of the points comes. The look says on which side of the line through
//!    the first two points the third lies. If the points are collinear, no other record is written.
//! 2. Job `c` of a batch has the vertices `3c` to `3c + 2` and the records `4c` to `4c + 3`. No point of the next job
//!    comes before the first triangle of this one is in the mesh, because `start_is_open` holds it back.
//!
//! Latency: 4 clocks from the look to `seeds`; 1 from `arrived` to `start_is_open` and `has_no_start`.
//!
//! In a batch of two jobs, the three points of job 0, which turn left, and the first point of job 1:
//! ```text
//! came            /^^\__/^^\__/^^\_______________________/^^\_____
//! looks           _____________________/^^\_______________________
//! start_is_open   _______________/^^^^^^^^^^^^^^^^^^^^^^^\________
//! has_no_start    /^^^^^^^^^^^^^^\_______________________/^^^^^^^^
//! write.valid     ___/^^\____________________/^^^^^^^^^^^\__/^^\__
//! write.id          .  0  .  .  .  .  .  .  .  0  1  2  3  .  4  .
//! seeds           _________________________________/^^\___________
//! seeded          ________________________________________________
//! ```

use super::seed_writes::SeedWrites;
use crate::engine::types::{Arrival, ContextId, Deal, SeedProgress, TriangleId, Verdict, VertexId, Write};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Seeder {
    pub clock: Signal<In, Clock>,
    /// Reset and clear forget the first triangles.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// The number of the infinite vertex, a constant.
    pub infinite: Signal<In, VertexId>,
    /// The number of jobs, among others.
    pub deal: Signal<In, Deal>,
    /// A point that is stored at this edge; the number of points that have come.
    pub arrival: Signal<In, Arrival>,
    pub arrived: Signal<In, VertexId>,
    /// The completed visit is the look at three points, with this verdict on the third of them.
    pub looks: Signal<In, Bit>,
    pub verdict: Signal<In, Verdict>,
    /// The progress of the first triangles.
    pub progress: Signal<Out, SeedProgress>,
    /// The three points of the first triangle that is due have come, but the triangle is not in the mesh yet.
    pub start_is_open: Signal<Out, Bit>,
    /// These three points are collinear, and no first triangle will be made any more.
    pub collinear: Signal<Out, Bit>,
    /// A record, from a register.
    pub write: Signal<Out, Write>,
    step: DFF<Bits<3>>,
    is_seeded: DFF<Bit>,
    is_collinear: DFF<Bit>,
    turns_left: DFF<Bit>,
    request: DFF<Write>,
    /// The job whose first triangle is due: its first vertex and record, the number of points that have come once its
    /// third point has, and the number of the job after it.
    vertex: DFF<VertexId>,
    record: DFF<TriangleId>,
    triple: DFF<VertexId>,
    following: DFF<ContextId>,
    has_triple: DFF<Bit>,
    writes: SeedWrites,
    prepares: Signal<Local, Bit>,
    is_writing: Signal<Local, Bit>,
    is_last: Signal<Local, Bit>,
    is_last_job: Signal<Local, Bit>,
    look_step: Signal<Local, Bits<3>>,
    last_step: Signal<Local, Bits<3>>,
    one: Signal<Local, Bits<3>>,
    one_job: Signal<Local, ContextId>,
    three_vertices: Signal<Local, VertexId>,
    four_records: Signal<Local, TriangleId>,
}

impl Logic for Seeder {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, step, is_seeded, is_collinear, turns_left, request);
        dff_setup!(self, clock, vertex, record, triple, following, has_triple);
        self.look_step.next = 0.into();
        self.last_step.next = 4.into();
        self.one.next = 1.into();
        self.one_job.next = 1.into();
        self.three_vertices.next = 3.into();
        self.four_records.next = 4.into();
        self.is_writing.next = self.step.q.val() != self.look_step.val();
        self.is_last.next = self.step.q.val() == self.last_step.val();
        self.progress.next.seeded = self.is_seeded.q.val();
        self.collinear.next = self.is_collinear.q.val();
        self.progress.next.seeds = self.is_last.val();
        self.start_is_open.next = self.has_triple.q.val() & (!self.is_seeded.q.val()) & (!self.is_collinear.q.val());
        self.progress.next.has_no_start =
            ((!self.has_triple.q.val()) | self.is_collinear.q.val()) & (!self.is_writing.val());

        self.prepares.next = self.arrival.val().came & (self.arrival.val().id == self.vertex.q.val());
        self.writes.step.next = self.step.q.val();
        self.writes.first_vertex.next = self.vertex.q.val();
        self.writes.first_record.next = self.record.q.val();
        self.writes.turns_left.next = self.turns_left.q.val();
        self.writes.infinite.next = self.infinite.val();
        self.request.d.next = self.writes.write.val();
        self.request.d.next.valid = self.is_writing.val() | self.prepares.val();
        self.write.next = self.request.q.val();

        self.has_triple.d.next = self.arrived.val() >= self.triple.q.val();
        self.is_last_job.next = self.following.q.val() == self.deal.val().jobs;
        if self.is_writing.val() {
            self.step.d.next = self.step.q.val() + self.one.val();
        }
        if self.is_last.val() {
            self.step.d.next = 0.into();
            self.is_seeded.d.next = self.is_last_job.val();
            if !self.is_last_job.val() {
                self.vertex.d.next = self.vertex.q.val() + self.three_vertices.val();
                self.record.d.next = self.record.q.val() + self.four_records.val();
                self.triple.d.next = self.triple.q.val() + self.three_vertices.val();
                self.following.d.next = self.following.q.val() + self.one_job.val();
            }
        }
        if self.looks.val() {
            self.turns_left.d.next = self.verdict.val().is_left;
            self.is_collinear.d.next = self.verdict.val().is_straight;
            if !self.verdict.val().is_straight {
                self.step.d.next = 1.into();
            }
        }
        if self.clears.val() | self.reset.val() {
            self.is_seeded.d.next = false;
            self.is_collinear.d.next = false;
            self.has_triple.d.next = false;
            self.vertex.d.next = 0.into();
            self.record.d.next = 0.into();
            self.triple.d.next = 3.into();
            self.following.d.next = 1.into();
        }
        if self.reset.val() {
            self.step.d.next = 0.into();
            self.request.d.next.valid = false;
        }
    }
}
