//! Ticks once a bit, at any rate: a phase of 24 bits.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | |
//! | `step` | in | 22 | added to the phase at every clock: a bit takes `2^24 / step` clocks |
//! | `starts` | in | 1 | set the phase to its first value at this edge |
//! | `ticks` | out | 1 | the phase has passed its end |
//!
//! 1. The first value is a parameter: none, or half a bit, so that the first tick falls into the middle of one.
//! 2. Ticks are 1 clock long, and `n` of them take `n 2^24 / step` clocks, rounded up: the remainder stays in the phase.
//!
//! Latency: the tick shows a clock after the addition that passes the end.

use incircle_protocol::PHASE_BITS;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

const _: () = assert!(PHASE_BITS == 24, "the phase of this block has as many bits as the protocol says");

/// Ticks of bits; see the top of this file.
#[derive(LogicBlock)]
pub struct BitClock {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// What a clock adds to the phase.
    pub step: Signal<In, Bits<22>>,
    /// Set the phase to its first value.
    pub starts: Signal<In, Bit>,
    /// A bit is over.
    pub ticks: Signal<Out, Bit>,
    phase: DFF<Bits<24>>,
    passes: DFF<Bit>,
    wide_phase: Signal<Local, Bits<25>>,
    wide_step: Signal<Local, Bits<25>>,
    sum: Signal<Local, Bits<25>>,
    first: Constant<Bits<24>>,
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
        Self {
            clock: Signal::default(),
            step: Signal::default(),
            starts: Signal::default(),
            ticks: Signal::default(),
            phase: DFF::default(),
            passes: DFF::default(),
            wide_phase: Signal::default(),
            wide_step: Signal::default(),
            sum: Signal::default(),
            first: Constant::new(first.into()),
        }
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
