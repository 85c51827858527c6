//! Compares the beginning of a datagram with what the session awaits, byte by byte as it comes.
//!
//! 1. Sender and session are compared with those of the open session, all but the Ethernet address of the sender. The
//!    number is compared with the one that is awaited.
//! 2. `head` is complete when the byte with index 27 has come, and stays until the next datagram begins.
//!
//! Latency: 1 clock from a byte to `head`.
//!
//! The kind (index 12) and the number (16 to 19) of a datagram, where number 3 is awaited:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9
//! head_valid      ___/^^^^^^^^^^^^^^^^^^^^\_____
//! index             . 11 12 15 16 17 18 19  .  .
//! byte_data         .  0  5  0  3  0  0  0  .  .
//! head.kind         .  .  .  5  5  5  5  5  5  5
//! head.is_next      .  .  .  .  .  .  .  ./^^^^^
//! head.is_less      .  .  .  .  .  .  .  .______
//! ```

use super::types::{DatagramHead, HeadIndex, UdpSession};
use crate::commands::types::Word;
use crate::prelude::*;
use crate::serial::types::Byte;
use incircle_protocol::DATAGRAM_HEADER_BYTES;

#[derive(LogicBlock, Default)]
pub struct DatagramMatch {
    pub clock: Signal<In, Clock>,
    /// A byte of the sender or the header, its index, and the byte of the open session that has the same meaning.
    pub head_valid: Signal<In, Bit>,
    pub index: Signal<In, HeadIndex>,
    pub byte_data: Signal<In, Byte>,
    pub session_byte: Signal<In, Byte>,
    pub session: Signal<In, UdpSession>,
    pub head: Signal<Out, DatagramHead>,
    found: DFF<DatagramHead>,
    is_first: Signal<Local, Bit>,
    compares: Signal<Local, Bit>,
    is_session: Signal<Local, Bit>,
    is_number: Signal<Local, Bit>,
    is_kind: Signal<Local, Bit>,
    low_index: Signal<Local, Bits<2>>,
    begins_word: Signal<Local, Bit>,
    awaited: Signal<Local, Word>,
    awaited_byte: Signal<Local, Byte>,
    is_same: Signal<Local, Bit>,
}

const _: () = assert!(DATAGRAM_HEADER_BYTES == 16, "the indices of this block follow the protocol");

impl Logic for DatagramMatch {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, found);
        self.head.next = self.found.q.val();

        // Indices 6 to 11 are address and port of the sender, 12 the kind, 16 to 19 the number, 20 to 27 the session.
        self.is_first.next = !self.index.val().any();
        self.low_index.next = self.index.val().get_bits::<2>(0);
        self.begins_word.next = !self.low_index.val().any();
        self.is_session.next =
            self.index.val().get_bit(4) & (self.index.val().get_bit(3) ^ self.index.val().get_bit(2));
        self.compares.next = (self.index.val().get_bit(3) ^ self.index.val().get_bit(2))
            & (self.index.val().get_bit(4) | self.index.val().get_bit(3) | self.index.val().get_bit(1));
        self.is_number.next =
            self.index.val().get_bit(4) & (!self.index.val().get_bit(3)) & (!self.index.val().get_bit(2));
        self.is_kind.next = (!self.index.val().get_bit(4))
            & self.index.val().get_bit(3)
            & self.index.val().get_bit(2)
            & self.begins_word.val();
        self.awaited.next = self.session.val().expected;
        match self.low_index.val().index() {
            0 => {
                self.awaited_byte.next = self.awaited.val().get_bits::<8>(0);
            }
            1 => {
                self.awaited_byte.next = self.awaited.val().get_bits::<8>(8);
            }
            2 => {
                self.awaited_byte.next = self.awaited.val().get_bits::<8>(16);
            }
            _ => {
                self.awaited_byte.next = self.awaited.val().get_bits::<8>(24);
            }
        }
        self.is_same.next = self.byte_data.val() == self.awaited_byte.val();
        if self.head_valid.val() {
            if self.is_first.val() {
                self.found.d.next.is_of_session = true;
                self.found.d.next.names_session = false;
                self.found.d.next.kind = 0.into();
            }
            if self.compares.val() & (self.byte_data.val() != self.session_byte.val()) {
                self.found.d.next.is_of_session = false;
            }
            if self.is_session.val() & self.byte_data.val().any() {
                self.found.d.next.names_session = true;
            }
            if self.is_kind.val() {
                self.found.d.next.kind = self.byte_data.val();
            }
            // The low byte comes first, so a later byte that differs decides.
            if self.is_number.val() {
                self.found.d.next.is_next = self.is_same.val() & (self.found.q.val().is_next | self.begins_word.val());
                if self.begins_word.val() | (!self.is_same.val()) {
                    self.found.d.next.is_less = self.byte_data.val() < self.awaited_byte.val();
                }
            }
        }
    }
}
