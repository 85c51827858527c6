//! Sends a frame to the host: asks for its bytes in order, and hands them to the encoder.
//!
//! 1. `starts` may be high only while `is_idle` is high.
//! 2. A byte on offer stays until the encoder takes it, unless the frame is cut.
//!
//! Latency: 4 clocks from `starts` to the first byte. The next byte follows 4 clocks after a byte is taken, or later,
//! because the check sum must have taken the byte before.

use super::frame_part::FramePart;
use super::types::{Byte, BytePlace, Contents};
use crate::prelude::*;

/// The stage of the frame under way.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum SendState {
    /// No frame is under way; the sender awaits one.
    Idle,
    /// The sender loads the bytes of the frame, part by part.
    Parts,
    /// All bytes are loaded; the sender awaits the end of the frame.
    End,
}

#[derive(LogicBlock, Default)]
pub struct FrameSender {
    pub clock: Signal<In, Clock>,
    /// A reset drops the frame under way.
    pub reset: Signal<In, Bit>,
    /// A frame begins at this edge.
    pub starts: Signal<In, Bit>,
    /// The parts of the frame under way, from `FrameChoice`.
    pub contents: Signal<In, Contents>,
    /// The session is over: a frame that holds part of an answer ends at once, invalid.
    pub cuts: Signal<In, Bit>,
    /// Place of the byte that the sender asks for.
    pub at: Signal<Out, BytePlace>,
    /// The byte at that place, 2 clocks later. While `sum_is_busy` is high, a check sum has not
    /// covered the byte before.
    pub byte_data: Signal<In, Byte>,
    pub sum_is_busy: Signal<In, Bit>,
    /// The next byte of the words is there, and stays until it is loaded or the frame is cut; `word_byte_is_last`
    /// says that the byte is the last one of the words in this frame.
    pub word_byte_valid: Signal<In, Bit>,
    pub word_byte_is_last: Signal<In, Bit>,
    /// The sender loads a byte that the check sum of the frame covers; with `loads_word` the byte belongs to the words.
    pub loads: Signal<Out, Bit>,
    pub loads_word: Signal<Out, Bit>,
    /// The bytes of the frame, for the encoder.
    pub data_valid: Signal<Out, Bit>,
    pub data_ready: Signal<In, Bit>,
    pub data: Signal<Out, Byte>,
    /// No byte follows (`ends`); the frame is to be invalid (`is_cut`); the encoder has ended the frame (`ended`).
    pub ends: Signal<Out, Bit>,
    pub is_cut: Signal<Out, Bit>,
    pub ended: Signal<In, Bit>,
    /// The frame that ended was the last one of an answer, and was not cut.
    pub answer_ended: Signal<Out, Bit>,
    /// No frame is under way.
    pub is_idle: Signal<Out, Bit>,
    state: DFF<SendState>,
    part_number: DFF<Bits<3>>,
    place: DFF<Bits<6>>,
    /// Clocks for which the sender has asked for the byte, up to 2.
    asked_once: DFF<Bit>,
    asked_twice: DFF<Bit>,
    is_loaded: DFF<Bit>,
    loaded: DFF<Byte>,
    was_cut: DFF<Bit>,
    part_end: FramePart,
    is_words: Signal<Local, Bit>,
    is_sum: Signal<Local, Bit>,
    has_byte: Signal<Local, Bit>,
    takes: Signal<Local, Bit>,
    finishes: Signal<Local, Bit>,
    one: Signal<Local, Bits<6>>,
    words_part: Signal<Local, Bits<3>>,
    sum_part: Signal<Local, Bits<3>>,
}

impl Logic for FrameSender {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, part_number, place, asked_once, asked_twice, is_loaded, loaded, was_cut);
        clock!(self, clock, part_end);
        self.one.next = 1.into();
        self.words_part.next = 4.into();
        self.sum_part.next = 5.into();
        self.at.next.part = self.part_number.q.val();
        self.at.next.index = self.place.q.val();
        self.data_valid.next = self.is_loaded.q.val();
        self.data.next = self.loaded.q.val();
        self.is_cut.next = self.was_cut.q.val();
        self.is_idle.next = self.state.q.val() == SendState::Idle;
        self.ends.next = (self.state.q.val() == SendState::End) & (!self.is_loaded.q.val());
        self.answer_ended.next =
            self.ended.val() & self.contents.val().ends_answer & (!self.was_cut.q.val()) & (!self.cuts.val());

        // Ask for two clocks before loading a byte: the greeting and `FrameBytes` take one each. Ask only when the
        // check sums have covered the byte before, which takes them 9 clocks.
        self.part_end.at.next = self.at.val();
        self.part_end.word_byte_is_last.next = self.word_byte_is_last.val();
        self.is_words.next = self.part_number.q.val() == self.words_part.val();
        self.is_sum.next = self.part_number.q.val() == self.sum_part.val();
        self.has_byte.next =
            (self.state.q.val() == SendState::Parts) & ((!self.is_words.val()) | self.word_byte_valid.val());
        self.asked_once.d.next = self.has_byte.val() & (!self.is_loaded.q.val()) & (!self.sum_is_busy.val());
        // Once both clocks have passed, the byte is still there unless the frame is cut, so `takes` is a register: it
        // reaches the whole way of the answers, which is too long for a clock behind a decision.
        self.asked_twice.d.next = self.asked_once.q.val() & self.has_byte.val();
        self.takes.next = self.asked_twice.q.val();
        self.finishes.next = self.takes.val() & self.part_end.is_last.val();
        self.loads.next = self.takes.val() & (!self.is_sum.val());
        self.loads_word.next = self.takes.val() & self.is_words.val();
        if self.data_ready.val() {
            self.is_loaded.d.next = false;
        }
        if self.takes.val() {
            self.asked_once.d.next = false;
            self.asked_twice.d.next = false;
            self.is_loaded.d.next = true;
            self.loaded.d.next = self.byte_data.val();
            self.place.d.next = self.place.q.val() + self.one.val();
        }
        if self.finishes.val() {
            // Every part that is not followed by the check sum names its successor below.
            self.place.d.next = 0.into();
            self.part_number.d.next = 5.into();
            match self.part_number.q.val().index() {
                0 => {
                    if self.contents.val().has_greeting {
                        self.part_number.d.next = 1.into();
                    }
                    if self.contents.val().has_digest {
                        self.part_number.d.next = 2.into();
                    }
                    if self.contents.val().has_answer {
                        self.part_number.d.next = 3.into();
                    }
                }
                3 => {
                    self.part_number.d.next = 4.into();
                }
                4 => {
                    if self.contents.val().ends_answer {
                        self.part_number.d.next = 2.into();
                    }
                }
                5 => {
                    self.state.d.next = SendState::End;
                }
                _ => {
                    self.part_number.d.next = 5.into();
                }
            }
        }
        if (self.state.q.val() == SendState::Idle) & self.starts.val() {
            self.part_number.d.next = 0.into();
            self.place.d.next = 0.into();
            self.was_cut.d.next = false;
            self.state.d.next = SendState::Parts;
        }
        if (self.state.q.val() == SendState::End) & self.ended.val() {
            self.state.d.next = SendState::Idle;
        }
        if self.cuts.val() & self.contents.val().has_answer & (self.state.q.val() != SendState::Idle) {
            self.was_cut.d.next = true;
            self.is_loaded.d.next = false;
            self.asked_once.d.next = false;
            self.asked_twice.d.next = false;
            if self.state.q.val() == SendState::Parts {
                self.state.d.next = SendState::End;
            }
        }
        if self.reset.val() {
            self.state.d.next = SendState::Idle;
            self.is_loaded.d.next = false;
            self.asked_once.d.next = false;
            self.asked_twice.d.next = false;
        }
    }
}
