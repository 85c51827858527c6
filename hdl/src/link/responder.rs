//! Sends answers: header and length in one beat, then the payload. Records are read from the triangle memory one at a time, or one a
//! clock where their vertices alone are sent.
//!
//! 1. What is offered is held until it is taken; `response_valid` does not wait for `response_ready`.
//! 2. Word `k` of a record holds `v[k]` in bits 0 to 14, `n[k]` in bits 15 to 29; bit 31 of word 0 is the lock bit.
//! 3. The second word is zero where there is none.
//!
//! Latency: 4 clocks from `answers` to the header; 3 clocks a word, 7 a record: the read's 3 and 4 more. Vertices: 1 clock a record, and
//! the first beat of theirs 8 clocks after the header.
//!
//! A read of one record, whose header has to wait; `beat` counts the beats of the answer:
//! ```text
//! answers         ___/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\________
//! read            _______________/^^\_____________________________
//! response_valid  _______________/^^^^^^^^\________/^^^^^^^^\_____
//! beat              .  .  .  .  .  0  0  0  .  .  .  1  2  3  .  .
//! response_ready  /^^^^^^^^^^^^^^\_____/^^^^^^^^^^^^^^^^^^^^^^^^^^
//! response_last   _______________________________________/^^\_____
//! ends            ____________________________________/^^\________
//! is_idle         /^^^^^\________________________________/^^^^^^^^
//! ```

use super::{AnswerBeat, RecordReads, WordPair, WORD_PAIR_BITS};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Which part of an answer is loaded next.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum AnswerState {
    /// None.
    Idle,
    /// None: header and length are being computed.
    Prepare,
    /// Header and length.
    Header,
    /// None: a word of the payload is being chosen.
    Choose,
    /// A word of the payload.
    Payload,
    /// A beat of records or vertices.
    Records,
}

/// The answer stream; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Responder {
    /// Reset drops an answer.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// An answer is due, held until `ends`.
    pub answers: Signal<In, Bit>,
    /// Counts are being cleared: no answer begins.
    pub sweeps: Signal<In, Bit>,
    /// First record of a read, and number of its records.
    pub first: Signal<In, Bits<32>>,
    pub count: Signal<In, Bits<32>>,
    pub header: Signal<In, Bits<32>>,
    pub length: Signal<In, Bits<32>>,
    pub is_empty: Signal<In, Bit>,
    pub is_read: Signal<In, Bit>,
    pub is_packed: Signal<In, Bit>,
    /// A word of the payload, from `AnswerWords`, good from `chooses` to the next one.
    pub word: Signal<In, Bits<32>>,
    /// Word of the payload that is wanted.
    pub index: Signal<Out, Bits<7>>,
    /// What `index` becomes at this edge, if it changes.
    pub index_ahead: Signal<Out, Bits<7>>,
    /// The word that `index` was a clock ago is taken into a register at this edge, and is then `word`.
    pub chooses: Signal<Out, Bit>,
    /// A record is wanted.
    pub read: Signal<Out, Bit>,
    pub read_id: Signal<Out, Bits<15>>,
    pub read_done: Signal<In, Bit>,
    pub v0: Signal<In, Bits<15>>,
    pub v1: Signal<In, Bits<15>>,
    pub v2: Signal<In, Bits<15>>,
    /// Its column.
    pub n0: Signal<In, Bits<15>>,
    /// Its column.
    pub n1: Signal<In, Bits<15>>,
    /// Its column.
    pub n2: Signal<In, Bits<15>>,
    pub was_set: Signal<In, Bit>,
    /// The answer stream.
    pub response_valid: Signal<Out, Bit>,
    pub response_ready: Signal<In, Bit>,
    pub response_data: Signal<Out, Bits<64>>,
    /// Bits 63 to 32 are a second word, which follows the first; the last word of the answer is here.
    pub response_both: Signal<Out, Bit>,
    pub response_last: Signal<Out, Bit>,
    /// No answer is under way; its last word is loaded at this edge; no word waits, or it is taken.
    pub is_idle: Signal<Out, Bit>,
    pub ends: Signal<Out, Bit>,
    pub is_taken: Signal<Out, Bit>,
    state: DFF<AnswerState>,
    following: DFF<Bits<7>>,
    /// The first of the two clocks of `Prepare` or `Choose` is over.
    waited: DFF<Bit>,
    valid: DFF<Bit>,
    offered: DFF<AnswerBeat>,
    left: DFF<Bits<32>>,
    /// One word is left.
    is_last: DFF<Bit>,
    loaded: DFF<Bits<7>>,
    records: RecordReads,
    pair: Signal<Local, WordPair>,
    pair_bits: Signal<Local, Bits<WORD_PAIR_BITS>>,
    loads: Signal<Local, Bit>,
    ends_now: Signal<Local, Bit>,
    no_word: Signal<Local, Bits<32>>,
    one: Signal<Local, Bits<32>>,
    two: Signal<Local, Bits<32>>,
    one_word: Signal<Local, Bits<7>>,
}

impl Logic for Responder {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, waited, valid, offered, left, is_last, loaded, following);
        clock!(self, clock, records);
        self.no_word.next = 0.into();
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.one_word.next = 1.into();

        self.response_valid.next = self.valid.q.val();
        self.pair.next.low = self.offered.q.val().low;
        self.pair.next.high = self.offered.q.val().high;
        self.pair_bits.next = self.pair.val().into();
        self.response_data.next = self.pair_bits.val();
        self.response_both.next = self.offered.q.val().both;
        self.response_last.next = self.offered.q.val().last;
        self.index.next = self.loaded.q.val();
        self.index_ahead.next = self.following.q.val();
        self.chooses.next = (self.state.q.val() == AnswerState::Choose) & self.waited.q.val();
        self.loads.next = (!self.valid.q.val()) | self.response_ready.val();
        self.is_taken.next = self.loads.val();
        self.is_idle.next = self.state.q.val() == AnswerState::Idle;

        self.records.reset.next = self.reset.val();
        self.records.starts.next = self.state.q.val() == AnswerState::Header;
        self.records.first.next = self.first.val().get_bits::<15>(0);
        self.records.count.next = self.count.val().get_bits::<15>(0);
        self.records.is_packed.next = self.is_packed.val();
        self.records.runs.next = self.state.q.val() == AnswerState::Records;
        self.read.next = self.records.read.val();
        self.read_id.next = self.records.read_id.val();
        self.records.read_done.next = self.read_done.val();
        self.records.v0.next = self.v0.val();
        self.records.v1.next = self.v1.val();
        self.records.v2.next = self.v2.val();
        self.records.n0.next = self.n0.val();
        self.records.n1.next = self.n1.val();
        self.records.n2.next = self.n2.val();
        self.records.was_set.next = self.was_set.val();

        self.records.takes.next = false;
        self.ends_now.next = false;
        self.valid.d.next = self.valid.q.val() & (!self.loads.val());
        match self.state.q.val() {
            AnswerState::Idle => {
                if self.answers.val() & (!self.sweeps.val()) {
                    self.state.d.next = AnswerState::Prepare;
                }
            }
            AnswerState::Prepare => {
                self.following.d.next = 0.into();
                self.waited.d.next = !self.waited.q.val();
                if self.waited.q.val() {
                    self.state.d.next = AnswerState::Header;
                }
            }
            AnswerState::Header => {
                self.left.d.next = self.length.val();
                self.is_last.d.next = self.length.val() == self.one.val();
                self.loaded.d.next = 0.into();
                if self.loads.val() {
                    self.valid.d.next = true;
                    self.offered.d.next.low = self.header.val();
                    self.offered.d.next.high = self.length.val();
                    self.offered.d.next.both = true;
                    self.offered.d.next.last = self.is_empty.val();
                    self.ends_now.next = self.is_empty.val();
                    self.state.d.next = AnswerState::Choose;
                    if self.is_read.val() {
                        self.state.d.next = AnswerState::Records;
                    }
                }
            }
            AnswerState::Choose => {
                self.following.d.next = self.loaded.q.val() + self.one_word.val();
                self.waited.d.next = !self.waited.q.val();
                if self.waited.q.val() {
                    self.state.d.next = AnswerState::Payload;
                }
            }
            AnswerState::Payload => {
                if self.loads.val() {
                    self.valid.d.next = true;
                    self.offered.d.next.low = self.word.val();
                    self.offered.d.next.high = self.no_word.val();
                    self.offered.d.next.both = false;
                    self.offered.d.next.last = self.is_last.q.val();
                    self.loaded.d.next = self.loaded.q.val() + self.one_word.val();
                    self.left.d.next = self.left.q.val() - self.one.val();
                    self.is_last.d.next = self.left.q.val() == self.two.val();
                    self.state.d.next = AnswerState::Choose;
                    self.ends_now.next = self.is_last.q.val();
                }
            }
            AnswerState::Records => {
                if self.loads.val() & self.records.valid.val() {
                    self.valid.d.next = true;
                    self.offered.d.next = self.records.beat.val();
                    self.records.takes.next = true;
                    self.ends_now.next = self.records.beat.val().last;
                }
            }
            _ => {
                self.state.d.next = AnswerState::Idle;
            }
        }
        self.ends.next = self.ends_now.val();
        if self.ends_now.val() {
            self.state.d.next = AnswerState::Idle;
        }
        if self.reset.val() {
            self.state.d.next = AnswerState::Idle;
            self.waited.d.next = false;
            self.valid.d.next = false;
            self.offered.d.next.low = self.no_word.val();
            self.offered.d.next.high = self.no_word.val();
            self.offered.d.next.both = false;
            self.offered.d.next.last = false;
        }
    }
}
