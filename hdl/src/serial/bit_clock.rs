//! Ticks once a bit, at any rate: a phase of 24 bits.
//!
//! 1. The first value is a parameter: none, or half a bit, so that the first tick falls into the middle of one.
//! 2. Ticks are 1 clock long, and `n` of them take `n 2^24 / step` clocks, rounded up: the remainder stays in the phase.
//!
//! Latency: the tick shows a clock after the addition that passes the end.

use super::types::Step;
use crate::leaf::Parameter;
use incircle_protocol::PHASE_BITS;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

const _: () = assert!(PHASE_BITS == 24, "the phase of this block has as many bits as the protocol says");

/// Ticks of bits; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct BitClock {
    pub clock: Signal<In, Clock>,
    /// Added to the phase at every clock: a bit takes `2^24 / step` clocks.
    pub step: Signal<In, Step>,
    /// Set the phase to its first value at this edge.
    pub starts: Signal<In, Bit>,
    /// The phase has passed its end.
    pub ticks: Signal<Out, Bit>,
    phase: DFF<Bits<24>>,
    passes: DFF<Bit>,
    wide_phase: Signal<Local, Bits<25>>,
    wide_step: Signal<Local, Bits<25>>,
    sum: Signal<Local, Bits<25>>,
    first: Parameter<Bits<24>>,
}

impl BitClock {
    /// Ticks at the end of bits.
    pub fn at_ends() -> Self {
        Self::from_phase(0)
    }

    /// Ticks in the middle of bits.
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
