//! Cuts the answers of the core into parts that fit in a datagram, and offers their words byte by byte.
//! [`AnswerPacker`](crate::serial::AnswerPacker) for datagrams: parts of 360 words, and a byte in every clock.
//!
//! 1. Every part but the last has 360 words. The second word of an answer holds the length of the answer, below 2^17.
//! 2. A part is due as soon as its first word is held. The first part waits for the second word of the answer as well:
//!    the block reads the length from that word while the core offers it, and takes the word later.
//! 3. `byte_valid` depends on registers only. A byte on offer stays until `takes`.
//!
//! Latency: 3 clocks from the first two words of an answer to `is_due`. A word follows the one before without a gap, if
//! it is there in the clock of that one's last byte.
//!
//! An answer of three words: its head, its length 1, and one word behind them:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9 10 11 12 13 14 15 16 17 18 19 20 21
//! word_valid      /^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\____________________
//! word_ready      /^^\__________________________/^^\________/^^  .  .  .  .  .  .  .
//! is_due          _________/^^^^^^^^^^^\____________________________________________
//! is_last           .  .  ./^^^^^^^^^^^  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .
//! starts          __________________/^^\____________________________________________
//! takes           _____________________/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\________
//! byte_valid      _____________________/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\________
//! byte_data         .  .  .  .  .  .  .  1  2  3  4  1  0  0  0  9 10 11 12  .  .  .
//! byte_is_last      .  .  .  .  .  .  ._________________________________/^^  .  .  .
//! ended           ____________________________________________________________/^^\__
//! awaits          /^^\___________________________________________________________/^^
//! ```

use crate::commands::types::Word;
use crate::prelude::*;
use crate::serial::types::Byte;
use incircle_protocol::MAX_DATAGRAM_WORDS;

/// The event that the cutting of an answer awaits.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum AnswerPartState {
    /// The first word of an answer.
    Head,
    /// The second word of the answer, which holds the length.
    Length,
    /// The beginning of the datagram of a part.
    Start,
    /// The bytes of the part, which the datagram takes.
    Words,
    /// The end of the datagram with the last part.
    Rest,
}

#[derive(LogicBlock, Default)]
pub struct AnswerParts {
    pub clock: Signal<In, Clock>,
    /// After a reset the block awaits answer number 0.
    pub reset: Signal<In, Bit>,
    /// The answer stream of the core, word by word.
    pub word_valid: Signal<In, Bit>,
    pub word_ready: Signal<Out, Bit>,
    pub word_data: Signal<In, Word>,
    /// A part is ready to be sent; `is_last` says that the part is the last one of its answer.
    pub is_due: Signal<Out, Bit>,
    pub is_last: Signal<Out, Bit>,
    /// The datagram of the part begins at this edge.
    pub starts: Signal<In, Bit>,
    /// Number of answers that have been sent to their end, and index of the part's first word in its answer.
    pub answers: Signal<Out, Word>,
    pub first_index: Signal<Out, Bits<17>>,
    /// A byte of the part, and whether it is the last one.
    pub byte_valid: Signal<Out, Bit>,
    pub byte_data: Signal<Out, Byte>,
    pub byte_is_last: Signal<Out, Bit>,
    pub takes: Signal<In, Bit>,
    /// The datagram with the last part of the answer has ended.
    pub ended: Signal<In, Bit>,
    /// The block has no word of an answer yet.
    pub awaits: Signal<Out, Bit>,
    state: DFF<AnswerPartState>,
    word: DFF<Word>,
    is_held: DFF<Bit>,
    byte_place: DFF<Bits<2>>,
    /// The word held is the first one of the answer.
    is_head: DFF<Bit>,
    /// Words of the answer behind the word held, not counting the second word of the answer.
    after: DFF<Bits<17>>,
    /// Index of the word held in its answer and in its part.
    word_index: DFF<Bits<17>>,
    position: DFF<Bits<9>>,
    sent: DFF<Word>,
    is_settled: DFF<Bit>,
    is_short: DFF<Bit>,
    part_ends: DFF<Bit>,
    is_end: DFF<Bit>,
    takes_last: Signal<Local, Bit>,
    may_load: Signal<Local, Bit>,
    loads: Signal<Local, Bit>,
    many: Signal<Local, Byte>,
    few: Signal<Local, Bits<9>>,
    ends: Signal<Local, Bit>,
    one: Signal<Local, Bits<17>>,
    one_word: Signal<Local, Word>,
    one_place: Signal<Local, Bits<2>>,
    one_position: Signal<Local, Bits<9>>,
    last_place: Signal<Local, Bits<2>>,
    last_position: Signal<Local, Bits<9>>,
    eight: Signal<Local, Word>,
}

const _: () = assert!(MAX_DATAGRAM_WORDS == 360, "the parts of this block are as long as the protocol says");

impl Logic for AnswerParts {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, word, is_held, byte_place, is_head, after, word_index, position, sent);
        dff_setup!(self, clock, is_settled, is_short, part_ends, is_end);
        self.one.next = 1.into();
        self.one_word.next = 1.into();
        self.one_place.next = 1.into();
        self.one_position.next = 1.into();
        self.last_place.next = 3.into();
        self.last_position.next = 359.into();
        self.eight.next = 8.into();
        self.is_due.next = (self.state.q.val() == AnswerPartState::Start) & self.is_settled.q.val();
        self.is_last.next = self.is_short.q.val();
        self.answers.next = self.sent.q.val();
        self.first_index.next = self.word_index.q.val();
        self.byte_valid.next = (self.state.q.val() == AnswerPartState::Words) & self.is_held.q.val();
        self.byte_data.next = self.word.q.val().get_bits::<8>(0);
        self.byte_is_last.next = self.part_ends.q.val() & (self.byte_place.q.val() == self.last_place.val());
        self.awaits.next = self.state.q.val() == AnswerPartState::Head;

        // The flags come from registers and so are a clock late; `is_settled` keeps `is_due` low until they fit the
        // word held. A word is held for four clocks at least, so they fit when its last byte is taken.
        self.many.next = self.after.q.val().get_bits::<8>(9);
        self.few.next = self.after.q.val().get_bits::<9>(0);
        self.is_short.d.next = (!self.many.val().any())
            & ((self.few.val() < self.last_position.val())
                | ((self.few.val() == self.last_position.val()) & (!self.is_head.q.val())));
        self.ends.next = (!self.after.q.val().any()) & (!self.is_head.q.val());
        self.is_end.d.next = self.ends.val();
        self.part_ends.d.next = self.ends.val() | (self.position.q.val() == self.last_position.val());
        self.is_settled.d.next = self.is_held.q.val() & (self.state.q.val() == AnswerPartState::Start);

        self.takes_last.next = self.takes.val()
            & (self.byte_place.q.val() == self.last_place.val())
            & (self.state.q.val() == AnswerPartState::Words);
        self.may_load.next = ((!self.is_held.q.val())
            & ((self.state.q.val() == AnswerPartState::Start) | (self.state.q.val() == AnswerPartState::Words)))
            | (self.takes_last.val() & (!self.is_end.q.val()));
        self.word_ready.next = self.may_load.val() | (self.state.q.val() == AnswerPartState::Head);
        self.loads.next = self.may_load.val() & self.word_valid.val();
        if self.takes.val() {
            self.byte_place.d.next = self.byte_place.q.val() + self.one_place.val();
            self.word.d.next = self.word.q.val() >> self.eight.val();
        }
        if self.takes_last.val() {
            self.is_held.d.next = false;
        }
        if self.loads.val() {
            self.word.d.next = self.word_data.val();
            self.is_held.d.next = true;
            self.is_head.d.next = false;
            if !self.is_head.q.val() {
                self.after.d.next = self.after.q.val() - self.one.val();
            }
            self.word_index.d.next = self.word_index.q.val() + self.one.val();
            self.position.d.next = self.position.q.val() + self.one_position.val();
            if self.position.q.val() == self.last_position.val() {
                self.position.d.next = 0.into();
            }
        }
        match self.state.q.val() {
            AnswerPartState::Head => {
                self.word.d.next = self.word_data.val();
                self.is_held.d.next = self.word_valid.val();
                self.byte_place.d.next = 0.into();
                self.word_index.d.next = 0.into();
                self.position.d.next = 0.into();
                self.is_head.d.next = true;
                if self.word_valid.val() {
                    self.state.d.next = AnswerPartState::Length;
                }
            }
            AnswerPartState::Length => {
                self.after.d.next = self.word_data.val().get_bits::<17>(0);
                if self.word_valid.val() {
                    self.state.d.next = AnswerPartState::Start;
                }
            }
            AnswerPartState::Start => {
                if self.starts.val() {
                    self.state.d.next = AnswerPartState::Words;
                }
            }
            AnswerPartState::Words => {
                if self.takes_last.val() & self.part_ends.q.val() {
                    self.state.d.next = AnswerPartState::Start;
                    if self.is_end.q.val() {
                        self.state.d.next = AnswerPartState::Rest;
                    }
                }
            }
            AnswerPartState::Rest => {
                if self.ended.val() {
                    self.sent.d.next = self.sent.q.val() + self.one_word.val();
                    self.state.d.next = AnswerPartState::Head;
                }
            }
            _ => {
                self.state.d.next = AnswerPartState::Head;
            }
        }
        if self.reset.val() {
            self.state.d.next = AnswerPartState::Head;
            self.sent.d.next = 0.into();
            self.is_held.d.next = false;
        }
    }
}
