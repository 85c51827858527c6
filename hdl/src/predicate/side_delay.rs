//! Brings the values of the three orient2d of a visit together with their signs, which are known some clocks later.
//!
//! 1. The block takes new values at every edge. There is no reset.
//! 2. Of each value the low 32 bits are kept. They are the value itself if it is not negative.
//!
//! Latency: values that are valid before edge 1 come after the edge given to the constructor as `latency`. Signs pass
//! without latency.

use super::signs::{EdgeFlags, Sides, Weights, WEIGHTS_BITS};
use crate::leaf::{DelayLine, Unpack};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct SideDelay {
    pub clock: Signal<In, Clock>,
    /// The three orient2d, in two's complement, each in `-2^32 .. 2^32`.
    pub e0: Signal<In, Bits<36>>,
    pub e1: Signal<In, Bits<36>>,
    pub e2: Signal<In, Bits<36>>,
    /// Their signs, `latency` edges after them.
    pub flags: Signal<In, EdgeFlags>,
    pub sides: Signal<Out, Sides>,
    line: DelayLine<WEIGHTS_BITS>,
    delayed: Unpack<Weights, WEIGHTS_BITS>,
    low: Signal<Local, Weights>,
    low_bits: Signal<Local, Bits<WEIGHTS_BITS>>,
}

impl SideDelay {
    /// A block whose weights come `latency` edges after the values.
    ///
    /// # Panics
    /// If a delay line cannot have this latency.
    pub fn new(latency: usize) -> Self {
        Self { line: DelayLine::new(latency), ..Self::default() }
    }
}

impl Logic for SideDelay {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, line);
        self.low.next.w0 = bit_cast::<32, 36>(self.e0.val());
        self.low.next.w1 = bit_cast::<32, 36>(self.e1.val());
        self.low.next.w2 = bit_cast::<32, 36>(self.e2.val());
        self.low_bits.next = self.low.val().into();
        self.line.data_in.next = self.low_bits.val();
        self.delayed.bits.next = self.line.data_out.val();
        self.sides.next.flags = self.flags.val();
        self.sides.next.weights = self.delayed.value.val();
    }
}
