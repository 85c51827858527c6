//! Tells whether a byte is the last one of its part of a frame to the host, so that `FrameSender` need not know the
//! lengths of the parts.
//!
//! Latency: 1 clock from `at` to `is_last`.

use super::types::BytePlace;
use crate::prelude::*;
use incircle_protocol::{ANSWER_HEADER_BYTES, CRC_BYTES, DEVICE_HEADER_BYTES, GREETING_WORDS};

#[derive(LogicBlock, Default)]
pub struct FramePart {
    pub clock: Signal<In, Clock>,
    pub at: Signal<In, BytePlace>,
    /// The byte is the last one of the words of an answer in this frame.
    pub word_byte_is_last: Signal<In, Bit>,
    /// The byte, a clock earlier at `at`, is the last one of its part.
    pub is_last: Signal<Out, Bit>,
    at_end: DFF<Bit>,
    last_index: Signal<Local, Bits<6>>,
}

// The kernel holds the lengths as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    DEVICE_HEADER_BYTES == 7 && GREETING_WORDS == 13 && ANSWER_HEADER_BYTES == 3 && CRC_BYTES == 4,
    "the parts of this block follow the protocol"
);

impl Logic for FramePart {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, at_end);
        self.is_last.next = self.at_end.q.val();
        self.last_index.next = 3.into();
        match self.at.val().part.index() {
            0 => {
                self.last_index.next = 6.into();
                self.at_end.d.next = self.at.val().index == self.last_index.val();
            }
            1 => {
                self.last_index.next = 51.into();
                self.at_end.d.next = self.at.val().index == self.last_index.val();
            }
            3 => {
                self.last_index.next = 2.into();
                self.at_end.d.next = self.at.val().index == self.last_index.val();
            }
            4 => {
                self.at_end.d.next = self.word_byte_is_last.val();
            }
            _ => {
                self.at_end.d.next = self.at.val().index == self.last_index.val();
            }
        }
    }
}
