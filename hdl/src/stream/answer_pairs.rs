//! Joins the words of answers, which come one or two at a time, to pairs, and begins each answer with a new pair.
//!
//! 1. A pair on offer stays while `is_stalled` is high.
//! 2. An answer with an odd number of words ends with a pair whose bits 63 to 32 are 0.
//! 3. `response_ready` depends on registers and `is_stalled`, not on `response_valid`, and is low for one clock when
//!    the end of an answer fills two pairs at once.
//!
//! Latency: 1 clock from the last word of a pair; 2 for the second of two pairs that are filled at once.
//!
//! An answer of three words, of which two come first, then an answer of five, of which one comes first; `first` and
//! `second` are the halves of a pair:
//! ```text
//! response_valid  ___/^^^^^^^^^^^^^^\______________
//! response_ready  ___/^^^^^^^^^^^^^^\__/^^^^^^^^^^^
//! response_both   ___/^^\_____/^^^^^\______________
//! response_last   ______/^^\_____/^^\______________
//! pair_valid      ______/^^^^^\__/^^^^^^^^\________
//! pair_last       _________/^^\________/^^\________
//! first             .  .  1  3  .  4  6  8  .  .  .
//! second            .  .  2  0  .  5  7  0  .  .  .
//! ```

use crate::commands::types::Word;
use crate::commands::AnswerSink;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct AnswerPairs {
    /// The core's clock; a reset forgets all words.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub response: AnswerSink,
    /// A pair of answer words; `pair_last` marks the last pair of an answer.
    pub pair_valid: Signal<Out, Bit>,
    pub pair_data: Signal<Out, Bits<64>>,
    pub pair_last: Signal<Out, Bit>,
    /// The next block does not take the pair at this edge.
    pub is_stalled: Signal<In, Bit>,
    /// The block holds at least one word.
    pub is_held: Signal<Out, Bit>,
    /// A word that awaits the second word of its pair (`awaits`), or that ends its answer and goes alone (`ends`).
    waiting: DFF<Word>,
    awaits: DFF<Bit>,
    ends: DFF<Bit>,
    first: DFF<Word>,
    second: DFF<Word>,
    is_offered: DFF<Bit>,
    is_last: DFF<Bit>,
    is_free: Signal<Local, Bit>,
    is_ready: Signal<Local, Bit>,
    takes: Signal<Local, Bit>,
    keeps: Signal<Local, Bit>,
    low: Signal<Local, Word>,
    high: Signal<Local, Word>,
    low_half: Signal<Local, Bits<64>>,
    wide_second: Signal<Local, Bits<64>>,
    high_half: Signal<Local, Bits<64>>,
    word_bits: Signal<Local, Bits<64>>,
}

impl Logic for AnswerPairs {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, waiting, awaits, ends, first, second, is_offered, is_last);
        self.word_bits.next = 32.into();
        self.low_half.next = bit_cast::<64, 32>(self.first.q.val());
        self.wide_second.next = bit_cast::<64, 32>(self.second.q.val());
        self.high_half.next = self.wide_second.val() << self.word_bits.val();
        self.pair_data.next = self.low_half.val() | self.high_half.val();
        self.pair_valid.next = self.is_offered.q.val();
        self.pair_last.next = self.is_last.q.val();
        self.is_held.next = self.is_offered.q.val() | self.awaits.q.val() | self.ends.q.val();
        self.is_free.next = !(self.is_offered.q.val() & self.is_stalled.val());
        self.is_ready.next = self.is_free.val() & (!self.ends.q.val());
        self.response.ready.next = self.is_ready.val();
        self.takes.next = self.response.valid.val() & self.is_ready.val();
        self.low.next = self.response.data.val().get_bits::<32>(0);
        self.high.next = 0.into();
        if self.response.both.val() {
            self.high.next = self.response.data.val().get_bits::<32>(32);
        }
        // A single word waits for a second one. So does the second of two words, if the first completes a pair with
        // a word that waited.
        self.keeps.next = (self.awaits.q.val() & self.response.both.val())
            | ((!self.awaits.q.val()) & (!self.response.both.val()) & (!self.response.last.val()));

        if self.is_free.val() {
            self.is_offered.d.next = false;
            self.first.d.next = self.low.val();
            self.second.d.next = self.high.val();
            if self.awaits.q.val() {
                self.first.d.next = self.waiting.q.val();
                self.second.d.next = self.low.val();
            }
        }
        if self.takes.val() {
            self.is_offered.d.next = self.awaits.q.val() | self.response.both.val() | self.response.last.val();
            self.is_last.d.next = self.response.last.val() & (!self.keeps.val());
            self.waiting.d.next = self.low.val();
            if self.response.both.val() {
                self.waiting.d.next = self.high.val();
            }
            self.awaits.d.next = self.keeps.val() & (!self.response.last.val());
            self.ends.d.next = self.keeps.val() & self.response.last.val();
        }
        if self.ends.q.val() & self.is_free.val() {
            self.is_offered.d.next = true;
            self.is_last.d.next = true;
            self.first.d.next = self.waiting.q.val();
            self.second.d.next = 0.into();
            self.ends.d.next = false;
        }
        if self.reset.val() {
            self.awaits.d.next = false;
            self.ends.d.next = false;
            self.is_offered.d.next = false;
        }
    }
}
