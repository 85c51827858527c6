//! Which control frames are due to the host, and which of them goes first.
//!
//! 1. The order is `Hello`, `Opened`, `Closed`, `NoSession`, `Ack` or `Nak`. Each is due once, however often it was asked for.
//! 2. Where both are due, one `Nak` stands for an `Ack` as well. A frame that is taken needs no `Nak` any more.
//! 3. What is asked for while a frame begins is due after it.
//! 4. `Open` and `Close` forget what was due to the session before, and so does its end.
//!
//! Latency: 1 clock.

use super::frame_judge::Asked;
use super::types::Byte;
use incircle_protocol::DeviceFrame;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Control frames that are due; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Replies {
    /// After reset none is due.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// What a frame asks for; a gap was seen before it.
    pub asked: Signal<In, Asked>,
    pub saw_gap: Signal<In, Bit>,
    /// The session ends without a word.
    pub fails: Signal<In, Bit>,
    /// A control frame is due; its type.
    pub is_due: Signal<Out, Bit>,
    pub kind: Signal<Out, Byte>,
    /// The control frame begins at this edge.
    pub starts: Signal<In, Bit>,
    /// The frame that is due is an `Ack` or `Nak`; a `Closed`.
    pub acknowledges: Signal<Out, Bit>,
    pub closes: Signal<Out, Bit>,
    hello: DFF<Bit>,
    opened: DFF<Bit>,
    closed: DFF<Bit>,
    no_session: DFF<Bit>,
    ack: DFF<Bit>,
    nak: DFF<Bit>,
}

// The kernel names types by number, because rust-hdl takes literals only; a change in the protocol must come here.
const _: () = assert!(
    DeviceFrame::Hello as u8 == 0x81
        && DeviceFrame::Opened as u8 == 0x82
        && DeviceFrame::Ack as u8 == 0x83
        && DeviceFrame::Nak as u8 == 0x84
        && DeviceFrame::NoSession as u8 == 0x87
        && DeviceFrame::Closed as u8 == 0x88,
    "the frames of this block follow the protocol"
);

impl Logic for Replies {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, hello, opened, closed, no_session, ack, nak);
        self.is_due.next = self.hello.q.val()
            | self.opened.q.val()
            | self.closed.q.val()
            | self.no_session.q.val()
            | self.ack.q.val()
            | self.nak.q.val();

        // The last that is due here is the first that goes.
        self.kind.next = 0x83.into();
        self.acknowledges.next = true;
        self.closes.next = false;
        if self.nak.q.val() {
            self.kind.next = 0x84.into();
        }
        if self.no_session.q.val() {
            self.kind.next = 0x87.into();
            self.acknowledges.next = false;
        }
        if self.closed.q.val() {
            self.kind.next = 0x88.into();
            self.acknowledges.next = false;
            self.closes.next = true;
        }
        if self.opened.q.val() {
            self.kind.next = 0x82.into();
            self.acknowledges.next = false;
            self.closes.next = false;
        }
        if self.hello.q.val() {
            self.kind.next = 0x81.into();
            self.acknowledges.next = false;
            self.closes.next = false;
        }

        if self.starts.val() {
            self.hello.d.next = false;
            if !self.hello.q.val() {
                self.opened.d.next = false;
                if !self.opened.q.val() {
                    self.closed.d.next = false;
                    if !self.closed.q.val() {
                        self.no_session.d.next = false;
                        if !self.no_session.q.val() {
                            self.ack.d.next = false;
                            self.nak.d.next = false;
                        }
                    }
                }
            }
        }
        if self.asked.val().hello {
            self.hello.d.next = true;
        }
        if self.asked.val().no_session {
            self.no_session.d.next = true;
        }
        if self.asked.val().rate | self.asked.val().repeats | (self.asked.val().polls & (!self.saw_gap.val())) {
            self.ack.d.next = true;
        }
        if (self.asked.val().gap & (!self.saw_gap.val())) | (self.asked.val().polls & self.saw_gap.val()) {
            self.nak.d.next = true;
        }
        if self.asked.val().takes {
            self.ack.d.next = true;
            self.nak.d.next = false;
        }
        if self.asked.val().opens | self.asked.val().closes | self.fails.val() | self.reset.val() {
            self.opened.d.next = self.asked.val().opens;
            self.closed.d.next = self.asked.val().closes;
            self.no_session.d.next = false;
            self.ack.d.next = false;
            self.nak.d.next = false;
        }
        if self.reset.val() {
            self.hello.d.next = false;
            self.opened.d.next = false;
            self.closed.d.next = false;
        }
    }
}
