//! Passes on the words of answer beats one by one, because the serial link sends bytes and the core answers up to
//! two words a beat.
//!
//! 1. A beat is taken when no word of the one before is left. `pair_ready` comes from a register, so that the core
//!    does not wait for what happens on the line within a clock.
//!
//! Latency: 1 clock from a beat to its first word.
//!
//! A beat of two words and a beat of one word:
//! ```text
//! pair_valid      /^^^^^^^^^^^^^^\________
//! both            /^^\____________________
//! pair_ready      /^^\________/^^\__/^^^^^
//! word              .  5  5  6  .  7  .  .
//! word_valid      ___/^^^^^^^^\__/^^\_____
//! word_ready      /^^\__/^^^^^^^^^^^^^^^^^
//! ```

use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct WordNarrower {
    pub clock: Signal<In, Clock>,
    /// A reset drops the words that are held.
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
    is_held: DFF<Bit>,
    /// A second word follows the one on offer.
    is_first_of_two: DFF<Bit>,
    first: DFF<Word>,
    second: DFF<Word>,
}

impl Logic for WordNarrower {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_held, is_first_of_two, first, second);
        self.word_valid.next = self.is_held.q.val();
        self.word.next = self.first.q.val();
        self.pair_ready.next = !self.is_held.q.val();
        if self.is_held.q.val() {
            if self.word_ready.val() {
                self.is_held.d.next = self.is_first_of_two.q.val();
                self.is_first_of_two.d.next = false;
                self.first.d.next = self.second.q.val();
            }
        } else {
            self.is_held.d.next = self.pair_valid.val();
            self.is_first_of_two.d.next = self.both.val();
            self.first.d.next = self.pair.val().get_bits::<32>(0);
            self.second.d.next = self.pair.val().get_bits::<32>(32);
        }
        if self.reset.val() {
            self.is_held.d.next = false;
        }
    }
}
