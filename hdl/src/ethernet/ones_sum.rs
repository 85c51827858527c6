//! A running sum of 16-bit words in ones' complement, as the check sums of IPv4, ICMP and UDP are, over bytes.
//!
//! 1. The first byte of a word is its high byte. A byte without its other half counts as if that half were 0.
//! 2. A sum that does not start at 0 never becomes 0: it becomes 65,535, which is the other form of 0.
//!
//! Latency: 2 clocks from the last byte to the sum, if no byte follows; the last carry is added in the second one.
//!
//! The word 9 is added to 65,532. The sum is 6 because of the carry:
//! ```text
//! clock             0  1  2  3  4  5
//! sets            /^^\______________
//! takes           ___/^^^^^\________
//! is_low            .___/^^  .  .  .
//! byte_data         .  0  9  .  .  .
//! sum[5:0]          . 60 60  5  6  6
//! ```
//!
//! Source: RFC 1071. The carry of a word is added with the next one, as the lowest bit of one adder of 18 bits.

use super::types::Byte;
use crate::commands::types::Half;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct OnesSum {
    pub clock: Signal<In, Clock>,
    /// Set the sum to `start` at this edge.
    pub sets: Signal<In, Bit>,
    pub start: Signal<In, Half>,
    /// Add `byte_data` at this edge, as the low byte of a word or as the high one.
    pub takes: Signal<In, Bit>,
    pub is_low: Signal<In, Bit>,
    pub byte_data: Signal<In, Byte>,
    pub sum: Signal<Out, Half>,
    total: DFF<Half>,
    carry: DFF<Bit>,
    addend: Signal<Local, Bits<18>>,
    wide_byte: Signal<Local, Bits<18>>,
    wide_total: Signal<Local, Bits<18>>,
    left: Signal<Local, Bits<18>>,
    right: Signal<Local, Bits<18>>,
    carry_in: Signal<Local, Bits<18>>,
    next_total: Signal<Local, Bits<18>>,
    one: Signal<Local, Bits<18>>,
    nine: Signal<Local, Bits<18>>,
}

impl Logic for OnesSum {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, total, carry);
        self.one.next = 1.into();
        self.nine.next = 9.into();
        self.sum.next = self.total.q.val();
        self.wide_byte.next = bit_cast::<18, 8>(self.byte_data.val());
        self.wide_total.next = bit_cast::<18, 16>(self.total.q.val());
        self.addend.next = 0.into();
        if self.takes.val() {
            self.addend.next = self.wide_byte.val() << self.nine.val();
            if self.is_low.val() {
                self.addend.next = self.wide_byte.val() << self.one.val();
            }
        }
        self.carry_in.next = 0.into();
        if self.carry.q.val() {
            self.carry_in.next = 1.into();
        }
        self.left.next = (self.wide_total.val() << self.one.val()) | self.one.val();
        self.right.next = self.addend.val() | self.carry_in.val();
        self.next_total.next = self.left.val() + self.right.val();
        self.total.d.next = self.next_total.val().get_bits::<16>(1);
        self.carry.d.next = self.next_total.val().get_bit(17);
        if self.sets.val() {
            self.total.d.next = self.start.val();
            self.carry.d.next = false;
        }
    }
}
