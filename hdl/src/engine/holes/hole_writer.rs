//! Writes the triangles that fill holes, and in the end marks the two records that become free.
//!
//! 1. A job reads three edges of its ring, one a clock, and makes up to three writes. A job follows another after three
//!    clocks.
//! 2. The writes of a job are those of [`HoleRecords`]. The last one of a deletion is the mark of its second free
//!    record; the ids of both are then kept for the vertex (`kept`).
//!
//! Latency: 5 clocks from the take of a job to its first request.

use super::hole_records::HoleRecords;
use crate::engine::types::{
    CommitJob, Committed, ContextId, FillJob, FillRequest, KeptWrite, RingEntry, RingWord, VertexId, Write,
    FILL_JOB_BITS,
};
use crate::leaf::{Fifo, Unpack};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct HoleWriter {
    pub clock: Signal<In, Clock>,
    /// Reset drops all jobs.
    pub reset: Signal<In, Bit>,
    pub infinite: Signal<In, VertexId>,
    /// A job that comes; none may come while `is_full`.
    pub job: Signal<In, FillRequest>,
    pub is_full: Signal<Out, Bit>,
    /// An edge of a ring to read, and its word two clocks later.
    pub reader: Signal<Out, ContextId>,
    pub place: Signal<Out, RingEntry>,
    pub word: Signal<In, RingWord>,
    /// A record or a link, from a register.
    pub write: Signal<Out, Write>,
    /// A write comes in the next clock.
    pub writes_next: Signal<Out, Bit>,
    /// The last write of a deletion is requested; and the ids that its vertex keeps.
    pub erased: Signal<Out, Committed>,
    pub kept: Signal<Out, KeptWrite>,
    line: Fifo<5, FILL_JOB_BITS>,
    first: Unpack<FillJob, FILL_JOB_BITS>,
    /// Number of jobs that wait.
    waiting: DFF<Bits<6>>,
    /// Number of clocks until the next job is taken.
    pause: DFF<Bits<2>>,
    valid: DFF<Bits<8>>,
    job0: DFF<FillJob>,
    job1: DFF<FillJob>,
    job2: DFF<FillJob>,
    job3: DFF<FillJob>,
    job4: DFF<FillJob>,
    job5: DFF<FillJob>,
    word_m: DFF<RingWord>,
    word_i: DFF<RingWord>,
    request: DFF<Write>,
    base_link: DFF<Write>,
    mend: DFF<Write>,
    records: HoleRecords,
    came: Signal<Local, FillJob>,
    came_bits: Signal<Local, Bits<FILL_JOB_BITS>>,
    taken: Signal<Local, FillJob>,
    at_work: Signal<Local, FillJob>,
    ended: Signal<Local, CommitJob>,
    takes: Signal<Local, Bit>,
    is_due: Signal<Local, Bit>,
    one: Signal<Local, Bits<6>>,
    one_clock: Signal<Local, Bits<2>>,
    more_clocks: Signal<Local, Bits<2>>,
    none: Signal<Local, Bits<2>>,
    valid_shift: Signal<Local, Bits<8>>,
    valid_one: Signal<Local, Bits<8>>,
}

impl Logic for HoleWriter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, waiting, pause, valid, job0, job1, job2, job3, job4, job5, word_m, word_i);
        dff_setup!(self, clock, request, base_link, mend);
        clock!(self, clock, line);
        self.one.next = 1.into();
        self.one_clock.next = 1.into();
        self.more_clocks.next = 3.into();
        self.none.next = 0.into();
        self.valid_shift.next = 1.into();
        self.valid_one.next = 1.into();

        self.came.next = self.job.val().job;
        self.came_bits.next = self.came.val().into();
        self.line.reset.next = self.reset.val();
        self.line.push.next = self.job.val().valid;
        self.line.push_data.next = self.came_bits.val();
        self.is_due.next = (self.pause.q.val() == self.none.val()) | (self.pause.q.val() == self.one_clock.val());
        self.takes.next = self.is_due.val() & self.line.valid.val();
        self.line.pop.next = self.takes.val();
        self.first.bits.next = self.line.data.val();
        self.is_full.next = self.waiting.q.val().get_bit(5);
        if self.job.val().valid & (!self.takes.val()) {
            self.waiting.d.next = self.waiting.q.val() + self.one.val();
        }
        if self.takes.val() & (!self.job.val().valid) {
            self.waiting.d.next = self.waiting.q.val() - self.one.val();
        }
        if self.pause.q.val() != self.none.val() {
            self.pause.d.next = self.pause.q.val() - self.one_clock.val();
        }
        self.valid.d.next = self.valid.q.val() << self.valid_shift.val();
        if self.takes.val() {
            self.pause.d.next = self.more_clocks.val();
            self.valid.d.next = (self.valid.q.val() << self.valid_shift.val()) | self.valid_one.val();
        }
        self.job0.d.next = self.first.value.val();
        self.job1.d.next = self.job0.q.val();
        self.job2.d.next = self.job1.q.val();
        self.job3.d.next = self.job2.q.val();
        self.job4.d.next = self.job3.q.val();
        self.job5.d.next = self.job4.q.val();

        // The edges of a job are read in its first three clocks.
        self.taken.next = self.job2.q.val();
        self.place.next = self.taken.val().j;
        if self.valid.q.val().get_bit(1) {
            self.taken.next = self.job1.q.val();
            self.place.next = self.taken.val().m;
        }
        if self.valid.q.val().get_bit(0) {
            self.taken.next = self.job0.q.val();
            self.place.next = self.taken.val().i;
        }
        self.reader.next = self.taken.val().context;
        self.word_m.d.next = self.word.val();
        self.word_i.d.next = self.word_m.q.val();

        self.at_work.next = self.job4.q.val();
        self.records.infinite.next = self.infinite.val();
        self.records.job.next = self.at_work.val();
        self.records.edge_i.next = self.word_i.q.val();
        self.records.edge_m.next = self.word_m.q.val();
        self.records.edge_j.next = self.word.val();

        self.request.d.next.valid = false;
        if self.valid.q.val().get_bit(6) {
            self.request.d.next = self.mend.q.val();
        }
        if self.valid.q.val().get_bit(5) {
            self.request.d.next = self.base_link.q.val();
        }
        if self.valid.q.val().get_bit(4) {
            self.request.d.next = self.records.first.val();
            self.base_link.d.next = self.records.second.val();
            self.mend.d.next = self.records.third.val();
        }
        self.write.next = self.request.q.val();
        self.writes_next.next = self.valid.q.val().get_bit(4)
            | self.valid.q.val().get_bit(5)
            | (self.valid.q.val().get_bit(6) & self.mend.q.val().valid);
        self.ended.next.context = self.job5.q.val().context;
        self.ended.next.vertex = self.job5.q.val().vertex;
        self.ended.next.inners = 0.into();
        self.ended.next.locks = self.job5.q.val().locks;
        self.ended.next.since = 0.into();
        self.erased.next.valid = self.valid.q.val().get_bit(5) & self.job5.q.val().ends;
        self.erased.next.job = self.ended.val();
        self.kept.next.valid = self.valid.q.val().get_bit(5) & self.job5.q.val().ends;
        self.kept.next.context = self.job5.q.val().context;
        self.kept.next.vertex = self.job5.q.val().vertex;
        self.kept.next.first = self.request.q.val().id;
        self.kept.next.second = self.base_link.q.val().id;

        if self.reset.val() {
            self.waiting.d.next = 0.into();
            self.pause.d.next = 0.into();
            self.valid.d.next = 0.into();
            self.request.d.next.valid = false;
        }
    }
}
