//! Keeps which control frames are due to the host, and decides which of them goes first.
//!
//! 1. The order is `Hello`, `Opened`, `Closed`, `NoSession`, `Ack` or `Nak`. A frame is due once, however often the
//!    host asked for it.
//! 2. Where an `Ack` and a `Nak` are due, one `Nak` stands for both. `Data` that is taken cancels the `Nak`.
//! 3. A frame that is asked for while another begins is due after it.
//! 4. `Open` and `Close` cancel all that was due to the session before except a `Hello`; so does the end of a session
//!    by silence or a break.
//!
//! Latency: 1 clock from `asked` to `is_due`.

use super::frame_judge::Asked;
use super::types::Byte;
use crate::prelude::*;
use incircle_protocol::DeviceFrame;

#[derive(LogicBlock, Default)]
pub struct Replies {
    /// After a reset no frame is due.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The request of a frame; `saw_gap` says that a gap came before it.
    pub asked: Signal<In, Asked>,
    pub saw_gap: Signal<In, Bit>,
    /// The session ends by silence or a break, without a frame.
    pub fails: Signal<In, Bit>,
    /// A control frame of type `kind` is due.
    pub is_due: Signal<Out, Bit>,
    pub kind: Signal<Out, Byte>,
    /// The control frame that is due begins at this edge.
    pub starts: Signal<In, Bit>,
    /// The frame that is due is an `Ack` or `Nak` (`acknowledges`), or a `Closed` (`closes`).
    pub acknowledges: Signal<Out, Bit>,
    pub closes: Signal<Out, Bit>,
    hello: DFF<Bit>,
    opened: DFF<Bit>,
    closed: DFF<Bit>,
    no_session: DFF<Bit>,
    ack: DFF<Bit>,
    nak: DFF<Bit>,
}

// The kernel holds the types as literals, because rust-hdl allows no constants there. A changed protocol fails here.
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

        // The last assignment wins, so the frames are listed here in reverse order (rule 1).
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
