//! Checks the lengths and the check sums of a received IPv4 datagram while its bytes come.
//!
//! 1. A datagram is whole if the length in the header of IPv4 is 28 or more, and as many bytes have come, and the four
//!    of the check sum of the frame. More bytes may stand between both, the padding of a short frame.
//! 2. `udp_is_right` demands that the length of UDP agrees with that of IPv4, and that the check sum is right or 0.
//! 3. The state is final a clock after the last byte of the frame. `udp_is_right` means something only if the datagram
//!    is whole.
//! 4. `has_more` says for a byte behind the header of UDP whether it belongs to the datagram. It means nothing if the
//!    length of IPv4 is below 28.
//!
//! Latency: 1 clock from a byte to `has_more` for the byte behind it.
//!
//! Bytes 16 to 18, which hold the length 30 of IPv4, and the bytes from 38 on: the length 10 of UDP, no check sum, two
//! bytes of payload, and the four of the check sum of the frame:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9 10 11 12 13 14 15
//! begins          /^^\____________________________________________
//! head_valid      ___/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\_____
//! head.data         .  0 30  9  0 10  0  0  9  9  9  9  9  9  .  .
//! has_more          .  .  .  .  .  .  .  ./^^^^^\______________  .
//! udp_is_right      .  .  .  .  .  .  .  .  .  .  .  .  .  ./^^^^^
//! is_whole          .  .  .  .  .  .  .  .__________________/^^^^^
//! ```
//!
//! Source: RFC 768 and 791. The check sum of UDP covers a copy of the addresses, 17, and the length of UDP once more.
//! The length of IPv4, which is 20 larger, stands in for the second length; the sum begins at 17 - 20 = -3.

use super::ones_sum::OnesSum;
use super::types::{Byte, DatagramState, HeadByte, Roles};
use crate::commands::types::Half;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct DatagramCheck {
    pub clock: Signal<In, Clock>,
    /// A frame begins.
    pub begins: Signal<In, Bit>,
    /// A byte of the frame.
    pub head_valid: Signal<In, Bit>,
    pub head: Signal<In, HeadByte>,
    pub state: Signal<Out, DatagramState>,
    /// Length of IPv4; then without its header; from byte 40 on the bytes that have yet to come, and 6 more.
    left: DFF<Half>,
    is_long: DFF<Bit>,
    has_left: DFF<Bit>,
    is_complete: DFF<Bit>,
    agrees: DFF<Bit>,
    has_sum: DFF<Bit>,
    header_sum: OnesSum,
    udp_sum: OnesSum,
    roles: Signal<Local, Roles>,
    wide_data: Signal<Local, Half>,
    high_data: Signal<Local, Half>,
    low_left: Signal<Local, Byte>,
    high_left: Signal<Local, Byte>,
    after_byte: Signal<Local, Half>,
    after_header: Signal<Local, Half>,
    one: Signal<Local, Half>,
    three: Signal<Local, Half>,
    seven: Signal<Local, Half>,
    eight: Signal<Local, Half>,
    /// The part of the length that only a length of 8 or more has.
    beyond: Signal<Local, Bits<13>>,
    header: Signal<Local, Half>,
    all: Signal<Local, Half>,
}

impl Logic for DatagramCheck {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left, is_long, has_left, is_complete, agrees, has_sum);
        clock!(self, clock, header_sum, udp_sum);
        self.roles.next = self.head.val().roles;
        self.one.next = 1.into();
        self.three.next = 3.into();
        self.seven.next = 7.into();
        self.eight.next = 8.into();
        self.beyond.next = self.left.q.val().get_bits::<13>(3);
        self.header.next = 20.into();
        self.all.next = 0xffff.into();
        self.state.next.header_is_right = self.header_sum.sum.val() == self.all.val();
        self.state.next.is_whole = self.is_long.q.val() & self.is_complete.q.val();
        self.state.next.udp_is_right =
            self.agrees.q.val() & ((!self.has_sum.q.val()) | (self.udp_sum.sum.val() == self.all.val()));
        self.state.next.has_more = self.has_left.q.val();

        self.header_sum.sets.next = self.begins.val();
        self.header_sum.start.next = 0.into();
        self.header_sum.takes.next = self.head_valid.val() & self.roles.val().sums_header;
        self.header_sum.is_low.next = self.head.val().is_low;
        self.header_sum.byte_data.next = self.head.val().data;
        self.udp_sum.sets.next = self.begins.val();
        self.udp_sum.start.next = 0xfffc.into();
        self.udp_sum.takes.next = self.head_valid.val() & self.roles.val().sums_udp & self.has_left.q.val();
        self.udp_sum.is_low.next = self.head.val().is_low;
        self.udp_sum.byte_data.next = self.head.val().data;

        self.wide_data.next = bit_cast::<16, 8>(self.head.val().data);
        self.high_data.next = self.wide_data.val() << self.eight.val();
        self.low_left.next = self.left.q.val().get_bits::<8>(0);
        self.high_left.next = self.left.q.val().get_bits::<8>(8);
        self.after_byte.next = self.left.q.val() - self.one.val();
        self.after_header.next = self.left.q.val() - self.header.val();
        if self.head_valid.val() {
            if self.roles.val().length_high {
                self.left.d.next = self.high_data.val();
            }
            if self.roles.val().length_low {
                self.left.d.next = self.left.q.val() | self.wide_data.val();
            }
            if self.roles.val().length_ends {
                self.left.d.next = self.after_header.val();
            }
            if self.roles.val().udp_high {
                self.is_long.d.next = self.beyond.val().any();
                self.agrees.d.next = self.head.val().data == self.high_left.val();
            }
            if self.roles.val().udp_low & (self.head.val().data != self.low_left.val()) {
                self.agrees.d.next = false;
            }
            // Behind the last byte of the datagram, the four bytes of the check sum of the frame must come too.
            if self.roles.val().counts & (!self.is_complete.q.val()) {
                self.left.d.next = self.after_byte.val();
                self.is_complete.d.next = self.left.q.val() == self.three.val();
                if self.left.q.val() == self.seven.val() {
                    self.has_left.d.next = false;
                }
            }
            if self.roles.val().is_udp_sum & self.wide_data.val().any() {
                self.has_sum.d.next = true;
            }
        }
        if self.begins.val() {
            self.is_long.d.next = false;
            self.has_left.d.next = true;
            self.is_complete.d.next = false;
            self.agrees.d.next = false;
            self.has_sum.d.next = false;
        }
    }
}
