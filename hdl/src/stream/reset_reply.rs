//! The core's side of a reset: holds the core in reset while the bus wants a reset, and replies after eight clocks.
//!
//! 1. `resets` is 1 from the clock after `request` until both `request` and `reply` are 0 again.
//! 2. The block has no reset of its own: it comes to rest by itself.
//!
//! Latency: 1 clock to `resets`, 8 to `reply`.

use crate::leaf::FlagDelay;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct ResetReply {
    /// The clock of the core.
    pub clock: Signal<In, Clock>,
    /// The bus wants a reset; comes from the bus's clock.
    pub request: Signal<In, Bit>,
    /// The core's side is in reset; a register.
    pub resets: Signal<Out, Bit>,
    /// `request` has been 1 for eight clocks; a register, for the bus's clock.
    pub reply: Signal<Out, Bit>,
    /// Toggles every eight clocks; a register, for the bus's clock.
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

impl ResetReply {
    /// The block, with a reply that comes [`LATENCY`](Self::LATENCY) clocks after the request.
    pub fn new() -> Self {
        Self { delay: FlagDelay::new(Self::LATENCY), ..Self::default() }
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
