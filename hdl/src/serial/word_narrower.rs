//! Gives the words of answer beats one by one.
//!
//! 1. A beat is taken with its last word; until then it stands, as all that is offered.
//!
//! Latency: none.
//!
//! A beat of two words and one of one:
//! ```text
//! pair_valid      /^^^^^^^^^^^\__
//! both            /^^^^^^^^\_____
//! pair_ready      ______/^^^^^^^^
//! word              5  6  6  7  .
//! word_ready      /^^\__/^^^^^^^^
//! ```

use crate::commands::types::Word;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Words of beats; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct WordNarrower {
    pub clock: Signal<In, Clock>,
    /// Reset begins a beat anew.
    pub reset: Signal<In, Bit>,
    /// A beat of one word or two, the first in the low half.
    pub pair_valid: Signal<In, Bit>,
    pub pair_ready: Signal<Out, Bit>,
    pub pair: Signal<In, Bits<64>>,
    /// The beat has two words.
    pub both: Signal<In, Bit>,
    /// The words.
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
