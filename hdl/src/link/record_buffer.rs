//! Holds a record that has been read, and hands out its words, or its vertices alone.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset drops the record |
//! | `read_done`, `v0..v2`, `n0..n2`, `was_set` | in | 1, 15, 1 | a record comes; only when none is held, or when it is taken whole |
//! | `holds` | out | 1 | a word is left |
//! | `word`, `is_at_last` | out | 32, 1 | the first that is left; there is no other |
//! | `takes` | in | 1 | it is taken at this edge; only while `holds` |
//! | `vertex0..2` | out | 15 | the vertices of the record, while no word of it has been taken |
//! | `takes_whole` | in | 1 | all of it is taken at this edge; only while `holds`, and no word of it has been |
//!
//! 1. The record goes into registers straight from the memory; the word is chosen behind them.
//!
//! Latency: 1 clock.

use super::RecordWords;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// A record that has been read; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct RecordBuffer {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Drops the record.
    pub reset: Signal<In, Bit>,
    /// A record comes.
    pub read_done: Signal<In, Bit>,
    /// Its column.
    pub v0: Signal<In, Bits<15>>,
    /// Its column.
    pub v1: Signal<In, Bits<15>>,
    /// Its column.
    pub v2: Signal<In, Bits<15>>,
    /// Its column.
    pub n0: Signal<In, Bits<15>>,
    /// Its column.
    pub n1: Signal<In, Bits<15>>,
    /// Its column.
    pub n2: Signal<In, Bits<15>>,
    /// Its lock bit.
    pub was_set: Signal<In, Bit>,
    /// A word is left.
    pub holds: Signal<Out, Bit>,
    /// The first that is left.
    pub word: Signal<Out, Bits<32>>,
    /// There is no other.
    pub is_at_last: Signal<Out, Bit>,
    /// It is taken.
    pub takes: Signal<In, Bit>,
    /// A vertex.
    pub vertex0: Signal<Out, Bits<15>>,
    /// A vertex.
    pub vertex1: Signal<Out, Bits<15>>,
    /// A vertex.
    pub vertex2: Signal<Out, Bits<15>>,
    /// The whole record is taken.
    pub takes_whole: Signal<In, Bit>,
    is_held: DFF<Bit>,
    buffer0: DFF<Bits<32>>,
    buffer1: DFF<Bits<32>>,
    buffer2: DFF<Bits<32>>,
    is_second: DFF<Bit>,
    is_third: DFF<Bit>,
    words: RecordWords,
}

impl Logic for RecordBuffer {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_held, buffer0, buffer1, buffer2, is_second, is_third);
        self.holds.next = self.is_held.q.val();
        self.words.v0.next = self.v0.val();
        self.words.v1.next = self.v1.val();
        self.words.v2.next = self.v2.val();
        self.words.n0.next = self.n0.val();
        self.words.n1.next = self.n1.val();
        self.words.n2.next = self.n2.val();
        self.words.was_set.next = self.was_set.val();
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
