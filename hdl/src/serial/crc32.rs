//! A running CRC-32 over bytes, one bit a clock.
//!
//! 1. A byte may come only while `is_busy` is low; otherwise the byte before is lost.
//! 2. `sets` forgets a byte that is not finished.
//!
//! Latency: 9 clocks. A byte of the line lasts 80 or more, and one bit a clock takes a quarter of the logic of
//! a byte a clock.
//!
//! Source: polynomial 04C11DB7, reflected, as in Ethernet and zip.

use super::types::Byte;
use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Crc32 {
    pub clock: Signal<In, Clock>,
    /// Set the state to `start` at this edge.
    pub sets: Signal<In, Bit>,
    pub start: Signal<In, Word>,
    /// Take `byte_data` at this edge.
    pub takes: Signal<In, Bit>,
    pub byte_data: Signal<In, Byte>,
    /// The state does not cover the last byte yet.
    pub is_busy: Signal<Out, Bit>,
    /// State of the check sum, all ones at the beginning; the check sum is its complement.
    pub state: Signal<Out, Word>,
    remainder: DFF<Word>,
    bits: DFF<Byte>,
    left: DFF<Bits<4>>,
    shifted: Signal<Local, Word>,
    one: Signal<Local, Word>,
    one_bit: Signal<Local, Byte>,
    one_left: Signal<Local, Bits<4>>,
    polynomial: Signal<Local, Word>,
    feeds_back: Signal<Local, Bit>,
}

impl Crc32 {
    /// The state before the first byte.
    pub const FIRST: u64 = 0xffff_ffff;
    /// The state after a frame that ends with its own check sum, if the check sum is right.
    pub const SOUND: u64 = 0xdebb_20e3;
}

impl Logic for Crc32 {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, remainder, bits, left);
        self.one.next = 1.into();
        self.one_bit.next = 1.into();
        self.one_left.next = 1.into();
        self.state.next = self.remainder.q.val();
        self.is_busy.next = self.left.q.val().any();
        self.feeds_back.next = self.remainder.q.val().get_bit(0) ^ self.bits.q.val().get_bit(0);
        self.shifted.next = self.remainder.q.val() >> self.one.val();
        self.polynomial.next = 0.into();
        if self.feeds_back.val() {
            self.polynomial.next = 0xedb8_8320u64.into();
        }
        if self.left.q.val().any() {
            self.remainder.d.next = self.shifted.val() ^ self.polynomial.val();
            self.bits.d.next = self.bits.q.val() >> self.one_bit.val();
            self.left.d.next = self.left.q.val() - self.one_left.val();
        }
        if self.takes.val() {
            self.bits.d.next = self.byte_data.val();
            self.left.d.next = 8.into();
        }
        if self.sets.val() {
            self.remainder.d.next = self.start.val();
            self.left.d.next = 0.into();
        }
    }
}
