//! Whether the three corners of a visit turn left, from their cross product.
//!
//! Latency: that of the delay, and one edge more for the sign.

use crate::leaf::DelayLine;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct ApexSide {
    pub clock: Signal<In, Clock>,
    /// The cross product, in two's complement.
    pub product: Signal<In, Bits<36>>,
    pub is_left: Signal<Out, Bit>,
    sign: DFF<Bits<1>>,
    line: DelayLine<1>,
}

impl ApexSide {
    /// A block whose sign comes `latency` edges after the product.
    ///
    /// # Panics
    /// If a delay line cannot have this latency.
    pub fn new(latency: usize) -> Self {
        Self { line: DelayLine::new(latency - 1), ..Self::default() }
    }
}

impl Logic for ApexSide {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, sign);
        clock!(self, clock, line);
        self.sign.d.next = 0.into();
        if self.product.val().any() & (!self.product.val().get_bit(35)) {
            self.sign.d.next = 1.into();
        }
        self.line.data_in.next = self.sign.q.val();
        self.is_left.next = self.line.data_out.val().any();
    }
}
