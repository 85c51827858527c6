//! Signs and signed order of the three orientations of a visit.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock` | in | 1 | everything happens at its rising edge |
//! | `e0`, `e1`, `e2` | in | 36 | orientations, two's complement, each in `-2^32 .. 2^32` |
//! | `e0_negative`, `e1_negative`, `e2_negative` | out | 1 | below zero |
//! | `e0_zero`, `e1_zero`, `e2_zero` | out | 1 | zero |
//! | `e1_below_e0`, `e2_below_e0`, `e2_below_e1` | out | 1 | signed comparison |
//!
//! 1. New orientations are taken at every edge. There is no reset.
//! 2. Bits 33 to 35 of an input repeat its sign and are cut off.
//!
//! Latency: orientations that stand before edge 1 are registered there; their flags come after edge `latency` of the constructor.
//!
//! Source: the rules of the walk. A signed comparison is an unsigned one of numbers whose top bits are inverted.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

use crate::leaf::FlagDelay;

/// Flags of three orientations; see the top of this file.
#[derive(LogicBlock)]
pub struct EdgeSigns {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Orientation of edge 0.
    pub e0: Signal<In, Bits<36>>,
    /// Orientation of edge 1.
    pub e1: Signal<In, Bits<36>>,
    /// Orientation of edge 2.
    pub e2: Signal<In, Bits<36>>,
    /// `e0 < 0`.
    pub e0_negative: Signal<Out, Bit>,
    /// `e1 < 0`.
    pub e1_negative: Signal<Out, Bit>,
    /// `e2 < 0`.
    pub e2_negative: Signal<Out, Bit>,
    /// `e0 = 0`.
    pub e0_zero: Signal<Out, Bit>,
    /// `e1 = 0`.
    pub e1_zero: Signal<Out, Bit>,
    /// `e2 = 0`.
    pub e2_zero: Signal<Out, Bit>,
    /// `e1 < e0`.
    pub e1_below_e0: Signal<Out, Bit>,
    /// `e2 < e0`.
    pub e2_below_e0: Signal<Out, Bit>,
    /// `e2 < e1`.
    pub e2_below_e1: Signal<Out, Bit>,
    value_0: DFF<Bits<33>>,
    value_1: DFF<Bits<33>>,
    value_2: DFF<Bits<33>>,
    biased_0: Signal<Local, Bits<33>>,
    biased_1: Signal<Local, Bits<33>>,
    biased_2: Signal<Local, Bits<33>>,
    delay_negative_0: FlagDelay,
    delay_negative_1: FlagDelay,
    delay_negative_2: FlagDelay,
    delay_zero_0: FlagDelay,
    delay_zero_1: FlagDelay,
    delay_zero_2: FlagDelay,
    delay_1_below_0: FlagDelay,
    delay_2_below_0: FlagDelay,
    delay_2_below_1: FlagDelay,
    zero: Constant<Bits<33>>,
    sign: Constant<Bits<33>>,
}

impl EdgeSigns {
    /// Flags that come `latency` edges after the orientations.
    ///
    /// # Panics
    /// If `latency` is below 2.
    pub fn new(latency: usize) -> Self {
        assert!(
            latency >= 2,
            "the signs of edges take at least 2 clocks, not {latency}"
        );
        let delay = || FlagDelay::new(latency - 1);
        Self {
            clock: Signal::default(),
            e0: Signal::default(),
            e1: Signal::default(),
            e2: Signal::default(),
            e0_negative: Signal::default(),
            e1_negative: Signal::default(),
            e2_negative: Signal::default(),
            e0_zero: Signal::default(),
            e1_zero: Signal::default(),
            e2_zero: Signal::default(),
            e1_below_e0: Signal::default(),
            e2_below_e0: Signal::default(),
            e2_below_e1: Signal::default(),
            value_0: DFF::default(),
            value_1: DFF::default(),
            value_2: DFF::default(),
            biased_0: Signal::default(),
            biased_1: Signal::default(),
            biased_2: Signal::default(),
            delay_negative_0: delay(),
            delay_negative_1: delay(),
            delay_negative_2: delay(),
            delay_zero_0: delay(),
            delay_zero_1: delay(),
            delay_zero_2: delay(),
            delay_1_below_0: delay(),
            delay_2_below_0: delay(),
            delay_2_below_1: delay(),
            zero: Constant::new(Bits::default()),
            sign: Constant::new(Bits::from(1 << 32)),
        }
    }
}

impl Logic for EdgeSigns {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, value_0, value_1, value_2);
        clock!(
            self,
            clock,
            delay_negative_0,
            delay_negative_1,
            delay_negative_2
        );
        clock!(self, clock, delay_zero_0, delay_zero_1, delay_zero_2);
        clock!(
            self,
            clock,
            delay_1_below_0,
            delay_2_below_0,
            delay_2_below_1
        );
        self.value_0.d.next = bit_cast::<33, 36>(self.e0.val());
        self.value_1.d.next = bit_cast::<33, 36>(self.e1.val());
        self.value_2.d.next = bit_cast::<33, 36>(self.e2.val());
        self.biased_0.next = self.value_0.q.val() ^ self.sign.val();
        self.biased_1.next = self.value_1.q.val() ^ self.sign.val();
        self.biased_2.next = self.value_2.q.val() ^ self.sign.val();
        self.delay_negative_0.flag_in.next = self.value_0.q.val().get_bit(32);
        self.delay_negative_1.flag_in.next = self.value_1.q.val().get_bit(32);
        self.delay_negative_2.flag_in.next = self.value_2.q.val().get_bit(32);
        self.delay_zero_0.flag_in.next = self.value_0.q.val() == self.zero.val();
        self.delay_zero_1.flag_in.next = self.value_1.q.val() == self.zero.val();
        self.delay_zero_2.flag_in.next = self.value_2.q.val() == self.zero.val();
        self.delay_1_below_0.flag_in.next = self.biased_1.val() < self.biased_0.val();
        self.delay_2_below_0.flag_in.next = self.biased_2.val() < self.biased_0.val();
        self.delay_2_below_1.flag_in.next = self.biased_2.val() < self.biased_1.val();
        self.e0_negative.next = self.delay_negative_0.flag_out.val();
        self.e1_negative.next = self.delay_negative_1.flag_out.val();
        self.e2_negative.next = self.delay_negative_2.flag_out.val();
        self.e0_zero.next = self.delay_zero_0.flag_out.val();
        self.e1_zero.next = self.delay_zero_1.flag_out.val();
        self.e2_zero.next = self.delay_zero_2.flag_out.val();
        self.e1_below_e0.next = self.delay_1_below_0.flag_out.val();
        self.e2_below_e0.next = self.delay_2_below_0.flag_out.val();
        self.e2_below_e1.next = self.delay_2_below_1.flag_out.val();
    }
}
