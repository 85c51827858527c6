//! Passes on the words of answer beats one by one, because the serial link sends bytes and the core answers up to
//! two words a beat.
//!
//! 1. A beat is taken together with its last word. Until then the beat, and every word on offer, must stay.
//!
//! Latency: none (combinational) from a beat to its words.
//!
//! A beat of two words and a beat of one word:
//! ```text
//! pair_valid      /^^^^^^^^^^^\__
//! both            /^^^^^^^^\_____
//! pair_ready      ______/^^^^^^^^
//! word              5  6  6  7  .
//! word_ready      /^^\__/^^^^^^^^
//! ```

use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct WordNarrower {
    pub clock: Signal<In, Clock>,
    /// A reset begins with the first word of a beat.
    pub reset: Signal<In, Bit>,
    /// A beat of one or two words, the first word in the low half.
    pub pair_valid: Signal<In, Bit>,
    pub pair_ready: Signal<Out, Bit>,
    pub pair: Signal<In, Bits<64>>,
    /// The beat has two words.
    pub both: Signal<In, Bit>,
    /// The words, one at a time.
    pub word_valid: Signal<Out, Bit>,
    pub word_ready: Signal<In, Bit>,
    pub word: Signal<Out, Word>,
    /// The first word of the beat has been taken.
    is_second: DFF<Bit>,
    is_first_of_two: Signal<Local, Bit>,
}

impl Logic for WordNarrower {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_second);
        self.is_first_of_two.next = self.both.val() & (!self.is_second.q.val());
        self.word_valid.next = self.pair_valid.val();
        self.pair_ready.next = self.word_ready.val() & (!self.is_first_of_two.val());
        self.word.next = self.pair.val().get_bits::<32>(0);
        if self.is_second.q.val() {
            self.word.next = self.pair.val().get_bits::<32>(32);
        }
        if self.pair_valid.val() & self.word_ready.val() {
            self.is_second.d.next = self.is_first_of_two.val();
        }
        if self.reset.val() {
            self.is_second.d.next = false;
        }
    }
}
