//! Goes through the bytes of a datagram to the host, part by part.
//!
//! 1. `starts` may be high only while `is_idle` is high. The receiver of the bytes takes one in every clock until the
//!    end of the datagram.
//! 2. A byte passes in every clock of `moves`. In the words of an answer the block waits for the core.
//! 3. The parts come in the order of the page `protocol/UDP.md`: receiver and header, then a greeting, or the number of
//!    answers with a digest or with words behind it, then the check sum. The index goes on from part to part.
//! 4. `cuts` ends the datagram under way at once, with `is_cut`: no byte of it may go out.
//!
//! Latency: 1 clock from `starts` to the first byte.
//!
//! The end of an answer: two bytes of its number of the first word, four bytes of words, for which it waits, its digest
//! and the check sum:
//! ```text
//! word_byte_valid   ______/^^^^^\_____/^^^^^\_____________________________
//! word_byte_is_last _____________________/^^\_____________________________
//! at.part             6  6  4  4  .  .  4  4  7  7  7  7  5  5  5  5  .  .
//! at.index           34 35 36 37  .  . 38 39 40 41 42 43 44 45 46 47  .  .
//! moves             /^^^^^^^^^^^\_____/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\_____
//! is_last           _____________________________________________/^^\_____
//! is_idle           ________________________________________________/^^^^^
//! ```

use super::types::PartIndex;
use crate::prelude::*;
use crate::serial::types::Contents;
use incircle_protocol::{DATAGRAM_HEADER_BYTES, UDP_GREETING_WORDS};

#[derive(LogicBlock, Default)]
pub struct DatagramParts {
    pub clock: Signal<In, Clock>,
    /// A reset drops the datagram under way.
    pub reset: Signal<In, Bit>,
    /// A datagram begins at this edge.
    pub starts: Signal<In, Bit>,
    /// The parts of the datagram under way, from [`FrameChoice`](crate::serial::FrameChoice).
    pub contents: Signal<In, Contents>,
    pub cuts: Signal<In, Bit>,
    /// A byte of the words is there; `word_byte_is_last` says that it is the last one of the words in this datagram.
    pub word_byte_valid: Signal<In, Bit>,
    pub word_byte_is_last: Signal<In, Bit>,
    /// Place of the byte that passes in this clock, if `moves` is high; with `is_last` the datagram ends.
    pub at: Signal<Out, PartIndex>,
    pub moves: Signal<Out, Bit>,
    pub is_last: Signal<Out, Bit>,
    pub is_cut: Signal<Out, Bit>,
    /// No datagram is under way.
    pub is_idle: Signal<Out, Bit>,
    runs: DFF<Bit>,
    part: DFF<Bits<3>>,
    index: DFF<Bits<7>>,
    is_words: Signal<Local, Bit>,
    passes: Signal<Local, Bit>,
    low_index: Signal<Local, Bits<2>>,
    last_byte: Signal<Local, Bits<2>>,
    ends_word: Signal<Local, Bit>,
    ends_part: Signal<Local, Bit>,
    one: Signal<Local, Bits<7>>,
    words_part: Signal<Local, Bits<3>>,
    last_of_head: Signal<Local, Bits<7>>,
    last_of_greeting: Signal<Local, Bits<7>>,
}

// The kernel holds the lengths as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    12 + DATAGRAM_HEADER_BYTES == 28 && 28 + 4 * UDP_GREETING_WORDS == 84,
    "the parts of this block follow the protocol"
);

impl Logic for DatagramParts {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, runs, part, index);
        self.one.next = 1.into();
        self.words_part.next = 4.into();
        self.last_byte.next = 3.into();
        self.last_of_head.next = 27.into();
        self.last_of_greeting.next = 83.into();
        self.at.next.part = self.part.q.val();
        self.at.next.index = self.index.q.val();
        self.is_idle.next = !self.runs.q.val();

        self.is_words.next = self.part.q.val() == self.words_part.val();
        self.passes.next = self.runs.q.val() & ((!self.is_words.val()) | self.word_byte_valid.val());
        self.moves.next = self.passes.val();
        self.low_index.next = self.index.q.val().get_bits::<2>(0);
        self.ends_word.next = self.low_index.val() == self.last_byte.val();
        self.is_last.next = false;
        self.is_cut.next = false;
        self.ends_part.next = self.ends_word.val();
        match self.part.q.val().index() {
            0 => {
                self.ends_part.next = self.index.q.val() == self.last_of_head.val();
            }
            1 => {
                self.ends_part.next = self.index.q.val() == self.last_of_greeting.val();
            }
            4 => {
                self.ends_part.next = self.word_byte_is_last.val();
            }
            5 => {
                self.is_last.next = self.passes.val() & self.ends_word.val();
            }
            _ => {}
        }
        if self.passes.val() {
            self.index.d.next = self.index.q.val() + self.one.val();
            if self.ends_part.val() {
                // Every part that is not followed by the check sum names its successor below.
                self.part.d.next = 5.into();
                match self.part.q.val().index() {
                    0 => {
                        if self.contents.val().has_greeting {
                            self.part.d.next = 1.into();
                        }
                        if self.contents.val().has_digest | self.contents.val().has_answer {
                            self.part.d.next = 3.into();
                        }
                    }
                    3 => {
                        self.part.d.next = 6.into();
                        if self.contents.val().has_digest {
                            self.part.d.next = 2.into();
                        }
                    }
                    4 => {
                        if self.contents.val().ends_answer {
                            self.part.d.next = 7.into();
                        }
                    }
                    5 => {
                        self.runs.d.next = false;
                    }
                    6 => {
                        self.part.d.next = 4.into();
                    }
                    _ => {
                        self.part.d.next = 5.into();
                    }
                }
            }
        }
        if self.starts.val() {
            self.runs.d.next = true;
            self.part.d.next = 0.into();
            self.index.d.next = 0.into();
        }
        if self.runs.q.val() & self.cuts.val() {
            self.runs.d.next = false;
            self.is_cut.next = true;
            self.is_last.next = false;
        }
        if self.reset.val() {
            self.runs.d.next = false;
        }
    }
}
