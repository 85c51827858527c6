//! The vector from one point to another, wide enough for a multiplier.
//!
//! 1. Two zero bits widen each coordinate before the subtraction, so the subtraction never wraps: 17 bits hold the
//!    result, 18 carry it.
//!
//! Latency: none (combinational) from the points to the vector.
//!
//! Source: the differences in orient2d and incircle.

use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct PointDifference {
    /// The two points: `x` in bits 0 to 15, `y` in bits 16 to 31, unsigned.
    pub from: Signal<In, Bits<32>>,
    pub to: Signal<In, Bits<32>>,
    /// The vector `to - from`, in two's complement.
    pub x: Signal<Out, Bits<18>>,
    pub y: Signal<Out, Bits<18>>,
    from_x: Signal<Local, Bits<16>>,
    from_y: Signal<Local, Bits<16>>,
    to_x: Signal<Local, Bits<16>>,
    to_y: Signal<Local, Bits<16>>,
    wide_from_x: Signal<Local, Bits<18>>,
    wide_from_y: Signal<Local, Bits<18>>,
    wide_to_x: Signal<Local, Bits<18>>,
    wide_to_y: Signal<Local, Bits<18>>,
}

impl Logic for PointDifference {
    #[hdl_gen]
    fn update(&mut self) {
        self.from_x.next = self.from.val().get_bits::<16>(0);
        self.from_y.next = self.from.val().get_bits::<16>(16);
        self.to_x.next = self.to.val().get_bits::<16>(0);
        self.to_y.next = self.to.val().get_bits::<16>(16);
        self.wide_from_x.next = bit_cast::<18, 16>(self.from_x.val());
        self.wide_from_y.next = bit_cast::<18, 16>(self.from_y.val());
        self.wide_to_x.next = bit_cast::<18, 16>(self.to_x.val());
        self.wide_to_y.next = bit_cast::<18, 16>(self.to_y.val());
        self.x.next = self.wide_to_x.val() - self.wide_from_x.val();
        self.y.next = self.wide_to_y.val() - self.wide_from_y.val();
    }
}
