//! Whether a command is under way: the core has taken a word of one whose answer has not been sent to its end.
//!
//! 1. The core takes the words of the next command as soon as it offers the last word of an answer, so a word that comes then or later belongs to
//!    that one. At most two answers have been offered to their end and not sent to it.
//! 2. A word of zeros where a command may begin is padding and begins none.
//!
//! Latency: 1 clock from a word taken and from the end of an answer.

use crate::commands::types::Word;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Commands under way; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct CommandProgress {
    /// After reset none is.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The core takes a command word.
    pub takes: Signal<In, Bit>,
    pub word: Signal<In, Word>,
    /// The core offers the last word of an answer; what it offers is taken.
    pub offers_last: Signal<In, Bit>,
    pub takes_answer: Signal<In, Bit>,
    /// The frame of an answer's last word is over.
    pub answer_ended: Signal<In, Bit>,
    /// A command is under way.
    pub is_busy: Signal<Out, Bit>,
    /// A word has been taken since the last answer was offered to its end.
    begun: DFF<Bit>,
    /// Answers offered to their end whose frames are not over.
    open: DFF<Bits<2>>,
    /// The last word that is offered was in the clock before.
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
