//! Sends a frame to the host: asks for its bytes in order.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset sends nothing |
//! | `starts` | in | 1 | a frame begins at this edge |
//! | `has_greeting`, `has_digest`, `has_answer`, `ends_answer` | in | 1 | what the frame under way has, from `FrameChoice` |
//! | `cuts` | in | 1 | an answer is over: its frame is to end, invalid |
//! | `part`, `index` | out | 3, 6 | part of the frame (0 header, 1 greeting, 2 digest, 3 head of an answer, 4 words, 5 check sum), and byte of that |
//! | `byte_data`, `sum_is_busy` | in | 8, 1 | that byte, 2 clocks later; the check sum has not taken the byte before |
//! | `word_byte_valid`, `word_byte_is_last` | in | 1 | the next byte of the words is there; it is the last one of the frame |
//! | `loads`, `loads_word` | out | 1 | a byte that the check sum covers is loaded; it is one of the words |
//! | `data_valid`, `data_ready`, `data` | out, in, out | 1, 1, 8 | bytes of the frame |
//! | `ends`, `is_cut`, `ended` | out, out, in | 1 | no byte follows; the frame is to be invalid; it is over |
//! | `answer_ended` | out | 1 | it was the last of an answer, and whole |
//! | `is_idle` | out | 1 | no frame is under way |
//!
//! 1. `starts` only while `is_idle`.
//! 2. A byte once offered stays until it is taken, unless the frame is cut.
//!
//! Latency: 4 clocks from `starts` to the first byte; 4 from a byte taken to the next, and not before the check sum has taken it.

use incircle_protocol::{ANSWER_HEADER_BYTES, CRC_BYTES, DEVICE_HEADER_BYTES, GREETING_WORDS};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Which byte comes next.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum SendState {
    /// None: a frame is awaited.
    Idle,
    /// One of the header.
    Header,
    /// One of the greeting.
    Greeting,
    /// One of the digest.
    Digest,
    /// One of the three before the words of an answer.
    AnswerHead,
    /// One of the words of an answer.
    Words,
    /// One of the check sum.
    Sum,
    /// None: the end of the frame is awaited.
    End,
}

/// Frames to the host; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct FrameSender {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Sends nothing.
    pub reset: Signal<In, Bit>,
    /// A frame begins.
    pub starts: Signal<In, Bit>,
    /// It has a greeting.
    pub has_greeting: Signal<In, Bit>,
    /// It has a digest behind its header.
    pub has_digest: Signal<In, Bit>,
    /// It has words of an answer.
    pub has_answer: Signal<In, Bit>,
    /// It has the last ones, and a digest behind them.
    pub ends_answer: Signal<In, Bit>,
    /// An answer is over.
    pub cuts: Signal<In, Bit>,
    /// Part of the frame.
    pub part: Signal<Out, Bits<3>>,
    /// Byte of the part.
    pub index: Signal<Out, Bits<6>>,
    /// That byte.
    pub byte_data: Signal<In, Bits<8>>,
    /// The check sum has not taken the byte before.
    pub sum_is_busy: Signal<In, Bit>,
    /// A byte of the words is there.
    pub word_byte_valid: Signal<In, Bit>,
    /// It is the last one.
    pub word_byte_is_last: Signal<In, Bit>,
    /// A byte under the check sum is loaded.
    pub loads: Signal<Out, Bit>,
    /// It is one of the words.
    pub loads_word: Signal<Out, Bit>,
    /// A byte is offered.
    pub data_valid: Signal<Out, Bit>,
    /// It is taken.
    pub data_ready: Signal<In, Bit>,
    /// The byte.
    pub data: Signal<Out, Bits<8>>,
    /// No byte follows.
    pub ends: Signal<Out, Bit>,
    /// The frame is to be invalid.
    pub is_cut: Signal<Out, Bit>,
    /// The frame is over.
    pub ended: Signal<In, Bit>,
    /// The last frame of an answer is over.
    pub answer_ended: Signal<Out, Bit>,
    /// No frame is under way.
    pub is_idle: Signal<Out, Bit>,
    state: DFF<SendState>,
    place: DFF<Bits<6>>,
    /// Clocks for which the byte has been asked for, up to 2.
    asked_once: DFF<Bit>,
    asked_twice: DFF<Bit>,
    is_loaded: DFF<Bit>,
    loaded: DFF<Bits<8>>,
    was_cut: DFF<Bit>,
    has_byte: Signal<Local, Bit>,
    takes: Signal<Local, Bit>,
    last_place: Signal<Local, Bits<6>>,
    is_last: Signal<Local, Bit>,
    finishes: Signal<Local, Bit>,
    one: Signal<Local, Bits<6>>,
}

// The kernel writes these as literals, because rust-hdl takes no constants of Rust; a change in the protocol must come here.
const _: () = assert!(
    DEVICE_HEADER_BYTES == 7 && GREETING_WORDS == 13 && ANSWER_HEADER_BYTES == 3 && CRC_BYTES == 4,
    "the frames of this block follow the protocol"
);

impl Logic for FrameSender {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, place, asked_once, asked_twice, is_loaded, loaded, was_cut);
        self.one.next = 1.into();
        self.index.next = self.place.q.val();
        self.data_valid.next = self.is_loaded.q.val();
        self.data.next = self.loaded.q.val();
        self.is_cut.next = self.was_cut.q.val();
        self.is_idle.next = self.state.q.val() == SendState::Idle;
        self.ends.next = (self.state.q.val() == SendState::End) & (!self.is_loaded.q.val());
        self.answer_ended.next =
            self.ended.val() & self.ends_answer.val() & (!self.was_cut.q.val()) & (!self.cuts.val());

        // The part, and its last byte.
        self.part.next = 0.into();
        self.last_place.next = 3.into();
        self.has_byte.next = true;
        match self.state.q.val() {
            SendState::Header => {
                self.last_place.next = 6.into();
            }
            SendState::Greeting => {
                self.part.next = 1.into();
                self.last_place.next = 51.into();
            }
            SendState::Digest => {
                self.part.next = 2.into();
            }
            SendState::AnswerHead => {
                self.part.next = 3.into();
                self.last_place.next = 2.into();
            }
            SendState::Words => {
                self.part.next = 4.into();
                self.has_byte.next = self.word_byte_valid.val();
            }
            SendState::Sum => {
                self.part.next = 5.into();
            }
            _ => {
                self.has_byte.next = false;
            }
        }
        self.is_last.next = self.place.q.val() == self.last_place.val();
        if self.state.q.val() == SendState::Words {
            self.is_last.next = self.word_byte_is_last.val();
        }
        // A byte is asked for through two ranks of registers, while none is loaded and the check sum rests.
        self.asked_once.d.next = self.has_byte.val() & (!self.is_loaded.q.val()) & (!self.sum_is_busy.val());
        self.asked_twice.d.next = self.asked_once.q.val();
        self.takes.next = self.asked_twice.q.val() & self.has_byte.val();
        self.loads.next = self.takes.val() & (self.state.q.val() != SendState::Sum);
        self.loads_word.next = self.takes.val() & (self.state.q.val() == SendState::Words);
        if self.data_ready.val() {
            self.is_loaded.d.next = false;
        }
        if self.takes.val() {
            self.asked_once.d.next = false;
            self.asked_twice.d.next = false;
            self.is_loaded.d.next = true;
            self.loaded.d.next = self.byte_data.val();
            self.place.d.next = self.place.q.val() + self.one.val();
            if self.is_last.val() {
                self.place.d.next = 0.into();
            }
        }
        self.finishes.next = self.takes.val() & self.is_last.val();
        match self.state.q.val() {
            SendState::Idle => {
                self.place.d.next = 0.into();
                self.was_cut.d.next = false;
                if self.starts.val() {
                    self.state.d.next = SendState::Header;
                }
            }
            SendState::Header => {
                if self.finishes.val() {
                    self.state.d.next = SendState::Sum;
                    if self.has_greeting.val() {
                        self.state.d.next = SendState::Greeting;
                    }
                    if self.has_digest.val() {
                        self.state.d.next = SendState::Digest;
                    }
                    if self.has_answer.val() {
                        self.state.d.next = SendState::AnswerHead;
                    }
                }
            }
            SendState::AnswerHead => {
                if self.finishes.val() {
                    self.state.d.next = SendState::Words;
                }
            }
            SendState::Words => {
                if self.finishes.val() {
                    self.state.d.next = SendState::Sum;
                    if self.ends_answer.val() {
                        self.state.d.next = SendState::Digest;
                    }
                }
            }
            SendState::Sum => {
                if self.finishes.val() {
                    self.state.d.next = SendState::End;
                }
            }
            SendState::End => {
                if self.ended.val() {
                    self.state.d.next = SendState::Idle;
                }
            }
            _ => {
                // The greeting and the digest.
                if self.finishes.val() {
                    self.state.d.next = SendState::Sum;
                }
            }
        }
        if self.cuts.val() & self.has_answer.val() & (self.state.q.val() != SendState::Idle) {
            self.was_cut.d.next = true;
            self.is_loaded.d.next = false;
            if self.state.q.val() != SendState::End {
                self.state.d.next = SendState::End;
            }
        }
        if self.reset.val() {
            self.state.d.next = SendState::Idle;
            self.is_loaded.d.next = false;
        }
    }
}
