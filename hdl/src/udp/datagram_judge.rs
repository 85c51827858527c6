//! Judges each datagram of a host: what the datagram asks for, and whether its words count.
//!
//! 1. A datagram to all devices asks for nothing unless it is a `Hello`.
//! 2. A request that needs the one place for answers while the place is taken asks for nothing.
//! 3. At most one field of `asks` besides `hears`, `replies` and `reply` is high.
//!
//! Latency: 1 clock from `comes` to `asks`.
//!
//! `Data` that is awaited, `Data` behind a gap, and `Data` that is damaged, in an open session:
//! ```text
//! clock              0  1  2  3  4  5  6  7  8  9
//! comes            ___/^^\_____/^^\_____/^^\_____
//! head.is_next       ./^^  .  .___  .  .___  .  .
//! verdict.is_sound   ./^^  .  ./^^  .  .___  .  .
//! asks.hears       ______/^^\_____/^^\___________
//! asks.takes       ______/^^\____________________
//! asks.gap         _______________/^^\___________
//! asks.drops       ________________________/^^\__
//! ```

use super::types::{DatagramAsks, DatagramHead, DatagramVerdict, UdpSession};
use crate::prelude::*;
use incircle_protocol::{DeviceDatagram, HostDatagram};

#[derive(LogicBlock, Default)]
pub struct DatagramJudge {
    pub clock: Signal<In, Clock>,
    /// The kind of the beginning of the datagram, from `DatagramMatch`.
    pub head: Signal<In, DatagramHead>,
    /// The datagram has ended.
    pub comes: Signal<In, Bit>,
    pub verdict: Signal<In, DatagramVerdict>,
    pub session: Signal<In, UdpSession>,
    /// All words of the datagram found room in the FIFO.
    pub has_room: Signal<In, Bit>,
    /// An answer is in the one place.
    pub place_is_taken: Signal<In, Bit>,
    /// The request of the datagram that has just ended.
    pub asks: Signal<Out, DatagramAsks>,
    answer: DFF<DatagramAsks>,
    kind: Signal<Local, Bits<8>>,
    high_kind: Signal<Local, Bits<5>>,
    low_kind: Signal<Local, Bits<3>>,
    is_known: Signal<Local, Bit>,
    is_hello: Signal<Local, Bit>,
    is_open: Signal<Local, Bit>,
    is_poll: Signal<Local, Bit>,
    is_data: Signal<Local, Bit>,
    is_close: Signal<Local, Bit>,
    fits: Signal<Local, Bit>,
    is_wanted: Signal<Local, Bit>,
    is_ours: Signal<Local, Bit>,
    may_reply: Signal<Local, Bit>,
    opens: Signal<Local, Bit>,
    closes: Signal<Local, Bit>,
    is_orphan: Signal<Local, Bit>,
    takes: Signal<Local, Bit>,
    data_of_ours: Signal<Local, Bit>,
}

// The kernel holds the kinds as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    HostDatagram::Hello as u8 == 1
        && HostDatagram::Open as u8 == 2
        && HostDatagram::Poll as u8 == 4
        && HostDatagram::Data as u8 == 5
        && HostDatagram::Close as u8 == 6
        && DeviceDatagram::Hello as u8 == 0x81
        && DeviceDatagram::Opened as u8 == 0x82
        && DeviceDatagram::NoSession as u8 == 0x87
        && DeviceDatagram::Closed as u8 == 0x88
        && DeviceDatagram::Busy as u8 == 0x89,
    "the kinds of this block follow the protocol"
);

impl Logic for DatagramJudge {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, answer);
        self.asks.next = self.answer.q.val();

        self.kind.next = self.head.val().kind;
        self.high_kind.next = self.kind.val().get_bits::<5>(3);
        self.low_kind.next = self.kind.val().get_bits::<3>(0);
        self.is_known.next = !self.high_kind.val().any();
        self.is_hello.next = false;
        self.is_open.next = false;
        self.is_poll.next = false;
        self.is_data.next = false;
        self.is_close.next = false;
        match self.low_kind.val().index() {
            1 => {
                self.is_hello.next = self.is_known.val() & self.verdict.val().is_greeting;
            }
            2 => {
                self.is_open.next = self.is_known.val() & self.verdict.val().is_bare;
            }
            4 => {
                self.is_poll.next = self.is_known.val() & self.verdict.val().is_bare;
            }
            5 => {
                self.is_data.next = self.is_known.val() & self.verdict.val().is_data;
            }
            6 => {
                self.is_close.next = self.is_known.val() & self.verdict.val().is_bare;
            }
            _ => {}
        }
        self.fits.next = self.verdict.val().is_sound
            & (self.is_hello.val()
                | self.is_open.val()
                | self.is_poll.val()
                | self.is_data.val()
                | self.is_close.val());
        self.is_wanted.next =
            self.comes.val() & self.fits.val() & (self.is_hello.val() | (!self.verdict.val().is_to_all));
        self.may_reply.next = self.is_wanted.val() & (!self.place_is_taken.val());
        self.is_ours.next = self.session.val().is_open & self.head.val().is_of_session;
        self.opens.next = self.may_reply.val() & self.is_open.val() & self.head.val().names_session;
        self.closes.next = self.may_reply.val() & self.is_close.val() & self.is_ours.val();
        self.is_orphan.next = self.may_reply.val()
            & (self.is_poll.val() | self.is_data.val() | self.is_close.val())
            & (!self.session.val().is_open);
        self.data_of_ours.next = self.is_wanted.val() & self.is_data.val() & self.is_ours.val();
        self.takes.next = self.data_of_ours.val() & self.head.val().is_next & self.has_room.val();

        self.answer.d.next.hears = (self.opens.val() & (self.is_ours.val() | (!self.session.val().is_open)))
            | (self.is_wanted.val() & self.is_ours.val() & (self.is_poll.val() | self.is_data.val()));
        self.answer.d.next.replies =
            (self.may_reply.val() & self.is_hello.val()) | self.opens.val() | self.closes.val() | self.is_orphan.val();
        self.answer.d.next.reply = 1.into();
        if self.opens.val() {
            self.answer.d.next.reply = 2.into();
            if self.session.val().is_open & (!self.head.val().is_of_session) {
                self.answer.d.next.reply = 9.into();
            }
        }
        if self.closes.val() {
            self.answer.d.next.reply = 8.into();
        }
        if self.is_orphan.val() {
            self.answer.d.next.reply = 7.into();
        }
        self.answer.d.next.opens = self.opens.val() & (!self.session.val().is_open);
        self.answer.d.next.closes = self.closes.val();
        self.answer.d.next.polls = self.is_wanted.val() & self.is_poll.val() & self.is_ours.val();
        self.answer.d.next.takes = self.takes.val();
        self.answer.d.next.repeats = self.data_of_ours.val() & self.head.val().is_less & (!self.head.val().is_next);
        self.answer.d.next.gap =
            self.data_of_ours.val() & (!self.takes.val()) & (self.head.val().is_next | (!self.head.val().is_less));
        self.answer.d.next.drops = self.comes.val()
            & self.verdict.val().counts
            & ((!self.fits.val())
                | (self.is_open.val() & (!self.head.val().names_session) & (!self.verdict.val().is_to_all)));
    }
}
