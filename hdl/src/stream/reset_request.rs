//! The bus's side of a reset: asks the core's side for a reset, and waits until that side has been in reset
//! and has left it.
//!
//! 1. `reset` or `asks` begins a reset, also while one is under way. `request` is then 1 for at least 32 clocks and
//!    until `reply` is 1. The 32 clocks keep a `reply` that is left from an earlier reset from being taken for the
//!    answer. `resets` is 1 until `reply` is 0 again.
//! 2. `core_runs` is 1 from a change of `core_beat` until 256 clocks have passed without one.
//!
//! Latency: 1 clock to `request` and `resets`.

use crate::prelude::*;

/// The event that the block awaits.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum ResetState {
    /// The core's side enters its reset.
    Begin,
    /// The core's side leaves its reset.
    End,
    /// The host wants a reset.
    Rest,
}

#[derive(LogicBlock, Default)]
pub struct ResetRequest {
    /// The bus's clock and its reset, which begins a reset of the core too.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The host wants a reset.
    pub asks: Signal<In, Bit>,
    /// A reset is wanted; a register, for the core's clock.
    pub request: Signal<Out, Bit>,
    /// The core's side has been in reset for some clocks; comes from the core's clock.
    pub reply: Signal<In, Bit>,
    /// Toggles every few clocks of the core while the core's clock runs.
    pub core_beat: Signal<In, Bit>,
    /// The bus's side is in reset; a register.
    pub resets: Signal<Out, Bit>,
    /// The core's clock runs.
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
    /// Least number of clocks for which `request` is 1.
    pub const LEAST_CLOCKS: u32 = 32;
    /// Clocks without a change of `core_beat` after which `core_runs` is 0.
    pub const MOST_STILL: u32 = 256;
}

const _: () = assert!(
    ResetRequest::LEAST_CLOCKS == 31 + 1 && ResetRequest::MOST_STILL == 255 + 1,
    "the kernel has these as literals"
);

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
