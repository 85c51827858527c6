//! Packs the records that come into beats, and keeps the beats until they are taken.
//!
//! 1. `has_room` says, two clocks late, whether at most `ROOM` beats wait. The queue holds 16 beats, so there is room
//!    for every record under way if each comes within `PATIENCE` clocks.
//! 2. Behind the second of two whole records a clock passes in which no record comes; see [`RecordPacker`].
//!
//! Latency: 2 clocks from a record to the beat that it fills, if no other beat waits.

use super::record_halves::RecordHalves;
use super::record_packer::RecordPacker;
use super::types::{AnswerBeat, RecordCount, ANSWER_BEAT_BITS};
use crate::leaf::{Fifo, Unpack};
use crate::mesh::Record;
use crate::prelude::*;

/// Number of address bits of the queue of beats.
const QUEUE_BITS: usize = 4;

#[derive(LogicBlock, Default)]
pub struct RecordStream {
    pub clock: Signal<In, Clock>,
    /// A reset drops everything.
    pub reset: Signal<In, Bit>,
    /// A payload of `count` records begins; allowed only when no beat of another payload is left.
    pub starts: Signal<In, Bit>,
    pub count: Signal<In, RecordCount>,
    /// The payload has the vertices of the records alone; stable from `starts` to the last beat.
    pub vertices_alone: Signal<In, Bit>,
    /// The payload has vertices alone, with short ids of 10 bits; with `has_rests`, of 12. Both are as stable.
    pub has_short_ids: Signal<In, Bit>,
    pub has_rests: Signal<In, Bit>,
    /// A record may be asked for.
    pub has_room: Signal<Out, Bit>,
    /// A record that was asked for comes.
    pub comes: Signal<In, Bit>,
    pub record: Signal<In, Record>,
    /// The first beat that has not been taken.
    pub valid: Signal<Out, Bit>,
    pub beat: Signal<Out, AnswerBeat>,
    /// The beat is taken at this edge; allowed only while `valid` is high.
    pub takes: Signal<In, Bit>,
    /// Number of beats in the queue.
    waiting: DFF<Bits<5>>,
    roomy: DFF<Bit>,
    has_come: DFF<Bit>,
    halves: RecordHalves,
    packer: RecordPacker,
    queue: Fifo<QUEUE_BITS, ANSWER_BEAT_BITS>,
    head: Unpack<AnswerBeat, ANSWER_BEAT_BITS>,
    beat_bits: Signal<Local, Bits<ANSWER_BEAT_BITS>>,
    one_beat: Signal<Local, Bits<5>>,
    room: Signal<Local, Bits<5>>,
}

impl RecordStream {
    /// Number of beats that may wait while more records are asked for.
    pub const ROOM: usize = 4;
    /// Largest number of clocks between asking for a record and its coming.
    pub const PATIENCE: usize = 7;
}

// Records of four more clocks are under way while the count of beats follows. A clock brings one beat, but for the last
// record, which may leave a rest.
const _: () = assert!(
    RecordStream::ROOM == 4 && RecordStream::ROOM + RecordStream::PATIENCE + 5 <= 1 << QUEUE_BITS,
    "the literal of this block is its constant, and the queue takes what is under way"
);

impl Logic for RecordStream {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, waiting, roomy, has_come);
        clock!(self, clock, halves, packer, queue);
        self.one_beat.next = 1.into();
        self.room.next = 4.into();
        self.packer.reset.next = self.reset.val();
        self.packer.starts.next = self.starts.val();
        self.packer.count.next = self.count.val();
        self.has_come.d.next = self.comes.val();
        self.halves.record.next = self.record.val();
        self.halves.vertices_alone.next = self.vertices_alone.val();
        self.halves.has_short_ids.next = self.has_short_ids.val();
        self.packer.vertices_alone.next = self.vertices_alone.val();
        self.packer.has_short_ids.next = self.has_short_ids.val();
        self.packer.has_rests.next = self.has_rests.val();
        self.packer.comes.next = self.has_come.q.val();
        self.packer.halves.next = self.halves.halves.val();
        self.packer.rest.next = self.halves.rest.val();

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
            self.has_come.d.next = false;
            self.waiting.d.next = 0.into();
        }
    }
}
