//! Says whether a command is under way in the core.
//!
//! 1. A word 0 where a command may begin is padding and begins none. Words taken while the last word of an answer is offered belong to the next
//!    command; before that the core takes none.
//!
//! Latency: 1 clock.

use crate::commands::types::Word;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// A command under way; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct CommandUnderWay {
    /// The core's clock; after reset none is.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The core takes this command word.
    pub takes: Signal<In, Bit>,
    pub word: Signal<In, Word>,
    /// It offers the last word of an answer; that is taken.
    pub offers_last: Signal<In, Bit>,
    pub ends: Signal<In, Bit>,
    /// A word of a command has been taken, and the answer to it has not ended.
    pub is_busy: Signal<Out, Bit>,
    busy: DFF<Bit>,
    /// The next command has begun before the answer ended.
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
