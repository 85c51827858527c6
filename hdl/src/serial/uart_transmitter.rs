//! Transmits bytes onto a line: 8 data bits, no parity, one stop bit, at any rate.
//!
//! 1. `byte_ready` depends on registers only and lasts one clock: the transmitter takes a byte between two bits.
//! 2. Bytes that are always valid follow each other without a gap. A byte that comes later waits for up to a bit.
//!
//! Latency: 1 clock from the byte taken to its start bit.
//!
//! Source: the register of the line is inverted, so that the line is high before the first reset too.

use super::bit_clock::BitClock;
use super::types::{Byte, Step};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct UartTransmitter {
    pub clock: Signal<In, Clock>,
    /// A reset leaves the line high.
    pub reset: Signal<In, Bit>,
    /// Rate of the line: a bit lasts `2^24 / step` clocks.
    pub step: Signal<In, Step>,
    /// The bytes for the line.
    pub byte_valid: Signal<In, Bit>,
    pub byte_ready: Signal<Out, Bit>,
    pub byte_data: Signal<In, Byte>,
    /// The line, high when idle.
    pub tx: Signal<Out, Bit>,
    /// The last stop bit has ended.
    pub is_idle: Signal<Out, Bit>,
    is_low: DFF<Bit>,
    /// Data bits that have yet to be sent, inverted; the zeros behind them are the stop bit.
    bits: DFF<Byte>,
    /// Bits of the byte that have not ended, counting the one on the line.
    left: DFF<Bits<4>>,
    bit_clock: BitClock,
    is_over: Signal<Local, Bit>,
    all: Signal<Local, Byte>,
    one: Signal<Local, Byte>,
    one_bit: Signal<Local, Bits<4>>,
}

impl UartTransmitter {
    /// A transmitter with an idle line.
    pub fn new() -> Self {
        Self { bit_clock: BitClock::at_ends(), ..Self::default() }
    }
}

impl Logic for UartTransmitter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_low, bits, left);
        clock!(self, clock, bit_clock);
        self.all.next = 0xff.into();
        self.one.next = 1.into();
        self.one_bit.next = 1.into();
        self.tx.next = !self.is_low.q.val();
        self.is_idle.next = !self.left.q.val().any();
        self.bit_clock.step.next = self.step.val();
        self.bit_clock.starts.next = self.reset.val();
        self.is_over.next = !self.left.q.val().get_bits::<3>(1).any();
        self.byte_ready.next = self.bit_clock.ticks.val() & self.is_over.val();
        if self.bit_clock.ticks.val() {
            self.is_low.d.next = self.bits.q.val().get_bit(0);
            self.bits.d.next = self.bits.q.val() >> self.one.val();
            self.left.d.next = self.left.q.val() - self.one_bit.val();
            if self.is_over.val() {
                self.is_low.d.next = self.byte_valid.val();
                self.bits.d.next = self.byte_data.val() ^ self.all.val();
                self.left.d.next = 0.into();
                if self.byte_valid.val() {
                    self.left.d.next = 10.into();
                }
            }
        }
        if self.reset.val() {
            self.is_low.d.next = false;
            self.left.d.next = 0.into();
        }
    }
}
