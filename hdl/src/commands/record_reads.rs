//! Sends the payload of a read-out: reads one record a clock for their vertices alone, or two in three clocks for all
//! their words, as fast as their beats leave.
//!
//! 1. `read` leads on to the addresses of the triangle memory, so it follows registers alone.
//! 2. Two whole records fill three beats. So a clock without `read` follows the second of each pair, and every record
//!    must come equally many clocks after its `read`, at most [`RecordStream::PATIENCE`].
//! 3. `valid` and `beat` are registers, because the mark of the last beat decides in the same clock what the whole
//!    command port does next.
//!
//! Latency: 3 clocks from `read_done` to the beat that the record fills.

use super::living_reads::LivingReads;
use super::record_stream::RecordStream;
use super::types::{AnswerBeat, RecordCount};
use crate::engine::types::{TriangleId, VertexId};
use crate::mesh::Record;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RecordReads {
    pub clock: Signal<In, Clock>,
    /// A reset drops everything.
    pub reset: Signal<In, Bit>,
    /// The payload is `count` records from `first` on; allowed only when nothing of another payload is left.
    pub starts: Signal<In, Bit>,
    pub first: Signal<In, TriangleId>,
    pub count: Signal<In, RecordCount>,
    /// The payload has the vertices of the records alone; stable from the clock before `runs` on.
    pub is_packed: Signal<In, Bit>,
    /// Ids are short in such a payload, of 10 bits; with `has_rests`, of 12. Both are as stable as `is_packed`.
    pub has_short_ids: Signal<In, Bit>,
    pub has_rests: Signal<In, Bit>,
    /// The payload is being sent.
    pub runs: Signal<In, Bit>,
    /// Read the record `read_id`.
    pub read: Signal<Out, Bit>,
    pub read_id: Signal<Out, TriangleId>,
    /// A record has come; records come in the order in which they were asked for.
    pub read_done: Signal<In, Bit>,
    pub record: Signal<In, Record>,
    /// The next beat of the payload.
    pub valid: Signal<Out, Bit>,
    pub beat: Signal<Out, AnswerBeat>,
    /// The beat is taken at this edge; allowed only while `valid` is high.
    pub takes: Signal<In, Bit>,
    /// In a core with deletions, which leaves free records out of a payload of vertices: the infinite vertex.
    pub infinite: Vec<Signal<In, VertexId>>,
    living: Vec<LivingReads>,
    /// The form of the payload in registers, because it chooses every bit of a beat.
    vertices_alone: DFF<Bit>,
    ids_are_short: DFF<Bit>,
    rests_follow: DFF<Bit>,
    record_id: DFF<TriangleId>,
    /// Number of records that have yet to be read.
    left: DFF<RecordCount>,
    some_are_left: DFF<Bit>,
    /// The next record is the second of a pair.
    is_second: DFF<Bit>,
    /// The clock after the second record of a pair.
    pauses: DFF<Bit>,
    stream: RecordStream,
    is_there: DFF<Bit>,
    head: DFF<AnswerBeat>,
    moves: Signal<Local, Bit>,
    asks: Signal<Local, Bit>,
    one: Signal<Local, RecordCount>,
}

impl RecordReads {
    /// The block of a core with deletions.
    pub fn with_deletions() -> Self {
        Self { infinite: vec![Signal::default()], living: vec![LivingReads::default()], ..Self::default() }
    }
}

impl Logic for RecordReads {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, vertices_alone, ids_are_short, rests_follow);
        dff_setup!(self, clock, record_id, left, some_are_left, is_second, pauses, is_there, head);
        clock!(self, clock, stream);
        self.one.next = 1.into();
        self.vertices_alone.d.next = self.is_packed.val();
        self.ids_are_short.d.next = self.is_packed.val() & self.has_short_ids.val();
        self.rests_follow.d.next = self.is_packed.val() & self.has_short_ids.val() & self.has_rests.val();

        self.asks.next =
            self.runs.val() & self.some_are_left.q.val() & self.stream.has_room.val() & (!self.pauses.q.val());
        for i in 0..self.living.len() {
            self.living[i].clock.next = self.clock.val();
            self.living[i].infinite.next = self.infinite[i].val();
            self.living[i].starts.next = self.starts.val();
            self.living[i].first.next = self.first.val();
            self.living[i].count.next = self.count.val();
            self.living[i].comes.next = self.read_done.val() & self.vertices_alone.q.val();
            self.living[i].record.next = self.record.val();
            if self.vertices_alone.q.val() {
                self.asks.next = self.runs.val()
                    & self.living[i].some_are_left.val()
                    & self.stream.has_room.val()
                    & (!self.pauses.q.val());
            }
        }
        self.read.next = self.asks.val();
        self.read_id.next = self.record_id.q.val();
        self.pauses.d.next = self.asks.val() & self.is_second.q.val() & (!self.vertices_alone.q.val());
        if self.asks.val() {
            self.is_second.d.next = !self.is_second.q.val();
            self.record_id.d.next = self.record_id.q.val() + self.one.val();
            self.left.d.next = self.left.q.val() - self.one.val();
            self.some_are_left.d.next = self.left.q.val() != self.one.val();
        }
        if self.starts.val() {
            self.is_second.d.next = false;
            self.record_id.d.next = self.first.val();
            self.left.d.next = self.count.val();
            self.some_are_left.d.next = self.count.val().any();
        }

        self.stream.reset.next = self.reset.val();
        self.stream.starts.next = self.starts.val();
        self.stream.count.next = self.count.val();
        self.stream.vertices_alone.next = self.vertices_alone.q.val();
        self.stream.has_short_ids.next = self.ids_are_short.q.val();
        self.stream.has_rests.next = self.rests_follow.q.val();
        self.stream.comes.next = self.read_done.val();
        self.stream.record.next = self.record.val();

        for i in 0..self.living.len() {
            if self.vertices_alone.q.val() {
                self.stream.comes.next = self.living[i].counts.val();
                if self.starts.val() {
                    self.record_id.d.next = 0.into();
                }
            }
        }

        self.valid.next = self.is_there.q.val();
        self.beat.next = self.head.q.val();
        self.moves.next = (!self.is_there.q.val()) | self.takes.val();
        self.stream.takes.next = self.moves.val() & self.stream.valid.val();
        if self.moves.val() {
            self.is_there.d.next = self.stream.valid.val();
            self.head.d.next = self.stream.beat.val();
        }
        if self.reset.val() {
            self.some_are_left.d.next = false;
            self.is_there.d.next = false;
        }
    }
}
