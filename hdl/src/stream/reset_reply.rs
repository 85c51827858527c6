//! The core's side of a reset: holds the core in it, and says so.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | the core's clock |
//! | `request` | in | 1 | from the bus's clock: reset |
//! | `resets` | out | 1 | the core's side is in reset. A register |
//! | `reply` | out | 1 | to the bus's clock: `request` has been 1 for eight clocks. A register |
//! | `beat` | out | 1 | to the bus's clock: changes every eight clocks. A register |
//!
//! 1. `resets` is 1 from the clock after `request` until both `request` and `reply` are 0 again.
//! 2. This block has no reset: it comes to rest by itself.
//!
//! Latency: 1 clock to `resets`, 8 to `reply`.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

use crate::leaf::FlagDelay;

/// The core's side of a reset; see the top of this file.
#[derive(LogicBlock)]
pub struct ResetReply {
    /// Clock of the core.
    pub clock: Signal<In, Clock>,
    /// Reset.
    pub request: Signal<In, Bit>,
    /// The core's side is in reset.
    pub resets: Signal<Out, Bit>,
    /// It has been for eight clocks.
    pub reply: Signal<Out, Bit>,
    /// Changes every eight clocks.
    pub beat: Signal<Out, Bit>,
    delay: FlagDelay,
    is_resetting: DFF<Bit>,
    clocks: DFF<Bits<3>>,
    alternates: DFF<Bit>,
    one: Signal<Local, Bits<3>>,
}

impl ResetReply {
    /// Clocks from `request` to `reply`.
    pub const LATENCY: usize = 8;
}

impl Default for ResetReply {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            request: Signal::default(),
            resets: Signal::default(),
            reply: Signal::default(),
            beat: Signal::default(),
            delay: FlagDelay::new(Self::LATENCY),
            is_resetting: DFF::default(),
            clocks: DFF::default(),
            alternates: DFF::default(),
            one: Signal::default(),
        }
    }
}

impl Logic for ResetReply {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_resetting, clocks, alternates);
        clock!(self, clock, delay);
        self.one.next = 1.into();
        self.delay.flag_in.next = self.request.val();
        self.reply.next = self.delay.flag_out.val();
        self.is_resetting.d.next = self.request.val() | self.delay.flag_out.val();
        self.resets.next = self.is_resetting.q.val();
        self.clocks.d.next = self.clocks.q.val() + self.one.val();
        if !self.clocks.q.val().any() {
            self.alternates.d.next = !self.alternates.q.val();
        }
        self.beat.next = self.alternates.q.val();
    }
}
