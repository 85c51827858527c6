//! Ticks once per bit of the line at any rate: an accumulator of 24 bits keeps the fraction of a clock that
//! a divider would lose.
//!
//! 1. The first value of the phase is a parameter: zero, or half a bit, so that the first tick falls in the
//!    middle of a bit.
//! 2. A tick lasts 1 clock. `n` ticks take `n 2^24 / step` clocks, rounded up, because the remainder
//!    stays in the phase.
//!
//! Latency: 1 clock from the addition that passes the end of the phase to the tick.

use super::types::Step;
use crate::leaf::Parameter;
use crate::prelude::*;
use incircle_protocol::PHASE_BITS;

const _: () = assert!(PHASE_BITS == 24, "the phase of this block has as many bits as the protocol says");

#[derive(LogicBlock, Default)]
pub struct BitClock {
    pub clock: Signal<In, Clock>,
    /// Added to the phase at every clock, so a bit lasts `2^24 / step` clocks.
    pub step: Signal<In, Step>,
    /// Set the phase to its first value at this edge, and drop a tick that is due.
    pub starts: Signal<In, Bit>,
    /// High for one clock after the phase has passed its end.
    pub ticks: Signal<Out, Bit>,
    phase: DFF<Bits<24>>,
    passes: DFF<Bit>,
    wide_phase: Signal<Local, Bits<25>>,
    wide_step: Signal<Local, Bits<25>>,
    sum: Signal<Local, Bits<25>>,
    first: Parameter<Bits<24>>,
}

impl BitClock {
    /// A bit clock that ticks at the end of each bit.
    pub fn at_ends() -> Self {
        Self::from_phase(0)
    }

    /// A bit clock that ticks in the middle of each bit.
    pub fn in_middles() -> Self {
        Self::from_phase(1 << (PHASE_BITS - 1))
    }

    fn from_phase(first: u64) -> Self {
        Self { first: Parameter::new(first.into()), ..Self::default() }
    }
}

impl Logic for BitClock {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, phase, passes);
        self.ticks.next = self.passes.q.val();
        self.wide_phase.next = bit_cast::<25, 24>(self.phase.q.val());
        self.wide_step.next = bit_cast::<25, 22>(self.step.val());
        self.sum.next = self.wide_phase.val() + self.wide_step.val();
        self.phase.d.next = self.sum.val().get_bits::<24>(0);
        self.passes.d.next = self.sum.val().get_bit(24);
        if self.starts.val() {
            self.phase.d.next = self.first.val();
            self.passes.d.next = false;
        }
    }
}
