//! Chooses the next byte of a frame to the host among the header, the greeting, the digests, the words
//! and the check sum.
//!
//! 1. A check sum is the complement of its state.
//!
//! Latency: 1 clock from `part` and `index` to the byte.

use super::types::{AnswerPlace, Byte};
use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct FrameBytes {
    pub clock: Signal<In, Clock>,
    /// Part of the frame, numbered as in `BytePlace`, and the low bits of the byte's index in its part.
    pub part: Signal<In, Bits<3>>,
    pub index: Signal<In, Bits<2>>,
    /// The digest is that of an answer; otherwise the digest is that of the payload.
    pub ends_answer: Signal<In, Bit>,
    /// The byte to send if `part` is the header, the greeting or the words.
    pub header: Signal<In, Byte>,
    pub greeting: Signal<In, Byte>,
    pub word: Signal<In, Byte>,
    /// Place of the frame's part of the answer.
    pub answer: Signal<In, AnswerPlace>,
    /// States of three check sums: over the payload of the session, over the answer, over the frame.
    pub payload_state: Signal<In, Word>,
    pub answer_state: Signal<In, Word>,
    pub sum_state: Signal<In, Word>,
    /// The chosen byte, a clock after `part` and `index`.
    pub byte_data: Signal<Out, Byte>,
    chosen: DFF<Byte>,
    payload_byte: Signal<Local, Byte>,
    answer_byte: Signal<Local, Byte>,
    sum_byte: Signal<Local, Byte>,
    head_byte: Signal<Local, Byte>,
    all: Signal<Local, Byte>,
}

impl Logic for FrameBytes {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, chosen);
        self.byte_data.next = self.chosen.q.val();
        self.all.next = 0xff.into();
        match self.index.val().index() {
            0 => {
                self.payload_byte.next = self.payload_state.val().get_bits::<8>(0);
                self.answer_byte.next = self.answer_state.val().get_bits::<8>(0);
                self.sum_byte.next = self.sum_state.val().get_bits::<8>(0);
                self.head_byte.next = self.answer.val().number;
            }
            1 => {
                self.payload_byte.next = self.payload_state.val().get_bits::<8>(8);
                self.answer_byte.next = self.answer_state.val().get_bits::<8>(8);
                self.sum_byte.next = self.sum_state.val().get_bits::<8>(8);
                self.head_byte.next = 0.into();
            }
            2 => {
                self.payload_byte.next = self.payload_state.val().get_bits::<8>(16);
                self.answer_byte.next = self.answer_state.val().get_bits::<8>(16);
                self.sum_byte.next = self.sum_state.val().get_bits::<8>(16);
                self.head_byte.next = self.answer.val().part;
            }
            _ => {
                self.payload_byte.next = self.payload_state.val().get_bits::<8>(24);
                self.answer_byte.next = self.answer_state.val().get_bits::<8>(24);
                self.sum_byte.next = self.sum_state.val().get_bits::<8>(24);
                self.head_byte.next = self.answer.val().part;
            }
        }
        match self.part.val().index() {
            0 => {
                self.chosen.d.next = self.header.val();
            }
            1 => {
                self.chosen.d.next = self.greeting.val();
            }
            2 => {
                self.chosen.d.next = self.payload_byte.val() ^ self.all.val();
                if self.ends_answer.val() {
                    self.chosen.d.next = self.answer_byte.val() ^ self.all.val();
                }
            }
            3 => {
                self.chosen.d.next = self.head_byte.val();
            }
            4 => {
                self.chosen.d.next = self.word.val();
            }
            _ => {
                self.chosen.d.next = self.sum_byte.val() ^ self.all.val();
            }
        }
    }
}
