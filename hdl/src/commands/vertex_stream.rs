//! Sends the payload of a `Triangles` answer: packs the vertices of the records that come, and keeps the beats
//! until they are taken.
//!
//! 1. `has_room` says, two clocks late, whether at most `ROOM` beats wait. The queue holds 16 beats, so there is room
//!    for every record under way if each comes within `PATIENCE` clocks.
//!
//! Latency: 1 clock from a record to the beat that it fills, if no other beat waits.

use super::types::{AnswerBeat, RecordCount, ANSWER_BEAT_BITS};
use super::vertex_packer::VertexPacker;
use crate::engine::types::VertexId;
use crate::leaf::{Fifo, Unpack};
use crate::prelude::*;

/// Number of address bits of the queue of beats.
const QUEUE_BITS: usize = 4;

#[derive(LogicBlock, Default)]
pub struct VertexStream {
    pub clock: Signal<In, Clock>,
    /// A reset drops everything.
    pub reset: Signal<In, Bit>,
    /// A payload of `count` records begins; allowed only when no beat of another payload is left.
    pub starts: Signal<In, Bit>,
    pub count: Signal<In, RecordCount>,
    /// A record may be asked for.
    pub has_room: Signal<Out, Bit>,
    /// A record that was asked for has come, with these vertices.
    pub comes: Signal<In, Bit>,
    pub v0: Signal<In, VertexId>,
    pub v1: Signal<In, VertexId>,
    pub v2: Signal<In, VertexId>,
    /// The first beat that has not been taken.
    pub valid: Signal<Out, Bit>,
    pub beat: Signal<Out, AnswerBeat>,
    /// The beat is taken at this edge; allowed only while `valid` is high.
    pub takes: Signal<In, Bit>,
    /// Number of beats in the queue.
    waiting: DFF<Bits<5>>,
    roomy: DFF<Bit>,
    packer: VertexPacker,
    queue: Fifo<QUEUE_BITS, ANSWER_BEAT_BITS>,
    head: Unpack<AnswerBeat, ANSWER_BEAT_BITS>,
    beat_bits: Signal<Local, Bits<ANSWER_BEAT_BITS>>,
    one_beat: Signal<Local, Bits<5>>,
    room: Signal<Local, Bits<5>>,
}

impl VertexStream {
    /// Number of beats that may wait while more records are asked for.
    pub const ROOM: usize = 4;
    /// Largest number of clocks between asking for a record and its coming.
    pub const PATIENCE: usize = 10;
}

// Up to three more records are asked for while the count of beats follows. Four records fill three beats, and the last
// record may leave a rest.
const _: () = assert!(
    VertexStream::ROOM == 4 && VertexStream::ROOM + ((VertexStream::PATIENCE + 3) * 3).div_ceil(4) < 1 << QUEUE_BITS,
    "the literal of this block is its constant, and the queue takes what is under way"
);

impl Logic for VertexStream {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, waiting, roomy);
        clock!(self, clock, packer, queue);
        self.one_beat.next = 1.into();
        self.room.next = 4.into();
        self.packer.reset.next = self.reset.val();
        self.packer.starts.next = self.starts.val();
        self.packer.count.next = self.count.val();
        self.packer.comes.next = self.comes.val();
        self.packer.v0.next = self.v0.val();
        self.packer.v1.next = self.v1.val();
        self.packer.v2.next = self.v2.val();

        self.queue.reset.next = self.reset.val();
        self.queue.push.next = self.packer.valid.val();
        self.beat_bits.next = self.packer.beat.val().into();
        self.queue.push_data.next = self.beat_bits.val();
        self.queue.pop.next = self.takes.val();
        self.valid.next = self.queue.valid.val();
        self.head.bits.next = self.queue.data.val();
        self.beat.next = self.head.value.val();

        self.has_room.next = self.roomy.q.val();
        self.roomy.d.next = self.waiting.q.val() <= self.room.val();
        if self.packer.valid.val() & (!self.takes.val()) {
            self.waiting.d.next = self.waiting.q.val() + self.one_beat.val();
        }
        if self.takes.val() & (!self.packer.valid.val()) {
            self.waiting.d.next = self.waiting.q.val() - self.one_beat.val();
        }
        if self.reset.val() {
            self.waiting.d.next = 0.into();
        }
    }
}
