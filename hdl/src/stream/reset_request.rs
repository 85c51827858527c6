//! The bus's side of a reset: asks the core's side for it, and waits until that has said that it is over.
//!
//! 1. `reset` or `asks` begins a reset, also within one. `request` is then 1 for at least 32 clocks and until `reply` is 1, so that one which
//!    stands there from before is not taken for the answer; `resets` until `reply` is 0 again.
//! 2. `core_runs` is 1 from a change of `core_beat` until 256 clocks have passed without one.
//!
//! Latency: 1 clock to `request` and `resets`.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What is awaited.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum ResetState {
    /// That the core's side is in reset.
    Begin,
    /// That the core's side is out of reset.
    End,
    /// That a reset is wanted.
    Rest,
}

/// The bus's side of a reset; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct ResetRequest {
    /// The bus's clock and reset.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A reset is wanted.
    pub asks: Signal<In, Bit>,
    /// To the core's clock: reset. A register.
    pub request: Signal<Out, Bit>,
    /// From the core's clock: it is in reset, and has been for some clocks.
    pub reply: Signal<In, Bit>,
    /// From the core's clock: changes every few clocks.
    pub core_beat: Signal<In, Bit>,
    /// The bus's side is in reset. A register.
    pub resets: Signal<Out, Bit>,
    /// `core_beat` changes.
    pub core_runs: Signal<Out, Bit>,
    state: DFF<ResetState>,
    is_requested: DFF<Bit>,
    is_resetting: DFF<Bit>,
    clocks: DFF<Bits<5>>,
    last_beat: DFF<Bit>,
    stillness: DFF<Bits<8>>,
    runs: DFF<Bit>,
    is_long: Signal<Local, Bit>,
    one: Signal<Local, Bits<5>>,
    most: Signal<Local, Bits<5>>,
    one_still: Signal<Local, Bits<8>>,
    most_still: Signal<Local, Bits<8>>,
}

impl ResetRequest {
    /// Clocks that `request` is 1, at least.
    pub const LEAST_CLOCKS: u32 = 32;
    /// Clocks without a change of `core_beat` after which `core_runs` is 0.
    pub const MOST_STILL: u32 = 256;
}

impl Logic for ResetRequest {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, is_requested, is_resetting, clocks, last_beat, stillness, runs);
        self.one.next = 1.into();
        self.most.next = 31.into();
        self.one_still.next = 1.into();
        self.most_still.next = 255.into();
        self.request.next = self.is_requested.q.val();
        self.resets.next = self.is_resetting.q.val();
        self.core_runs.next = self.runs.q.val();
        self.is_long.next = self.clocks.q.val() == self.most.val();
        if (self.state.q.val() == ResetState::Begin) & (!self.is_long.val()) {
            self.clocks.d.next = self.clocks.q.val() + self.one.val();
        }
        if (self.state.q.val() == ResetState::Begin) & self.is_long.val() & self.reply.val() {
            self.state.d.next = ResetState::End;
            self.is_requested.d.next = false;
        }
        if (self.state.q.val() == ResetState::End) & (!self.reply.val()) {
            self.state.d.next = ResetState::Rest;
            self.is_resetting.d.next = false;
        }
        if self.asks.val() | self.reset.val() {
            self.state.d.next = ResetState::Begin;
            self.clocks.d.next = 0.into();
            self.is_requested.d.next = true;
            self.is_resetting.d.next = true;
        }

        self.last_beat.d.next = self.core_beat.val();
        self.stillness.d.next = self.stillness.q.val() + self.one_still.val();
        if self.stillness.q.val() == self.most_still.val() {
            self.stillness.d.next = self.most_still.val();
            self.runs.d.next = false;
        }
        if self.core_beat.val() != self.last_beat.q.val() {
            self.stillness.d.next = 0.into();
            self.runs.d.next = true;
        }
        if self.reset.val() {
            self.stillness.d.next = 0.into();
            self.runs.d.next = false;
        }
    }
}
