//! Cuts the answers of the core into parts that fit in a frame, and offers their words byte by byte, because an answer
//! may be longer than the payload of a frame.
//!
//! 1. Every part but the last has 256 words. The second word of an answer holds the length of the answer, below 2^17.
//! 2. `word_ready`, `is_due` and `byte_valid` depend on registers only.
//! 3. A part is due as soon as its first word is held. The first part waits for the second word of the answer as well:
//!    the block reads the length from that word while the core offers it, and takes the word later.
//!
//! Latency: 3 clocks from the first two words of an answer to `is_due`.

use super::types::{AnswerPlace, Byte};
use crate::commands::types::Word;
use crate::prelude::*;
use incircle_protocol::MAX_PAYLOAD;

/// The event that the packer awaits.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum PackState {
    /// The first word of an answer.
    Head,
    /// The second word of the answer, which holds the length.
    Length,
    /// The beginning of the frame of a part.
    Start,
    /// The sender, which takes the bytes of the part.
    Words,
    /// The end of the frame with the last part.
    Rest,
}

#[derive(LogicBlock, Default)]
pub struct AnswerPacker {
    pub clock: Signal<In, Clock>,
    /// After a reset the packer awaits answer number 0.
    pub reset: Signal<In, Bit>,
    /// The answer stream of the core, word by word.
    pub word_valid: Signal<In, Bit>,
    pub word_ready: Signal<Out, Bit>,
    pub word_data: Signal<In, Word>,
    /// A part is ready to be sent; `is_last` says that the part is the last one of its answer.
    pub is_due: Signal<Out, Bit>,
    pub is_last: Signal<Out, Bit>,
    /// The frame of the part begins at this edge.
    pub starts: Signal<In, Bit>,
    /// Place of the part, for the header of the answer in the frame.
    pub answer: Signal<Out, AnswerPlace>,
    /// A byte of the part; the sender takes the byte at the edge at which `takes` is high.
    pub byte_valid: Signal<Out, Bit>,
    pub byte_data: Signal<Out, Byte>,
    pub takes: Signal<In, Bit>,
    /// The byte on offer is the last one of the part.
    pub byte_is_last: Signal<Out, Bit>,
    /// The frame with the last part of the answer has ended.
    pub ended: Signal<In, Bit>,
    /// The packer has no word of an answer yet.
    pub awaits: Signal<Out, Bit>,
    state: DFF<PackState>,
    word: DFF<Word>,
    is_held: DFF<Bit>,
    place: DFF<Bits<2>>,
    /// The word held is the first one of the answer.
    is_head: DFF<Bit>,
    /// Words of the answer behind the word held, not counting the second word of the answer.
    after: DFF<Bits<17>>,
    /// Index of the word held in its part.
    position: DFF<Byte>,
    part_number: DFF<Byte>,
    answers: DFF<Byte>,
    is_settled: DFF<Bit>,
    is_short: DFF<Bit>,
    part_ends: DFF<Bit>,
    is_taking: Signal<Local, Bit>,
    loads: Signal<Local, Bit>,
    many: Signal<Local, Bits<9>>,
    few: Signal<Local, Byte>,
    is_end: Signal<Local, Bit>,
    one: Signal<Local, Bits<17>>,
    one_byte: Signal<Local, Byte>,
    one_place: Signal<Local, Bits<2>>,
    last_place: Signal<Local, Bits<2>>,
    last_position: Signal<Local, Byte>,
}

const _: () = assert!(MAX_PAYLOAD == 4 * 256, "the parts of this block are as long as the protocol says");

impl Logic for AnswerPacker {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, word, is_held, place, after, position, part_number, answers);
        dff_setup!(self, clock, is_settled, is_short, part_ends, is_head);
        self.one.next = 1.into();
        self.one_byte.next = 1.into();
        self.one_place.next = 1.into();
        self.last_place.next = 3.into();
        self.last_position.next = 255.into();
        self.is_due.next = (self.state.q.val() == PackState::Start) & self.is_settled.q.val();
        self.is_last.next = self.is_short.q.val();
        self.answer.next.number = self.answers.q.val();
        self.answer.next.part = self.part_number.q.val();
        self.byte_valid.next = (self.state.q.val() == PackState::Words) & self.is_held.q.val();
        // A choice among four bytes is smaller than a word that shifts, because the word then has one source only.
        self.byte_data.next = self.word.q.val().get_bits::<8>(0);
        match self.place.q.val().index() {
            1 => {
                self.byte_data.next = self.word.q.val().get_bits::<8>(8);
            }
            2 => {
                self.byte_data.next = self.word.q.val().get_bits::<8>(16);
            }
            3 => {
                self.byte_data.next = self.word.q.val().get_bits::<8>(24);
            }
            _ => {
                self.byte_data.next = self.word.q.val().get_bits::<8>(0);
            }
        }
        self.byte_is_last.next = self.part_ends.q.val() & (self.place.q.val() == self.last_place.val());
        self.awaits.next = self.state.q.val() == PackState::Head;

        // The flags come from registers and so are a clock late; `is_settled` keeps `is_due` low until they
        // fit the word held.
        self.many.next = self.after.q.val().get_bits::<9>(8);
        self.few.next = self.after.q.val().get_bits::<8>(0);
        self.is_short.d.next =
            (!self.many.val().any()) & ((!self.is_head.q.val()) | (self.few.val() != self.last_position.val()));
        self.is_end.next = (!self.after.q.val().any()) & (!self.is_head.q.val());
        self.part_ends.d.next = self.is_end.val() | (self.position.q.val() == self.last_position.val());
        self.is_settled.d.next = self.is_held.q.val() & (self.state.q.val() == PackState::Start);

        self.is_taking.next = (!self.is_held.q.val())
            & ((self.state.q.val() == PackState::Start) | (self.state.q.val() == PackState::Words));
        self.word_ready.next = self.is_taking.val() | (self.state.q.val() == PackState::Head);
        self.loads.next = self.is_taking.val() & self.word_valid.val();
        if self.loads.val() {
            self.word.d.next = self.word_data.val();
            self.is_held.d.next = true;
            self.is_head.d.next = false;
            if !self.is_head.q.val() {
                self.after.d.next = self.after.q.val() - self.one.val();
            }
            self.position.d.next = self.position.q.val() + self.one_byte.val();
            if self.position.q.val() == self.last_position.val() {
                self.part_number.d.next = self.part_number.q.val() + self.one_byte.val();
            }
        }
        match self.state.q.val() {
            PackState::Head => {
                self.word.d.next = self.word_data.val();
                self.is_held.d.next = self.word_valid.val();
                self.place.d.next = 0.into();
                self.position.d.next = 0.into();
                self.part_number.d.next = 0.into();
                if self.word_valid.val() {
                    self.state.d.next = PackState::Length;
                }
            }
            PackState::Length => {
                self.after.d.next = self.word_data.val().get_bits::<17>(0);
                self.is_head.d.next = true;
                if self.word_valid.val() {
                    self.state.d.next = PackState::Start;
                }
            }
            PackState::Start => {
                if self.starts.val() {
                    self.state.d.next = PackState::Words;
                }
            }
            PackState::Words => {
                if self.takes.val() {
                    self.place.d.next = self.place.q.val() + self.one_place.val();
                    if self.place.q.val() == self.last_place.val() {
                        self.is_held.d.next = false;
                        if self.part_ends.q.val() {
                            self.state.d.next = PackState::Start;
                            if self.is_end.val() {
                                self.state.d.next = PackState::Rest;
                            }
                        }
                    }
                }
            }
            PackState::Rest => {
                if self.ended.val() {
                    self.answers.d.next = self.answers.q.val() + self.one_byte.val();
                    self.state.d.next = PackState::Head;
                }
            }
            _ => {
                self.state.d.next = PackState::Head;
            }
        }
        if self.reset.val() {
            self.state.d.next = PackState::Head;
            self.answers.d.next = 0.into();
            self.is_held.d.next = false;
        }
    }
}
