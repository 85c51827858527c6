//! Decides which frame goes to the host next, and keeps its type and contents while the frame is under way.
//!
//! 1. A control frame goes before an answer.
//! 2. `kind` and `contents` are valid from the clock after `starts` to the end of the frame.
//!
//! Latency: none (combinational) to `starts`, 1 clock to `kind` and `contents`.

use super::types::{Byte, Contents};
use crate::prelude::*;
use incircle_protocol::DeviceFrame;

#[derive(LogicBlock, Default)]
pub struct FrameChoice {
    pub clock: Signal<In, Clock>,
    /// No frame is under way, so the next one may begin.
    pub is_idle: Signal<In, Bit>,
    /// A control frame of type `reply_kind` is due.
    pub reply_is_due: Signal<In, Bit>,
    pub reply_kind: Signal<In, Byte>,
    /// A part of an answer is due; `answer_is_last` says that the part is the last one of its answer.
    pub answer_is_due: Signal<In, Bit>,
    pub answer_is_last: Signal<In, Bit>,
    /// No frame may begin: the rate is about to change, or a change of the session has not settled.
    pub holds: Signal<In, Bit>,
    /// No answer may begin, because the session is over.
    pub cuts: Signal<In, Bit>,
    /// A frame begins at this edge: a control frame or a part of an answer.
    pub starts: Signal<Out, Bit>,
    pub starts_reply: Signal<Out, Bit>,
    pub starts_answer: Signal<Out, Bit>,
    /// Type of the frame under way, and the parts behind its header.
    pub kind: Signal<Out, Byte>,
    pub contents: Signal<Out, Contents>,
    kind_byte: DFF<Byte>,
    is_hello: DFF<Bit>,
    is_receipt: DFF<Bit>,
    is_answer: DFF<Bit>,
    is_end: DFF<Bit>,
    may_start: Signal<Local, Bit>,
    begins_reply: Signal<Local, Bit>,
    begins_answer: Signal<Local, Bit>,
    hello_kind: Signal<Local, Byte>,
    ack_kind: Signal<Local, Byte>,
    nak_kind: Signal<Local, Byte>,
}

// The kernel holds the types as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    DeviceFrame::Hello as u8 == 0x81
        && DeviceFrame::Ack as u8 == 0x83
        && DeviceFrame::Nak as u8 == 0x84
        && DeviceFrame::Answer as u8 == 0x85
        && DeviceFrame::AnswerEnd as u8 == 0x86,
    "the frames of this block follow the protocol"
);

impl Logic for FrameChoice {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, kind_byte, is_hello, is_receipt, is_answer, is_end);
        self.hello_kind.next = 0x81.into();
        self.ack_kind.next = 0x83.into();
        self.nak_kind.next = 0x84.into();
        self.kind.next = self.kind_byte.q.val();
        self.contents.next.has_greeting = self.is_hello.q.val();
        self.contents.next.has_digest = self.is_receipt.q.val();
        self.contents.next.has_answer = self.is_answer.q.val();
        self.contents.next.ends_answer = self.is_end.q.val();

        self.may_start.next = self.is_idle.val() & (!self.holds.val());
        self.begins_reply.next = self.may_start.val() & self.reply_is_due.val();
        self.begins_answer.next =
            self.may_start.val() & self.answer_is_due.val() & (!self.reply_is_due.val()) & (!self.cuts.val());
        self.starts_reply.next = self.begins_reply.val();
        self.starts_answer.next = self.begins_answer.val();
        self.starts.next = self.begins_reply.val() | self.begins_answer.val();
        if self.begins_reply.val() {
            self.kind_byte.d.next = self.reply_kind.val();
            self.is_hello.d.next = self.reply_kind.val() == self.hello_kind.val();
            self.is_receipt.d.next =
                (self.reply_kind.val() == self.ack_kind.val()) | (self.reply_kind.val() == self.nak_kind.val());
            self.is_answer.d.next = false;
            self.is_end.d.next = false;
        }
        if self.begins_answer.val() {
            self.kind_byte.d.next = 0x85.into();
            if self.answer_is_last.val() {
                self.kind_byte.d.next = 0x86.into();
            }
            self.is_hello.d.next = false;
            self.is_receipt.d.next = false;
            self.is_answer.d.next = true;
            self.is_end.d.next = self.answer_is_last.val();
        }
    }
}
