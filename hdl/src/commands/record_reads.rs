//! Sends the payload of a read-out: reads records, one at a time for all their words, or one a clock
//! for their vertices alone.
//!
//! 1. `read` leads on to the addresses of the triangle memory, so `is_packed` passes a register before
//!    it acts on `read`.
//! 2. Word `k` of a record holds `v[k]` in bits 0 to 14 and `n[k]` in bits 15 to 29; bit 31 of word 0 is the lock bit.
//! 3. `valid` and `beat` are registers, because the mark of the last beat decides in the same clock what the whole
//!    command port does next.
//!
//! Latency: 2 clocks from `read_done` to the first word of the record, 3 to the beat that its vertices fill.

use super::record_buffer::RecordBuffer;
use super::types::{AnswerBeat, RecordCount, Word};
use super::vertex_stream::VertexStream;
use crate::engine::types::TriangleId;
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
    vertices_alone: DFF<Bit>,
    record_id: DFF<TriangleId>,
    /// Number of records that have yet to be read.
    left: DFF<RecordCount>,
    some_are_left: DFF<Bit>,
    fetching: DFF<Bit>,
    buffer: RecordBuffer,
    vertices: VertexStream,
    is_there: DFF<Bit>,
    head: DFF<AnswerBeat>,
    moves: Signal<Local, Bit>,
    may_ask: Signal<Local, Bit>,
    asks: Signal<Local, Bit>,
    packs: Signal<Local, Bit>,
    no_word: Signal<Local, Word>,
    one: Signal<Local, RecordCount>,
}

impl Logic for RecordReads {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, vertices_alone, record_id, left, some_are_left, fetching, is_there, head);
        clock!(self, clock, buffer, vertices);
        self.no_word.next = 0.into();
        self.one.next = 1.into();
        self.vertices_alone.d.next = self.is_packed.val();

        // A whole record needs the only buffer, so the next one waits until the buffer is empty; vertices alone wait
        // for room in their queue.
        self.may_ask.next = (!self.fetching.q.val()) & (!self.buffer.holds.val());
        if self.vertices_alone.q.val() {
            self.may_ask.next = self.vertices.has_room.val();
        }
        self.asks.next = self.runs.val() & self.some_are_left.q.val() & self.may_ask.val();
        self.read.next = self.asks.val();
        self.read_id.next = self.record_id.q.val();
        if self.asks.val() {
            self.fetching.d.next = true;
            self.record_id.d.next = self.record_id.q.val() + self.one.val();
            self.left.d.next = self.left.q.val() - self.one.val();
            self.some_are_left.d.next = self.left.q.val() != self.one.val();
        }
        if self.read_done.val() {
            self.fetching.d.next = false;
        }
        if self.starts.val() {
            self.record_id.d.next = self.first.val();
            self.left.d.next = self.count.val();
            self.some_are_left.d.next = self.count.val().any();
        }

        self.buffer.reset.next = self.reset.val();
        self.buffer.read_done.next = self.read_done.val();
        self.buffer.record.next = self.record.val();
        self.packs.next = self.vertices_alone.q.val() & self.buffer.holds.val();
        self.buffer.takes_whole.next = self.packs.val();
        self.vertices.reset.next = self.reset.val();
        self.vertices.starts.next = self.starts.val();
        self.vertices.count.next = self.count.val();
        self.vertices.comes.next = self.packs.val();
        self.vertices.v0.next = self.buffer.vertex0.val();
        self.vertices.v1.next = self.buffer.vertex1.val();
        self.vertices.v2.next = self.buffer.vertex2.val();

        self.valid.next = self.is_there.q.val();
        self.beat.next = self.head.q.val();
        self.moves.next = (!self.is_there.q.val()) | self.takes.val();
        self.buffer.takes.next = self.moves.val() & self.buffer.holds.val() & (!self.vertices_alone.q.val());
        self.vertices.takes.next = self.moves.val() & self.vertices.valid.val() & self.vertices_alone.q.val();
        if self.moves.val() {
            self.is_there.d.next = self.buffer.holds.val();
            self.head.d.next.low = self.buffer.word.val();
            self.head.d.next.high = self.no_word.val();
            self.head.d.next.both = false;
            self.head.d.next.last = self.buffer.is_at_last.val() & (!self.some_are_left.q.val());
            if self.vertices_alone.q.val() {
                self.is_there.d.next = self.vertices.valid.val();
                self.head.d.next = self.vertices.beat.val();
            }
        }
        if self.reset.val() {
            self.some_are_left.d.next = false;
            self.fetching.d.next = false;
            self.is_there.d.next = false;
        }
    }
}
