//! Sends Ethernet frames to the pins of a PHY, as GMII takes them: preamble, padding, check sum, gap.
//!
//! 1. While `waits` is high and the line is free, `begins` is high for one clock. The first byte of the frame must
//!    come [`MacOut::LEAD`] clocks later, and one at every clock from then on, up to the one with `byte_is_last`.
//! 2. A frame of fewer than 60 bytes is padded with zeros to 60. A frame has at most 1,514 bytes, which is not checked.
//! 3. After a frame the line is idle for 12 clocks at least.
//!
//! Latency: 1 clock from a byte to the pins.
//!
//! The end of a frame of 60 bytes or more, and the gap behind it:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9
//! byte_is_last    ___/^^\_______________________
//! data_valid      /^^^^^^^^^^^^^^^^^^^^\________
//! ```
//! Source: IEEE 802.3, clauses 3, 4 and 35.

use super::byte_crc::ByteCrc;
use super::types::Byte;
use crate::prelude::*;

/// The part of a frame that the sender puts on the line.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum SendPart {
    /// Nothing.
    Idle,
    /// Seven bytes 55, and D5.
    Preamble,
    /// The frame.
    Body,
    /// Zeros.
    Padding,
    /// The check sum.
    Sum,
    /// Nothing, for the gap.
    Gap,
}

#[derive(LogicBlock, Default)]
pub struct MacOut {
    pub clock: Signal<In, Clock>,
    /// A reset cuts a frame.
    pub reset: Signal<In, Bit>,
    /// A frame waits for the line, and the line becomes its own.
    pub waits: Signal<In, Bit>,
    pub begins: Signal<Out, Bit>,
    /// The bytes of the frame.
    pub byte_data: Signal<In, Byte>,
    pub byte_is_last: Signal<In, Bit>,
    /// The pins of the PHY.
    pub data_valid: Signal<Out, Bit>,
    pub data: Signal<Out, Byte>,
    part: DFF<SendPart>,
    /// Clocks that the preamble, the check sum or the gap will go on for, after this one.
    left: DFF<Bits<4>>,
    /// Number of bytes of the frame that were sent, up to 60.
    count: DFF<Bits<6>>,
    gives: DFF<Bit>,
    given: DFF<Byte>,
    crc: ByteCrc,
    one: Signal<Local, Bits<4>>,
    lead: Signal<Local, Bits<4>>,
    one_byte: Signal<Local, Bits<6>>,
    shortest: Signal<Local, Bits<6>>,
    last_short: Signal<Local, Bits<6>>,
    sum_byte: Signal<Local, Byte>,
    all: Signal<Local, Byte>,
}

impl MacOut {
    /// Number of clocks from `begins` to the first byte of a frame.
    pub const LEAD: usize = 4;
}

impl Logic for MacOut {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, part, left, count, gives, given);
        clock!(self, clock, crc);
        self.one.next = 1.into();
        self.lead.next = 3.into();
        self.one_byte.next = 1.into();
        self.shortest.next = 60.into();
        self.last_short.next = 59.into();
        self.all.next = 0xff.into();
        self.data_valid.next = self.gives.q.val();
        self.data.next = self.given.q.val();
        self.begins.next = (self.part.q.val() == SendPart::Preamble) & (self.left.q.val() == self.lead.val());
        self.crc.start.next = 0xffff_ffffu64.into();
        self.crc.sets.next = self.part.q.val() == SendPart::Preamble;
        self.crc.takes.next = (self.part.q.val() == SendPart::Body) | (self.part.q.val() == SendPart::Padding);
        self.crc.byte_data.next = 0.into();
        if self.part.q.val() == SendPart::Body {
            self.crc.byte_data.next = self.byte_data.val();
        }
        match self.left.q.val().index() {
            3 => {
                self.sum_byte.next = self.crc.state.val().get_bits::<8>(0);
            }
            2 => {
                self.sum_byte.next = self.crc.state.val().get_bits::<8>(8);
            }
            1 => {
                self.sum_byte.next = self.crc.state.val().get_bits::<8>(16);
            }
            _ => {
                self.sum_byte.next = self.crc.state.val().get_bits::<8>(24);
            }
        }

        self.gives.d.next = true;
        self.given.d.next = 0.into();
        self.left.d.next = self.left.q.val() - self.one.val();
        if self.crc.takes.val() & (self.count.q.val() != self.shortest.val()) {
            self.count.d.next = self.count.q.val() + self.one_byte.val();
        }
        match self.part.q.val() {
            SendPart::Idle => {
                self.gives.d.next = false;
                self.left.d.next = 7.into();
                self.count.d.next = 0.into();
                if self.waits.val() {
                    self.part.d.next = SendPart::Preamble;
                }
            }
            SendPart::Preamble => {
                self.given.d.next = 0x55.into();
                if !self.left.q.val().any() {
                    self.given.d.next = 0xd5.into();
                    self.part.d.next = SendPart::Body;
                }
            }
            SendPart::Body => {
                self.given.d.next = self.byte_data.val();
                self.left.d.next = 3.into();
                if self.byte_is_last.val() {
                    self.part.d.next = SendPart::Padding;
                    if self.count.q.val() >= self.last_short.val() {
                        self.part.d.next = SendPart::Sum;
                    }
                }
            }
            SendPart::Padding => {
                self.left.d.next = 3.into();
                if self.count.q.val() == self.last_short.val() {
                    self.part.d.next = SendPart::Sum;
                }
            }
            SendPart::Sum => {
                self.given.d.next = self.sum_byte.val() ^ self.all.val();
                if !self.left.q.val().any() {
                    self.left.d.next = 10.into();
                    self.part.d.next = SendPart::Gap;
                }
            }
            _ => {
                self.gives.d.next = false;
                if !self.left.q.val().any() {
                    self.part.d.next = SendPart::Idle;
                }
            }
        }
        if self.reset.val() {
            self.gives.d.next = false;
            self.left.d.next = 10.into();
            self.part.d.next = SendPart::Gap;
        }
    }
}
