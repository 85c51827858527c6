//! Lets answers and datagrams share one sender of frames: whichever waits, and in turn if both do.
//!
//! 1. `begins` may be high only while `waits` is. It begins a frame of the side that waits. If both wait, it begins one
//!    of the side that did not begin last.
//! 2. From the clock behind `begins` until the next one, the bytes are those of the side that began.
//! 3. The block has no reset. Until the first frame has begun, it is open whose turn it is, and the bytes mean nothing.
//!
//! Latency: none (combinational).
//!
//! An answer, then a datagram because the answer before had its turn, then the answer that waited meanwhile:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9
//! answer_waits    /^^\_____/^^^^^^^^^^^^^^\_____
//! datagram_waits  ______/^^^^^^^^\______________
//! begins          /^^\________/^^\_____/^^\_____
//! answer_begins   /^^\_________________/^^\_____
//! datagram_begins ____________/^^\______________
//! answer_data       . 11 12 13 14 15 16 17 18 19
//! datagram_data     . 51 52 53 54 55 56 57 58 59
//! byte_data         . 11 12 13 14 55 56 57 18 19
//! byte_is_last      .______/^^\_____/^^\________
//! ```

use super::types::Byte;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct SendChoice {
    pub clock: Signal<In, Clock>,
    /// An answer waits; it begins at this clock; its bytes.
    pub answer_waits: Signal<In, Bit>,
    pub answer_begins: Signal<Out, Bit>,
    pub answer_data: Signal<In, Byte>,
    pub answer_is_last: Signal<In, Bit>,
    /// The same of a datagram.
    pub datagram_waits: Signal<In, Bit>,
    pub datagram_begins: Signal<Out, Bit>,
    pub datagram_data: Signal<In, Byte>,
    pub datagram_is_last: Signal<In, Bit>,
    /// A frame waits; it begins at this clock; its bytes.
    pub waits: Signal<Out, Bit>,
    pub begins: Signal<In, Bit>,
    pub byte_data: Signal<Out, Byte>,
    pub byte_is_last: Signal<Out, Bit>,
    is_answer: DFF<Bit>,
    takes_answer: Signal<Local, Bit>,
}

impl Logic for SendChoice {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_answer);
        self.waits.next = self.answer_waits.val() | self.datagram_waits.val();
        self.takes_answer.next = self.answer_waits.val() & ((!self.datagram_waits.val()) | (!self.is_answer.q.val()));
        self.answer_begins.next = self.begins.val() & self.takes_answer.val();
        self.datagram_begins.next = self.begins.val() & (!self.takes_answer.val());
        if self.begins.val() {
            self.is_answer.d.next = self.takes_answer.val();
        }
        self.byte_data.next = self.datagram_data.val();
        self.byte_is_last.next = self.datagram_is_last.val();
        if self.is_answer.q.val() {
            self.byte_data.next = self.answer_data.val();
            self.byte_is_last.next = self.answer_is_last.val();
        }
    }
}
