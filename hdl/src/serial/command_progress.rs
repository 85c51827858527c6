//! Whether a command is under way: the core has taken a word of one whose answer has not been sent to its end.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | after reset none is |
//! | `takes` | in | 1 | the core takes a command word |
//! | `is_ending` | in | 1 | the last word of an answer is offered or taken, and its frame is not over |
//! | `answer_ended` | in | 1 | it is |
//! | `is_busy` | out | 1 | a command is under way |
//!
//! 1. The core takes the words of the next command as soon as it offers the last word of an answer: a word that comes then belongs to that
//!    one, and keeps `is_busy` high when the answer has ended.
//! 2. `is_ending` may rise up to 2 clocks late.
//!
//! Latency: 4 clocks from a word taken, 1 from the end of an answer.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Commands under way; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct CommandProgress {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// No command is under way.
    pub reset: Signal<In, Bit>,
    /// A command word is taken.
    pub takes: Signal<In, Bit>,
    /// The last word of an answer is under way.
    pub is_ending: Signal<In, Bit>,
    /// The answer has ended.
    pub answer_ended: Signal<In, Bit>,
    /// A command is under way.
    pub is_busy: Signal<Out, Bit>,
    took_first: DFF<Bit>,
    took_second: DFF<Bit>,
    took: DFF<Bit>,
    busy: DFF<Bit>,
    follows: DFF<Bit>,
}

impl Logic for CommandProgress {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, took_first, took_second, took, busy, follows);
        self.is_busy.next = self.busy.q.val();
        self.took_first.d.next = self.takes.val();
        self.took_second.d.next = self.took_first.q.val();
        self.took.d.next = self.took_second.q.val();
        if self.took.q.val() {
            self.busy.d.next = true;
            self.follows.d.next = self.is_ending.val();
        }
        if self.answer_ended.val() {
            self.busy.d.next = self.follows.q.val() | self.took.q.val();
            self.follows.d.next = false;
        }
        if self.reset.val() {
            self.took_first.d.next = false;
            self.took_second.d.next = false;
            self.took.d.next = false;
            self.busy.d.next = false;
            self.follows.d.next = false;
        }
    }
}
