//! Sends answers: header and length in one beat, then the payload. Records come from the triangle memory, two in three
//! clocks, or one a clock if only their vertices are sent.
//!
//! 1. A beat on offer stays until it is taken; `response_valid` does not wait for `response_ready`.
//! 2. Word `k` of a record holds `v[k]` in bits 0 to 14 and `n[k]` in bits 15 to 29; bit 31 of word 0 is the lock bit.
//! 3. Bits 63 to 32 are zero in a beat of one word.
//!
//! Latency: 4 clocks from `answers` to the header. A word takes 3 clocks. The first beat of records comes 7 clocks
//! after the header, or 8 if only vertices are sent.
//!
//! A `Read` of three records, whose header has to wait; `beat` counts the beats of the answer:
//! ```text
//! answers         ___/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\___________
//! read            _______________/^^^^^\__/^^\________________________________
//! response_valid  _______________/^^^^^^^^\___________/^^^^^^^^^^^^^^\________
//! beat              .  .  .  .  .  0  0  0  .  .  .  .  1  2  3  4  5  .  .  .
//! response_ready  /^^^^^^^^^^^^^^\_____/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
//! response_last   ________________________________________________/^^\________
//! ends            _____________________________________________/^^\___________
//! is_idle         /^^^^^\_________________________________________/^^^^^^^^^^^
//! ```

use super::channels::AnswerSource;
use super::payload_words::PayloadWords;
use super::record_reads::RecordReads;
use super::types::{AnswerBeat, AnswerProgress, Head, Request, Word, WordIndex, WordPair, WORD_PAIR_BITS};
use crate::engine::types::{TriangleId, VertexId};
use crate::mesh::Record;
use crate::prelude::*;

/// The part of an answer that the output loads next.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum AnswerState {
    /// No part, because no answer is due.
    Idle,
    /// No part yet: header and length are being computed.
    Prepare,
    /// The header and the length.
    Header,
    /// A word of a payload that has no records.
    Words,
    /// A beat of records or vertices.
    Records,
}

#[derive(LogicBlock, Default)]
pub struct Responder {
    pub clock: Signal<In, Clock>,
    /// A reset drops the answer under way.
    pub reset: Signal<In, Bit>,
    /// An answer is due; held until `progress.ends`.
    pub answers: Signal<In, Bit>,
    /// Counts are being cleared, so no answer may begin.
    pub sweeps: Signal<In, Bit>,
    /// The command, with the range of records of a read-out.
    pub request: Signal<In, Request>,
    /// Status and length from `AnswerHead`, valid 3 clocks after `answers` rises.
    pub head: Signal<In, Head>,
    /// A word of the payload from `AnswerWords`, valid from `chooses` to the next `chooses`.
    pub word: Signal<In, Word>,
    /// Index of the wanted word, and the value that the index takes at this edge if it changes.
    pub index: Signal<Out, WordIndex>,
    pub index_ahead: Signal<Out, WordIndex>,
    /// The word whose number was `index` a clock ago goes into a register at this edge, and is `word` from then on.
    pub chooses: Signal<Out, Bit>,
    /// Read the record `read_id`.
    pub read: Signal<Out, Bit>,
    pub read_id: Signal<Out, TriangleId>,
    /// A record has come; records come in the order in which they were asked for.
    pub read_done: Signal<In, Bit>,
    pub record: Signal<In, Record>,
    pub response: AnswerSource,
    pub progress: Signal<Out, AnswerProgress>,
    /// In a core with deletions: the infinite vertex.
    pub infinite: Vec<Signal<In, VertexId>>,
    state: DFF<AnswerState>,
    /// The first of the two clocks of `Prepare` has passed.
    waited: DFF<Bit>,
    valid: DFF<Bit>,
    offered: DFF<AnswerBeat>,
    words: PayloadWords,
    records: RecordReads,
    pair: Signal<Local, WordPair>,
    pair_bits: Signal<Local, Bits<WORD_PAIR_BITS>>,
    loads: Signal<Local, Bit>,
    ends: Signal<Local, Bit>,
}

impl Responder {
    /// The block of a core with deletions.
    pub fn with_deletions() -> Self {
        Self { infinite: vec![Signal::default()], records: RecordReads::with_deletions(), ..Self::default() }
    }
}

impl Logic for Responder {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, waited, valid, offered);
        clock!(self, clock, words, records);
        self.response.valid.next = self.valid.q.val();
        self.pair.next.low = self.offered.q.val().low;
        self.pair.next.high = self.offered.q.val().high;
        self.pair_bits.next = self.pair.val().into();
        self.response.data.next = self.pair_bits.val();
        self.response.both.next = self.offered.q.val().both;
        self.response.last.next = self.offered.q.val().last;
        self.loads.next = (!self.valid.q.val()) | self.response.ready.val();

        self.words.reset.next = self.reset.val();
        self.words.prepares.next = self.state.q.val() == AnswerState::Prepare;
        self.words.starts.next = self.state.q.val() == AnswerState::Header;
        self.words.length.next = self.head.val().length;
        self.words.runs.next = self.state.q.val() == AnswerState::Words;
        self.words.word.next = self.word.val();
        self.index.next = self.words.index.val();
        self.index_ahead.next = self.words.index_ahead.val();
        self.chooses.next = self.words.chooses.val();

        self.records.reset.next = self.reset.val();
        self.records.starts.next = self.state.q.val() == AnswerState::Header;
        self.records.first.next = bit_cast::<15, 32>(self.request.val().first);
        self.records.count.next = bit_cast::<15, 32>(self.request.val().count);
        self.records.is_packed.next = self.head.val().is_packed;
        self.records.has_short_ids.next = self.head.val().has_short_ids;
        self.records.has_rests.next = self.head.val().has_rests;
        self.records.runs.next = self.state.q.val() == AnswerState::Records;
        for i in 0..self.infinite.len() {
            self.records.infinite[i].next = self.infinite[i].val();
        }
        self.read.next = self.records.read.val();
        self.read_id.next = self.records.read_id.val();
        self.records.read_done.next = self.read_done.val();
        self.records.record.next = self.record.val();

        self.words.takes.next = false;
        self.records.takes.next = false;
        self.ends.next = false;
        self.valid.d.next = self.valid.q.val() & (!self.loads.val());
        match self.state.q.val() {
            AnswerState::Idle => {
                if self.answers.val() & (!self.sweeps.val()) {
                    self.state.d.next = AnswerState::Prepare;
                }
            }
            AnswerState::Prepare => {
                self.waited.d.next = !self.waited.q.val();
                if self.waited.q.val() {
                    self.state.d.next = AnswerState::Header;
                }
            }
            AnswerState::Header => {
                if self.loads.val() {
                    self.valid.d.next = true;
                    self.offered.d.next.low = self.head.val().header;
                    self.offered.d.next.high = self.head.val().length;
                    self.offered.d.next.both = true;
                    self.offered.d.next.last = self.head.val().is_empty;
                    self.ends.next = self.head.val().is_empty;
                    self.state.d.next = AnswerState::Words;
                    if self.head.val().is_read {
                        self.state.d.next = AnswerState::Records;
                    }
                }
            }
            AnswerState::Words => {
                if self.loads.val() & self.words.valid.val() {
                    self.valid.d.next = true;
                    self.offered.d.next = self.words.beat.val();
                    self.words.takes.next = true;
                    self.ends.next = self.words.beat.val().last;
                }
            }
            AnswerState::Records => {
                if self.loads.val() & self.records.valid.val() {
                    self.valid.d.next = true;
                    self.offered.d.next = self.records.beat.val();
                    self.records.takes.next = true;
                    self.ends.next = self.records.beat.val().last;
                }
            }
            _ => {
                self.state.d.next = AnswerState::Idle;
            }
        }
        if self.ends.val() {
            self.state.d.next = AnswerState::Idle;
        }
        if self.reset.val() {
            self.state.d.next = AnswerState::Idle;
            self.waited.d.next = false;
            self.valid.d.next = false;
            self.offered.d.next.low = 0.into();
            self.offered.d.next.high = 0.into();
            self.offered.d.next.both = false;
            self.offered.d.next.last = false;
        }
        self.progress.next.is_idle = self.state.q.val() == AnswerState::Idle;
        self.progress.next.ends = self.ends.val();
        self.progress.next.is_taken = self.loads.val();
    }
}
