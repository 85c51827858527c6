//! Holds a record of the read-out, and offers its words one by one or its vertices together.
//!
//! 1. A record goes into registers straight from the memory, and the word is chosen behind them, so that no path begins
//!    in the memory and ends in the answer stream.
//!
//! Latency: 1 clock from `read_done` to `word`.

use super::record_words::RecordWords;
use super::types::Word;
use crate::engine::types::VertexId;
use crate::mesh::Record;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RecordBuffer {
    pub clock: Signal<In, Clock>,
    /// A reset drops the record.
    pub reset: Signal<In, Bit>,
    /// A record comes; allowed only while none is held (`holds`) or the one held is taken whole.
    pub read_done: Signal<In, Bit>,
    pub record: Signal<In, Record>,
    pub holds: Signal<Out, Bit>,
    /// The first word that has not been taken; `is_at_last` says that no other follows.
    pub word: Signal<Out, Word>,
    pub is_at_last: Signal<Out, Bit>,
    /// The word is taken at this edge; allowed only while `holds` is high.
    pub takes: Signal<In, Bit>,
    /// Vertices of the record, valid while no word of it has been taken.
    pub vertex0: Signal<Out, VertexId>,
    pub vertex1: Signal<Out, VertexId>,
    pub vertex2: Signal<Out, VertexId>,
    /// The whole record is taken at this edge; allowed only while `holds` is high and no word has been taken.
    pub takes_whole: Signal<In, Bit>,
    is_held: DFF<Bit>,
    buffer0: DFF<Word>,
    buffer1: DFF<Word>,
    buffer2: DFF<Word>,
    is_second: DFF<Bit>,
    is_third: DFF<Bit>,
    words: RecordWords,
}

impl Logic for RecordBuffer {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_held, buffer0, buffer1, buffer2, is_second, is_third);
        self.holds.next = self.is_held.q.val();
        self.words.record.next = self.record.val();
        self.vertex0.next = self.buffer0.q.val().get_bits::<15>(0);
        self.vertex1.next = self.buffer1.q.val().get_bits::<15>(0);
        self.vertex2.next = self.buffer2.q.val().get_bits::<15>(0);
        if self.takes_whole.val() {
            self.is_held.d.next = false;
        }
        if self.read_done.val() {
            self.is_held.d.next = true;
            self.buffer0.d.next = self.words.word0.val();
            self.buffer1.d.next = self.words.word1.val();
            self.buffer2.d.next = self.words.word2.val();
        }
        self.is_at_last.next = self.is_third.q.val();
        self.word.next = self.buffer0.q.val();
        if self.is_second.q.val() {
            self.word.next = self.buffer1.q.val();
        }
        if self.is_third.q.val() {
            self.word.next = self.buffer2.q.val();
        }
        if self.takes.val() {
            self.is_second.d.next = (!self.is_second.q.val()) & (!self.is_third.q.val());
            self.is_third.d.next = self.is_second.q.val();
            self.is_held.d.next = !self.is_third.q.val();
        }
        if self.reset.val() {
            self.is_held.d.next = false;
            self.is_second.d.next = false;
            self.is_third.d.next = false;
        }
    }
}
