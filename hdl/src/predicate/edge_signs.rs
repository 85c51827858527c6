//! The signs and the signed order of the three orient2d of a visit, by which a walk chooses the edge to cross.
//!
//! 1. The block takes new values at every edge. There is no reset.
//! 2. Bits 33 to 35 of an input repeat its sign and are ignored.
//!
//! Latency: values that are valid before edge 1, straight from registers, give their flags after the edge given to the
//! constructor as `latency`. Edge 1 registers the signs and compares the bits below them, edge 2 combines the two: in
//! one step they would limit the clock.
//!
//! Source: the rules of the walk. Of two numbers with equal signs the lower bits decide, in two's
//! complement also below zero.

use super::signs::EdgeFlags;
use crate::leaf::{FlagDelay, Parameter};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct EdgeSigns {
    pub clock: Signal<In, Clock>,
    /// The three orient2d, in two's complement, each in `-2^32 .. 2^32`.
    pub e0: Signal<In, Bits<36>>,
    pub e1: Signal<In, Bits<36>>,
    pub e2: Signal<In, Bits<36>>,
    pub flags: Signal<Out, EdgeFlags>,
    value_0: Signal<Local, Bits<33>>,
    value_1: Signal<Local, Bits<33>>,
    value_2: Signal<Local, Bits<33>>,
    low_0: Signal<Local, Bits<32>>,
    low_1: Signal<Local, Bits<32>>,
    low_2: Signal<Local, Bits<32>>,
    negative_0: DFF<Bit>,
    negative_1: DFF<Bit>,
    negative_2: DFF<Bit>,
    zero_0: DFF<Bit>,
    zero_1: DFF<Bit>,
    zero_2: DFF<Bit>,
    low_1_below_0: DFF<Bit>,
    low_2_below_0: DFF<Bit>,
    low_2_below_1: DFF<Bit>,
    delay_negative_0: FlagDelay,
    delay_negative_1: FlagDelay,
    delay_negative_2: FlagDelay,
    delay_zero_0: FlagDelay,
    delay_zero_1: FlagDelay,
    delay_zero_2: FlagDelay,
    delay_1_below_0: FlagDelay,
    delay_2_below_0: FlagDelay,
    delay_2_below_1: FlagDelay,
    zero: Parameter<Bits<33>>,
}

impl EdgeSigns {
    /// A block whose flags come `latency` edges after the values.
    ///
    /// # Panics
    /// If `latency` is below 2.
    pub fn new(latency: usize) -> Self {
        assert!(latency >= 2, "the signs of edges take at least 2 clocks, not {latency}");
        let delay = || FlagDelay::new(latency - 1);
        Self {
            delay_negative_0: delay(),
            delay_negative_1: delay(),
            delay_negative_2: delay(),
            delay_zero_0: delay(),
            delay_zero_1: delay(),
            delay_zero_2: delay(),
            delay_1_below_0: delay(),
            delay_2_below_0: delay(),
            delay_2_below_1: delay(),
            zero: Parameter::new(Bits::default()),
            ..Self::default()
        }
    }
}

impl Logic for EdgeSigns {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, negative_0, negative_1, negative_2, zero_0, zero_1, zero_2);
        clock!(self, clock, low_1_below_0, low_2_below_0, low_2_below_1);
        clock!(self, clock, delay_negative_0, delay_negative_1, delay_negative_2);
        clock!(self, clock, delay_zero_0, delay_zero_1, delay_zero_2);
        clock!(self, clock, delay_1_below_0, delay_2_below_0, delay_2_below_1);
        // Edge 1: the bits below the signs are compared at once, before anybody knows whether the signs are equal.
        self.value_0.next = bit_cast::<33, 36>(self.e0.val());
        self.value_1.next = bit_cast::<33, 36>(self.e1.val());
        self.value_2.next = bit_cast::<33, 36>(self.e2.val());
        self.negative_0.d.next = self.value_0.val().get_bit(32);
        self.negative_1.d.next = self.value_1.val().get_bit(32);
        self.negative_2.d.next = self.value_2.val().get_bit(32);
        self.zero_0.d.next = self.value_0.val() == self.zero.val();
        self.zero_1.d.next = self.value_1.val() == self.zero.val();
        self.zero_2.d.next = self.value_2.val() == self.zero.val();
        self.low_0.next = bit_cast::<32, 33>(self.value_0.val());
        self.low_1.next = bit_cast::<32, 33>(self.value_1.val());
        self.low_2.next = bit_cast::<32, 33>(self.value_2.val());
        self.low_1_below_0.d.next = self.low_1.val() < self.low_0.val();
        self.low_2_below_0.d.next = self.low_2.val() < self.low_0.val();
        self.low_2_below_1.d.next = self.low_2.val() < self.low_1.val();

        // Edge 2: if the signs differ, the negative value is below; otherwise the low bits have decided.
        self.delay_negative_0.flag_in.next = self.negative_0.q.val();
        self.delay_negative_1.flag_in.next = self.negative_1.q.val();
        self.delay_negative_2.flag_in.next = self.negative_2.q.val();
        self.delay_zero_0.flag_in.next = self.zero_0.q.val();
        self.delay_zero_1.flag_in.next = self.zero_1.q.val();
        self.delay_zero_2.flag_in.next = self.zero_2.q.val();
        if self.negative_1.q.val() ^ self.negative_0.q.val() {
            self.delay_1_below_0.flag_in.next = self.negative_1.q.val();
        } else {
            self.delay_1_below_0.flag_in.next = self.low_1_below_0.q.val();
        }
        if self.negative_2.q.val() ^ self.negative_0.q.val() {
            self.delay_2_below_0.flag_in.next = self.negative_2.q.val();
        } else {
            self.delay_2_below_0.flag_in.next = self.low_2_below_0.q.val();
        }
        if self.negative_2.q.val() ^ self.negative_1.q.val() {
            self.delay_2_below_1.flag_in.next = self.negative_2.q.val();
        } else {
            self.delay_2_below_1.flag_in.next = self.low_2_below_1.q.val();
        }

        self.flags.next.e0_negative = self.delay_negative_0.flag_out.val();
        self.flags.next.e1_negative = self.delay_negative_1.flag_out.val();
        self.flags.next.e2_negative = self.delay_negative_2.flag_out.val();
        self.flags.next.e0_zero = self.delay_zero_0.flag_out.val();
        self.flags.next.e1_zero = self.delay_zero_1.flag_out.val();
        self.flags.next.e2_zero = self.delay_zero_2.flag_out.val();
        self.flags.next.e1_below_e0 = self.delay_1_below_0.flag_out.val();
        self.flags.next.e2_below_e0 = self.delay_2_below_0.flag_out.val();
        self.flags.next.e2_below_e1 = self.delay_2_below_1.flag_out.val();
    }
}
