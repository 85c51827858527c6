//! A running CRC-32 over bytes, one byte a clock.
//!
//! 1. `sets` forgets the bytes before. A byte that is taken at the same edge does not count.
//!
//! Latency: 1 clock from a byte to the state.
//!
//! The lowest six bits of the state over the bytes 49, 50 and 51:
//! ```text
//! clock             0  1  2  3  4  5  6
//! sets            /^^\_________________
//! takes           ___/^^^^^\__/^^\_____
//! byte_data         . 49 50  . 51  .  .
//! state[5:0]        . 63  8 50 50 45 45
//! ```
//!
//! Source: polynomial 04C11DB7, reflected, as `serial/crc32.rs`, which takes a bit a clock in a quarter of the logic.
//! The state is linear: a byte of eight bits adds one constant for each bit that is 1. The register holds the inverse
//! of the state, because a register of an FPGA begins with 0, and needs a LUT a bit to be set to 1 later.

use super::types::Byte;
use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct ByteCrc {
    pub clock: Signal<In, Clock>,
    /// Set the state to `start` at this edge: to [`ByteCrc::FIRST`] for a new sum.
    pub sets: Signal<In, Bit>,
    pub start: Signal<In, Word>,
    /// Take `byte_data` at this edge.
    pub takes: Signal<In, Bit>,
    pub byte_data: Signal<In, Byte>,
    /// State of the check sum; the check sum is its complement, low byte first.
    pub state: Signal<Out, Word>,
    inverse: DFF<Word>,
    remainder: Signal<Local, Word>,
    after: Signal<Local, Word>,
    mixed: Signal<Local, Byte>,
    eight: Signal<Local, Word>,
    upper: Signal<Local, Word>,
    terms: [Signal<Local, Word>; 8],
}

impl ByteCrc {
    /// The state before the first byte.
    pub const FIRST: u64 = crate::serial::Crc32::FIRST;
    /// The state after a frame that ends with its own check sum, if the check sum is right.
    pub const SOUND: u64 = crate::serial::Crc32::SOUND;
}

impl Logic for ByteCrc {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, inverse);
        self.remainder.next = !self.inverse.q.val();
        self.state.next = self.remainder.val();
        self.eight.next = 8.into();
        self.upper.next = self.remainder.val() >> self.eight.val();
        self.mixed.next = self.remainder.val().get_bits::<8>(0) ^ self.byte_data.val();
        for i in 0..8 {
            self.terms[i].next = 0.into();
        }
        if self.mixed.val().get_bit(0) {
            self.terms[0].next = 0x7707_3096.into();
        }
        if self.mixed.val().get_bit(1) {
            self.terms[1].next = 0xee0e_612cu64.into();
        }
        if self.mixed.val().get_bit(2) {
            self.terms[2].next = 0x076d_c419.into();
        }
        if self.mixed.val().get_bit(3) {
            self.terms[3].next = 0x0edb_8832.into();
        }
        if self.mixed.val().get_bit(4) {
            self.terms[4].next = 0x1db7_1064.into();
        }
        if self.mixed.val().get_bit(5) {
            self.terms[5].next = 0x3b6e_20c8.into();
        }
        if self.mixed.val().get_bit(6) {
            self.terms[6].next = 0x76dc_4190.into();
        }
        if self.mixed.val().get_bit(7) {
            self.terms[7].next = 0xedb8_8320u64.into();
        }
        self.after.next = self.upper.val()
            ^ self.terms[0].val()
            ^ self.terms[1].val()
            ^ self.terms[2].val()
            ^ self.terms[3].val()
            ^ self.terms[4].val()
            ^ self.terms[5].val()
            ^ self.terms[6].val()
            ^ self.terms[7].val();
        if self.takes.val() {
            self.inverse.d.next = !self.after.val();
        }
        if self.sets.val() {
            self.inverse.d.next = !self.start.val();
        }
    }
}
