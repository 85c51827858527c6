//! Counts what passes and what waits on the streams.
//!
//! Latency: 1 clock.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Counters of the streams; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Traffic {
    /// The bus's clock; reset sets all to 0.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// Keep the high half of the clocks.
    pub keeps: Signal<In, Bit>,
    /// Count one.
    pub took_command: Signal<In, Bit>,
    pub command_waited: Signal<In, Bit>,
    pub took_answer: Signal<In, Bit>,
    pub answer_ended: Signal<In, Bit>,
    pub answer_waited: Signal<In, Bit>,
    /// Clocks since reset: the low half as it is, the high half as it was kept.
    pub clocks_low: Signal<Out, Bits<32>>,
    pub clocks_high: Signal<Out, Bits<32>>,
    /// How many there were, modulo 2^32.
    pub command_beats: Signal<Out, Bits<32>>,
    pub command_waits: Signal<Out, Bits<32>>,
    pub answer_beats: Signal<Out, Bits<32>>,
    pub answers: Signal<Out, Bits<32>>,
    pub answer_waits: Signal<Out, Bits<32>>,
    clocks: DFF<Bits<64>>,
    kept: DFF<Bits<32>>,
    commands_taken: DFF<Bits<32>>,
    commands_waited: DFF<Bits<32>>,
    answers_taken: DFF<Bits<32>>,
    answers_ended: DFF<Bits<32>>,
    answers_waited: DFF<Bits<32>>,
    one: Signal<Local, Bits<32>>,
    one_clock: Signal<Local, Bits<64>>,
}

impl Logic for Traffic {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, clocks, kept, commands_taken, commands_waited);
        dff_setup!(self, clock, answers_taken, answers_ended, answers_waited);
        self.one.next = 1.into();
        self.one_clock.next = 1.into();
        self.clocks_low.next = self.clocks.q.val().get_bits::<32>(0);
        self.clocks_high.next = self.kept.q.val();
        self.command_beats.next = self.commands_taken.q.val();
        self.command_waits.next = self.commands_waited.q.val();
        self.answer_beats.next = self.answers_taken.q.val();
        self.answers.next = self.answers_ended.q.val();
        self.answer_waits.next = self.answers_waited.q.val();

        self.clocks.d.next = self.clocks.q.val() + self.one_clock.val();
        if self.keeps.val() {
            self.kept.d.next = self.clocks.q.val().get_bits::<32>(32);
        }
        if self.took_command.val() {
            self.commands_taken.d.next = self.commands_taken.q.val() + self.one.val();
        }
        if self.command_waited.val() {
            self.commands_waited.d.next = self.commands_waited.q.val() + self.one.val();
        }
        if self.took_answer.val() {
            self.answers_taken.d.next = self.answers_taken.q.val() + self.one.val();
        }
        if self.answer_ended.val() {
            self.answers_ended.d.next = self.answers_ended.q.val() + self.one.val();
        }
        if self.answer_waited.val() {
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
    }
}
