//! Tells whether a command is under way, for the status of a frame: from its first word that the core takes until its
//! answer has been sent.
//!
//! 1. The core may take words of the next command as soon as it offers the last word of an answer, so a word that it
//!    takes in that clock or later belongs to the next command. At most three answers are not sent to their end yet:
//!    one in the frames, one that waits as a single beat, and one that the core offers.
//! 2. A word of zeros where a command may begin is padding and begins no command.
//!
//! Latency: 1 clock from a word taken and from the end of an answer.

use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct CommandProgress {
    /// After a reset no command is under way.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The core takes `word`, a word of a command, at this edge.
    pub takes: Signal<In, Bit>,
    pub word: Signal<In, Word>,
    /// The core offers the last word of an answer; `takes_answer` says that the link takes what the core offers.
    pub offers_last: Signal<In, Bit>,
    pub takes_answer: Signal<In, Bit>,
    /// The frame with the last word of an answer has ended.
    pub answer_ended: Signal<In, Bit>,
    /// A command is under way.
    pub is_busy: Signal<Out, Bit>,
    /// The core has taken a word since it offered the last answer to its end.
    begun: DFF<Bit>,
    /// Answers that the core has offered to their end and whose frames have not ended.
    open: DFF<Bits<2>>,
    /// The core offered the same last word one clock earlier.
    seen: DFF<Bit>,
    is_new: Signal<Local, Bit>,
    goes_on: Signal<Local, Bit>,
    is_padding: Signal<Local, Bit>,
    one: Signal<Local, Bits<2>>,
}

impl Logic for CommandProgress {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, begun, open, seen);
        self.one.next = 1.into();
        self.is_busy.next = self.begun.q.val() | self.open.q.val().any();
        self.is_new.next = self.offers_last.val() & (!self.seen.q.val());
        self.seen.d.next = self.offers_last.val() & (!self.takes_answer.val());
        self.goes_on.next = self.begun.q.val() & (!self.is_new.val());
        self.is_padding.next = (!self.goes_on.val()) & (!self.word.val().any());
        self.begun.d.next = self.goes_on.val() | (self.takes.val() & (!self.is_padding.val()));
        if self.is_new.val() & (!self.answer_ended.val()) {
            self.open.d.next = self.open.q.val() + self.one.val();
        }
        if self.answer_ended.val() & (!self.is_new.val()) {
            self.open.d.next = self.open.q.val() - self.one.val();
        }
        if self.reset.val() {
            self.begun.d.next = false;
            self.open.d.next = 0.into();
            self.seen.d.next = false;
        }
    }
}
