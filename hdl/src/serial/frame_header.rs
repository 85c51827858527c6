//! The header of a frame to the host, and the digest that goes with it, both as they were when the frame began.
//!
//! 1. A frame of the host that is dropped in the very clock in which a frame to the host begins shows in the status
//!    of the next one.
//!
//! Latency: none (combinational) from `kind` and `index`.

use super::types::{Byte, Receipt, Session};
use crate::commands::types::Word;
use crate::prelude::*;
use incircle_protocol::{STATUS_BAD_RATE, STATUS_BUSY, STATUS_DROPPED, STATUS_OPEN};

#[derive(LogicBlock, Default)]
pub struct FrameHeader {
    /// After a reset no frame counts as dropped.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A frame begins: the block keeps the fields below until the next frame begins.
    pub starts: Signal<In, Bit>,
    /// The session, the number of answers sent to their end, the credit and the digest.
    pub open: Signal<In, Session>,
    pub answers: Signal<In, Byte>,
    pub receipt: Signal<In, Receipt>,
    /// Bits of the status: the device refused the last `Rate`; a command is under way.
    pub is_refused: Signal<In, Bit>,
    pub is_busy: Signal<In, Bit>,
    /// The device drops a frame of the host.
    pub drops: Signal<In, Bit>,
    /// Type of the frame, and index of the wanted byte of the header, 0 to 6.
    pub kind: Signal<In, Byte>,
    pub index: Signal<In, Bits<3>>,
    pub byte_data: Signal<Out, Byte>,
    /// State of the digest at the beginning of the frame.
    pub digest_taken: Signal<Out, Word>,
    session_then: DFF<Byte>,
    expected_then: DFF<Byte>,
    answers_then: DFF<Byte>,
    free_then: DFF<Bits<16>>,
    status_then: DFF<Byte>,
    digest_then: DFF<Word>,
    has_dropped: DFF<Bit>,
    open_bit: Signal<Local, Byte>,
    refused_bit: Signal<Local, Byte>,
    dropped_bit: Signal<Local, Byte>,
    busy_bit: Signal<Local, Byte>,
}

// The kernel holds the bits as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    STATUS_OPEN == 1 && STATUS_BAD_RATE == 2 && STATUS_DROPPED == 4 && STATUS_BUSY == 8,
    "the status of this block follows the protocol"
);

impl Logic for FrameHeader {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, session_then, expected_then, answers_then, free_then, status_then, digest_then);
        dff_setup!(self, clock, has_dropped);
        self.digest_taken.next = self.digest_then.q.val();
        self.open_bit.next = 0.into();
        self.refused_bit.next = 0.into();
        self.dropped_bit.next = 0.into();
        self.busy_bit.next = 0.into();
        if self.open.val().is_open {
            self.open_bit.next = 1.into();
        }
        if self.is_refused.val() {
            self.refused_bit.next = 2.into();
        }
        if self.has_dropped.q.val() {
            self.dropped_bit.next = 4.into();
        }
        if self.is_busy.val() {
            self.busy_bit.next = 8.into();
        }
        if self.starts.val() {
            self.session_then.d.next = self.open.val().number;
            self.expected_then.d.next = self.open.val().expected;
            self.answers_then.d.next = self.answers.val();
            self.free_then.d.next = self.receipt.val().free;
            self.status_then.d.next =
                self.open_bit.val() | self.refused_bit.val() | self.dropped_bit.val() | self.busy_bit.val();
            self.digest_then.d.next = self.receipt.val().digest;
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
                self.byte_data.next = self.session_then.q.val();
            }
            1 => {
                self.byte_data.next = self.kind.val();
            }
            2 => {
                self.byte_data.next = self.expected_then.q.val();
            }
            3 => {
                self.byte_data.next = self.answers_then.q.val();
            }
            4 => {
                self.byte_data.next = self.free_then.q.val().get_bits::<8>(0);
            }
            5 => {
                self.byte_data.next = self.free_then.q.val().get_bits::<8>(8);
            }
            _ => {
                self.byte_data.next = self.status_then.q.val();
            }
        }
    }
}
