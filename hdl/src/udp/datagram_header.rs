//! The header of a datagram to the host, and the digest that goes with it, both as they were when the datagram began.
//! [`FrameHeader`](crate::serial::FrameHeader) of the UDP link.
//!
//! 1. `starts` keeps the state. The bytes and the digest show it until the next `starts`. `kind` is not kept, so it
//!    must stay while it is read.
//! 2. The status says that a datagram was dropped if `drops` was high since the last `starts`. A datagram of a host
//!    that is dropped in the very clock in which one to a host begins shows in the status of the next one.
//! 3. The free words of the FIFO go out as bytes, four for each.
//!
//! Latency: none (combinational) from `kind` and `index`; 1 clock from `starts`.
//!
//! The status (index 5) of three datagrams of an open session, which is 1, or 5 behind a datagram that was dropped, and
//! the low byte of the free bytes (index 6) of the last one:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8
//! drops           ___/^^\_____/^^\___________
//! starts          ______/^^\__/^^\__/^^\_____
//! state.free       10 11 12 13 14 15 16 17 18
//! index             5  5  5  5  5  5  5  6  5
//! byte_data         .  .  .  5  5  1  1 64  5
//! ```

use super::types::DatagramState;
use crate::commands::types::Word;
use crate::prelude::*;
use crate::serial::types::Byte;
use incircle_protocol::{STATUS_BUSY, STATUS_DROPPED, STATUS_OPEN};

#[derive(LogicBlock, Default)]
pub struct DatagramHeader {
    /// After a reset no datagram counts as dropped.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A datagram begins: the block keeps the state until the next one begins.
    pub starts: Signal<In, Bit>,
    pub state: Signal<In, DatagramState>,
    /// The device drops a datagram of a host.
    pub drops: Signal<In, Bit>,
    /// Kind of the datagram, and the byte that is wanted: 4 to 7 are the first four bytes of the header, 0 to 3 the
    /// number of the `Data` datagram that is awaited.
    pub kind: Signal<In, Byte>,
    pub index: Signal<In, Bits<3>>,
    pub byte_data: Signal<Out, Byte>,
    /// State of the digest at the beginning of the datagram.
    pub digest: Signal<Out, Word>,
    expected_then: DFF<Word>,
    digest_then: DFF<Word>,
    free_then: DFF<Bits<16>>,
    status_then: DFF<Byte>,
    has_dropped: DFF<Bit>,
    open_bit: Signal<Local, Byte>,
    dropped_bit: Signal<Local, Byte>,
    busy_bit: Signal<Local, Byte>,
    to_bytes: Signal<Local, Bits<16>>,
    free_bytes: Signal<Local, Bits<16>>,
}

// The kernel holds the bits as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    STATUS_OPEN == 1 && STATUS_DROPPED == 4 && STATUS_BUSY == 8,
    "the status of this block follows the protocol"
);

impl Logic for DatagramHeader {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, expected_then, digest_then, free_then, status_then, has_dropped);
        self.to_bytes.next = 2.into();
        self.digest.next = self.digest_then.q.val();
        self.open_bit.next = 0.into();
        self.dropped_bit.next = 0.into();
        self.busy_bit.next = 0.into();
        if self.state.val().is_open {
            self.open_bit.next = 1.into();
        }
        if self.has_dropped.q.val() {
            self.dropped_bit.next = 4.into();
        }
        if self.state.val().is_busy {
            self.busy_bit.next = 8.into();
        }
        self.free_bytes.next = self.state.val().free << self.to_bytes.val();
        if self.starts.val() {
            self.expected_then.d.next = self.state.val().expected;
            self.digest_then.d.next = self.state.val().digest;
            self.free_then.d.next = self.free_bytes.val();
            self.status_then.d.next = self.open_bit.val() | self.dropped_bit.val() | self.busy_bit.val();
            self.has_dropped.d.next = false;
        }
        if self.drops.val() {
            self.has_dropped.d.next = true;
        }
        if self.reset.val() {
            self.has_dropped.d.next = false;
        }
        match self.index.val().index() {
            0 => {
                self.byte_data.next = self.expected_then.q.val().get_bits::<8>(0);
            }
            1 => {
                self.byte_data.next = self.expected_then.q.val().get_bits::<8>(8);
            }
            2 => {
                self.byte_data.next = self.expected_then.q.val().get_bits::<8>(16);
            }
            3 => {
                self.byte_data.next = self.expected_then.q.val().get_bits::<8>(24);
            }
            4 => {
                self.byte_data.next = self.kind.val();
            }
            5 => {
                self.byte_data.next = self.status_then.q.val();
            }
            6 => {
                self.byte_data.next = self.free_then.q.val().get_bits::<8>(0);
            }
            _ => {
                self.byte_data.next = self.free_then.q.val().get_bits::<8>(8);
            }
        }
    }
}
