//! Counts the beats that pass and that wait on the streams, and offers the counts as registers.
//!
//! 1. A read of the low half of the clocks keeps their high half, and a read of the high half gives the half kept, so
//!    that both fit together.
//!
//! Latency: 1 clock to a count, none (combinational) to `value`.

use super::axi::RegisterIndex;
use super::events::{AnswerEvents, CommandEvents};
use crate::commands::types::Word;
use crate::prelude::*;
use incircle_protocol::StreamRegister;

#[derive(LogicBlock, Default)]
pub struct Traffic {
    /// The bus's clock; a reset sets all counters to 0.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// Events to count; counts are modulo 2^32.
    pub commands: Signal<In, CommandEvents>,
    pub answers: Signal<In, AnswerEvents>,
    /// Number of a register; `reads` says that the host reads it at this edge.
    pub index: Signal<In, RegisterIndex>,
    pub reads: Signal<In, Bit>,
    /// Value of that register, or 0 if it is none of this block; `is_known` says that it is one.
    pub value: Signal<Out, Word>,
    pub is_known: Signal<Out, Bit>,
    clocks: DFF<Bits<64>>,
    kept: DFF<Word>,
    commands_taken: DFF<Word>,
    commands_waited: DFF<Word>,
    answers_taken: DFF<Word>,
    answers_ended: DFF<Word>,
    answers_waited: DFF<Word>,
    one: Signal<Local, Word>,
    one_clock: Signal<Local, Bits<64>>,
    low_clocks: Signal<Local, RegisterIndex>,
}

// The kernel holds the offsets as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    StreamRegister::ClocksLow.offset() == 4 * 32
        && StreamRegister::ClocksHigh.offset() == 4 * 33
        && StreamRegister::CommandBeats.offset() == 4 * 34
        && StreamRegister::AnswerBeats.offset() == 4 * 35
        && StreamRegister::Answers.offset() == 4 * 36
        && StreamRegister::CommandWaits.offset() == 4 * 37
        && StreamRegister::AnswerWaits.offset() == 4 * 38,
    "the offsets of this block follow the protocol"
);

impl Logic for Traffic {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, clocks, kept, commands_taken, commands_waited);
        dff_setup!(self, clock, answers_taken, answers_ended, answers_waited);
        self.one.next = 1.into();
        self.one_clock.next = 1.into();
        self.low_clocks.next = 32.into();
        self.clocks.d.next = self.clocks.q.val() + self.one_clock.val();
        if self.reads.val() & (self.index.val() == self.low_clocks.val()) {
            self.kept.d.next = self.clocks.q.val().get_bits::<32>(32);
        }
        if self.commands.val().took {
            self.commands_taken.d.next = self.commands_taken.q.val() + self.one.val();
        }
        if self.commands.val().waited {
            self.commands_waited.d.next = self.commands_waited.q.val() + self.one.val();
        }
        if self.answers.val().took {
            self.answers_taken.d.next = self.answers_taken.q.val() + self.one.val();
        }
        if self.answers.val().ended {
            self.answers_ended.d.next = self.answers_ended.q.val() + self.one.val();
        }
        if self.answers.val().waited {
            self.answers_waited.d.next = self.answers_waited.q.val() + self.one.val();
        }
        if self.reset.val() {
            self.clocks.d.next = 0.into();
            self.kept.d.next = 0.into();
            self.commands_taken.d.next = 0.into();
            self.commands_waited.d.next = 0.into();
            self.answers_taken.d.next = 0.into();
            self.answers_ended.d.next = 0.into();
            self.answers_waited.d.next = 0.into();
        }

        self.is_known.next = true;
        match self.index.val().index() {
            32 => {
                self.value.next = self.clocks.q.val().get_bits::<32>(0);
            }
            33 => {
                self.value.next = self.kept.q.val();
            }
            34 => {
                self.value.next = self.commands_taken.q.val();
            }
            35 => {
                self.value.next = self.answers_taken.q.val();
            }
            36 => {
                self.value.next = self.answers_ended.q.val();
            }
            37 => {
                self.value.next = self.commands_waited.q.val();
            }
            38 => {
                self.value.next = self.answers_waited.q.val();
            }
            _ => {
                self.value.next = 0.into();
                self.is_known.next = false;
            }
        }
    }
}
