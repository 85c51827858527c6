//! Tells whether a command is under way in the core, for the status register.
//!
//! 1. A word of zeros where a command may begin is padding and begins no command. While the core offers the last word
//!    of an answer, the words that it takes belong to the next command; before that the core takes none.
//!
//! Latency: 1 clock from a word to `is_busy`.

use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct CommandUnderWay {
    /// The core's clock; after a reset no command is under way.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The core takes `word`, a word of a command, at this edge.
    pub takes: Signal<In, Bit>,
    pub word: Signal<In, Word>,
    /// The core offers the last word of an answer; `ends` says that the word is taken at this edge.
    pub offers_last: Signal<In, Bit>,
    pub ends: Signal<In, Bit>,
    /// The core has taken a word of a command, and its answer has not ended.
    pub is_busy: Signal<Out, Bit>,
    busy: DFF<Bit>,
    /// The next command began before the answer of this one ended.
    follows: DFF<Bit>,
    begins: Signal<Local, Bit>,
}

impl Logic for CommandUnderWay {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, busy, follows);
        self.is_busy.next = self.busy.q.val();
        self.begins.next = self.takes.val() & self.word.val().any();
        if self.begins.val() {
            self.busy.d.next = true;
        }
        if self.begins.val() & self.offers_last.val() {
            self.follows.d.next = true;
        }
        if self.ends.val() {
            self.busy.d.next = self.follows.q.val() | self.begins.val();
            self.follows.d.next = false;
        }
        if self.reset.val() {
            self.busy.d.next = false;
            self.follows.d.next = false;
        }
    }
}
