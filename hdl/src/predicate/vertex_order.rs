//! The lexicographic order of the new point and a record's vertices, by which the tie rule decides.
//!
//! 1. The block takes new points at every edge. There is no reset.
//!
//! Latency: points that are valid before edge 1 give all flags after the edge given to the constructor as `latency`.
//!
//! Source: the canonical order of ties; a point as the number `x * 2^16 + y` sorts lexicographically.

use super::signs::{Corners, OrderFlags};
use super::widths::Point;
use crate::leaf::FlagDelay;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock)]
pub struct VertexOrder {
    pub clock: Signal<In, Clock>,
    pub corners: Signal<In, Corners>,
    pub p: Signal<In, Point>,
    pub flags: Signal<Out, OrderFlags>,
    key_r0: SortKey,
    key_r1: SortKey,
    key_r2: SortKey,
    key_p: SortKey,
    delay_before_r0: FlagDelay,
    delay_before_r1: FlagDelay,
    delay_before_r2: FlagDelay,
    delay_equals_r0: FlagDelay,
    delay_equals_r1: FlagDelay,
    delay_equals_r2: FlagDelay,
    delay_r0_before_r1: FlagDelay,
    delay_r0_before_r2: FlagDelay,
    delay_r1_before_r2: FlagDelay,
}

impl VertexOrder {
    /// A block whose flags come `latency` edges after the points.
    ///
    /// # Panics
    /// If `latency` is 0.
    pub fn new(latency: usize) -> Self {
        let delay = || FlagDelay::new(latency);
        Self {
            clock: Signal::default(),
            corners: Signal::default(),
            p: Signal::default(),
            flags: Signal::default(),
            key_r0: SortKey::default(),
            key_r1: SortKey::default(),
            key_r2: SortKey::default(),
            key_p: SortKey::default(),
            delay_before_r0: delay(),
            delay_before_r1: delay(),
            delay_before_r2: delay(),
            delay_equals_r0: delay(),
            delay_equals_r1: delay(),
            delay_equals_r2: delay(),
            delay_r0_before_r1: delay(),
            delay_r0_before_r2: delay(),
            delay_r1_before_r2: delay(),
        }
    }
}

impl Logic for VertexOrder {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, delay_before_r0, delay_before_r1, delay_before_r2);
        clock!(self, clock, delay_equals_r0, delay_equals_r1, delay_equals_r2);
        clock!(self, clock, delay_r0_before_r1, delay_r0_before_r2, delay_r1_before_r2);
        self.key_r0.point.next = self.corners.val().r0;
        self.key_r1.point.next = self.corners.val().r1;
        self.key_r2.point.next = self.corners.val().r2;
        self.key_p.point.next = self.p.val();
        self.delay_before_r0.flag_in.next = self.key_p.key.val() < self.key_r0.key.val();
        self.delay_before_r1.flag_in.next = self.key_p.key.val() < self.key_r1.key.val();
        self.delay_before_r2.flag_in.next = self.key_p.key.val() < self.key_r2.key.val();
        self.delay_equals_r0.flag_in.next = self.p.val() == self.corners.val().r0;
        self.delay_equals_r1.flag_in.next = self.p.val() == self.corners.val().r1;
        self.delay_equals_r2.flag_in.next = self.p.val() == self.corners.val().r2;
        self.delay_r0_before_r1.flag_in.next = self.key_r0.key.val() < self.key_r1.key.val();
        self.delay_r0_before_r2.flag_in.next = self.key_r0.key.val() < self.key_r2.key.val();
        self.delay_r1_before_r2.flag_in.next = self.key_r1.key.val() < self.key_r2.key.val();
        self.flags.next.p_before_r0 = self.delay_before_r0.flag_out.val();
        self.flags.next.p_before_r1 = self.delay_before_r1.flag_out.val();
        self.flags.next.p_before_r2 = self.delay_before_r2.flag_out.val();
        self.flags.next.p_equals_r0 = self.delay_equals_r0.flag_out.val();
        self.flags.next.p_equals_r1 = self.delay_equals_r1.flag_out.val();
        self.flags.next.p_equals_r2 = self.delay_equals_r2.flag_out.val();
        self.flags.next.r0_before_r1 = self.delay_r0_before_r1.flag_out.val();
        self.flags.next.r0_before_r2 = self.delay_r0_before_r2.flag_out.val();
        self.flags.next.r1_before_r2 = self.delay_r1_before_r2.flag_out.val();
    }
}

/// A point as a number that sorts lexicographically: the point with its halves exchanged.
#[derive(LogicBlock, Default)]
struct SortKey {
    pub point: Signal<In, Point>,
    pub key: Signal<Out, Bits<32>>,
    x: Signal<Local, Bits<16>>,
    y: Signal<Local, Bits<16>>,
    x_wide: Signal<Local, Bits<32>>,
    y_wide: Signal<Local, Bits<32>>,
    x_shifted: Signal<Local, Bits<32>>,
}

impl Logic for SortKey {
    #[hdl_gen]
    fn update(&mut self) {
        self.x.next = self.point.val().get_bits::<16>(0);
        self.y.next = self.point.val().get_bits::<16>(16);
        self.x_wide.next = bit_cast::<32, 16>(self.x.val());
        self.y_wide.next = bit_cast::<32, 16>(self.y.val());
        self.x_shifted.next = self.x_wide.val() << 16;
        self.key.next = self.x_shifted.val() | self.y_wide.val();
    }
}
