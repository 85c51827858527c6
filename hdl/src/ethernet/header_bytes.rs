//! Chooses a byte of a frame to send among constants, the device's addresses, lengths, the check sum and the datagram.
//!
//! 1. `row.source` says where the byte comes from, as [`HeaderRow`](super::types::HeaderRow) lists it. Lengths go out
//!    high byte first; the 11 bits of a length have 5 zeros before them.
//! 2. The check sum is the complement of `sum`, high byte for the literal 0 and low byte for 1. While `sum_is_open` is
//!    high, its bytes are 0, as the sum itself demands.
//!
//! Latency: 1 clock from `row` and the other inputs to the byte.
//!
//! A byte of each source, with port 12,345 (30 39 hexadecimal), lengths 21e and 20a, and the sum f5f0:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9
//! source            0  1  2  3  4  5  6  7  7  .
//! literal          69 10  .  .  .  .  .  0  1  .
//! datagram_byte    80 81 82 83 84 85 86 87 88  .
//! sum_is_open     ________________________/^^\__
//! byte_data         . 69 48 82  2 30  2 10 10  0
//! ```

use super::own_bytes::OwnBytes;
use super::types::{Byte, HeaderRow, Place, Station};
use crate::commands::types::Half;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct HeaderBytes {
    pub clock: Signal<In, Clock>,
    pub station: Signal<In, Station>,
    /// The source of the byte.
    pub row: Signal<In, HeaderRow>,
    /// The byte, if it comes from the datagram.
    pub datagram_byte: Signal<In, Byte>,
    /// The lengths for IPv4 and for UDP.
    pub ip_length: Signal<In, Place>,
    pub udp_length: Signal<In, Place>,
    /// The sum over the header of IPv4, whose complement is the check sum.
    pub sum: Signal<In, Half>,
    pub sum_is_open: Signal<In, Bit>,
    /// The byte, a clock after its row.
    pub byte_data: Signal<Out, Byte>,
    own: OwnBytes,
    chosen: DFF<Byte>,
    sum_byte: Signal<Local, Byte>,
    ip_high: Signal<Local, Bits<3>>,
    udp_high: Signal<Local, Bits<3>>,
    all: Signal<Local, Byte>,
}

impl Logic for HeaderBytes {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, chosen);
        self.byte_data.next = self.chosen.q.val();
        self.all.next = 0xff.into();
        self.own.station.next = self.station.val();
        self.own.index.next = bit_cast::<4, 8>(self.row.val().literal);
        self.ip_high.next = self.ip_length.val().get_bits::<3>(8);
        self.udp_high.next = self.udp_length.val().get_bits::<3>(8);
        self.sum_byte.next = self.sum.val().get_bits::<8>(8);
        if self.row.val().literal.any() {
            self.sum_byte.next = self.sum.val().get_bits::<8>(0);
        }
        self.chosen.d.next = self.row.val().literal;
        match self.row.val().source.index() {
            1 => {
                self.chosen.d.next = self.own.byte_data.val();
            }
            2 => {
                self.chosen.d.next = self.datagram_byte.val();
            }
            3 => {
                self.chosen.d.next = bit_cast::<8, 3>(self.ip_high.val());
            }
            4 => {
                self.chosen.d.next = self.ip_length.val().get_bits::<8>(0);
            }
            5 => {
                self.chosen.d.next = bit_cast::<8, 3>(self.udp_high.val());
            }
            6 => {
                self.chosen.d.next = self.udp_length.val().get_bits::<8>(0);
            }
            7 => {
                self.chosen.d.next = self.sum_byte.val() ^ self.all.val();
                if self.sum_is_open.val() {
                    self.chosen.d.next = 0.into();
                }
            }
            _ => {
                self.chosen.d.next = self.row.val().literal;
            }
        }
    }
}
