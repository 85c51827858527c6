//! Judges each frame of the host: what the frame asks for, and whether its payload may enter the receive FIFO.
//!
//! 1. At the end of a frame at most one field of `asked` besides `hears` is high; none is high for a
//!    frame of another session.
//! 2. `takes_payload` is decided 3 clocks after the header and stays until the end of the frame. While it is high, the
//!    FIFO has room for `head.length` bytes.
//! 3. Bytes of a frame come at least 16 clocks apart, so the header is compared in several ranks of registers.
//! 4. The clock of `comes` looks once more at whether a session is open, because the session may have ended
//!    in any clock before.
//!
//! Latency: 1 clock from `comes` to `asked`.

use super::types::{Byte, FrameHead, Session};
use crate::packed;
use crate::prelude::*;
use incircle_protocol::{HostFrame, MAX_PAYLOAD};

packed! {
    /// The request of a frame, valid for one clock after the end of the frame.
    pub struct Asked {
        /// A sound frame of a known type has come, so a host is there.
        pub hears: bool,
        /// A `Hello`, with or without a session.
        pub hello: bool,
        /// An `Open`, which begins a session.
        pub opens: bool,
        /// A `Rate` of the open session.
        pub rate: bool,
        /// A `Poll` of the open session.
        pub polls: bool,
        /// A `Close` of the open session.
        pub closes: bool,
        /// A `Data` whose payload the device takes.
        pub takes: bool,
        /// A `Data` that the device has taken before.
        pub repeats: bool,
        /// A `Data` behind a gap, or one for which the FIFO has no room.
        pub gap: bool,
        /// A frame that needs a session, while none is open.
        pub no_session: bool,
        /// A frame that the device drops: damaged, of an unknown type or of a wrong length.
        pub drops: bool,
    }
}

#[derive(LogicBlock, Default)]
pub struct FrameJudge {
    pub clock: Signal<In, Clock>,
    /// A reset forgets the frame under way.
    pub reset: Signal<In, Bit>,
    /// The header of the frame, from `FrameReader`.
    pub head: Signal<In, FrameHead>,
    /// The header is complete at this clock.
    pub header_comes: Signal<In, Bit>,
    /// The frame has ended; `is_sound` says that its check sum and its length are right.
    pub comes: Signal<In, Bit>,
    pub is_sound: Signal<In, Bit>,
    pub open: Signal<In, Session>,
    /// Free bytes of the receive FIFO.
    pub free: Signal<In, Bits<16>>,
    /// The payload goes into the FIFO, where it counts only if the frame turns out to be sound.
    pub takes_payload: Signal<Out, Bit>,
    /// The request of the frame that has just ended.
    pub asked: Signal<Out, Asked>,
    // First rank: comparisons of the header alone.
    kind_low: DFF<Bits<3>>,
    is_host_kind: DFF<Bit>,
    is_this_session: DFF<Bit>,
    names_session: DFF<Bit>,
    is_none: DFF<Bit>,
    is_four: DFF<Bit>,
    is_words: DFF<Bit>,
    distance: DFF<Byte>,
    has_room: DFF<Bit>,
    // Second rank: the decisions that combine several comparisons.
    is_fit: DFF<Bit>,
    is_next: DFF<Bit>,
    is_data: DFF<Bit>,
    // Third rank: whether the payload is taken, and the request.
    header_before: DFF<Bit>,
    header_first: DFF<Bit>,
    taking: DFF<Bit>,
    answer: DFF<Asked>,
    kind: Signal<Local, Byte>,
    high_kind: Signal<Local, Bits<5>>,
    low_length: Signal<Local, Bits<2>>,
    wide_length: Signal<Local, Bits<16>>,
    four: Signal<Local, Bits<11>>,
    is_ours: Signal<Local, Bit>,
    wide_kind: Signal<Local, Byte>,
    /// One-hot type of the frame: bit `k` is high for type `k`.
    kinds: Signal<Local, Byte>,
    is_behind: Signal<Local, Bit>,
    is_data_of_ours: Signal<Local, Bit>,
    is_of_session: Signal<Local, Bit>,
    one: Signal<Local, Byte>,
    is_wanted: Signal<Local, Bit>,
}

// The kernel holds the types as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    HostFrame::Hello as u8 == 1
        && HostFrame::Open as u8 == 2
        && HostFrame::Rate as u8 == 3
        && HostFrame::Poll as u8 == 4
        && HostFrame::Data as u8 == 5
        && HostFrame::Close as u8 == 6
        && MAX_PAYLOAD == 1024,
    "the frames of this block follow the protocol"
);

impl Logic for FrameJudge {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, kind_low, is_host_kind, is_this_session, names_session, is_none, is_four, is_words);
        dff_setup!(self, clock, distance, has_room, is_fit, is_next, is_data);
        dff_setup!(self, clock, header_before, header_first, taking, answer);
        self.four.next = 4.into();
        self.one.next = 1.into();
        self.takes_payload.next = self.taking.q.val();
        self.asked.next = self.answer.q.val();

        self.kind_low.d.next = bit_cast::<3, 8>(self.head.val().kind);
        self.kind.next = self.head.val().kind;
        self.high_kind.next = self.kind.val().get_bits::<5>(3);
        self.is_host_kind.d.next = !self.high_kind.val().any();
        self.is_this_session.d.next = self.open.val().is_open & (self.head.val().session == self.open.val().number);
        self.names_session.d.next = self.head.val().session.any();
        self.is_none.d.next = !self.head.val().length.any();
        self.is_four.d.next = self.head.val().length == self.four.val();
        self.low_length.next = bit_cast::<2, 11>(self.head.val().length);
        self.is_words.d.next = self.head.val().length.any() & (!self.low_length.val().any());
        self.distance.d.next = self.head.val().number - self.open.val().expected;
        self.wide_length.next = bit_cast::<16, 11>(self.head.val().length);
        self.has_room.d.next = self.free.val() >= self.wide_length.val();

        self.is_data.d.next = false;
        self.is_next.d.next = !self.distance.q.val().any();
        self.is_fit.d.next = self.is_none.q.val() & self.is_host_kind.q.val();
        match self.kind_low.q.val().index() {
            0 => {
                self.is_fit.d.next = false;
            }
            2 => {
                self.is_fit.d.next = self.is_none.q.val() & self.names_session.q.val() & self.is_host_kind.q.val();
            }
            3 => {
                self.is_fit.d.next = self.is_four.q.val() & self.is_host_kind.q.val();
            }
            5 => {
                self.is_fit.d.next = self.is_words.q.val() & self.is_host_kind.q.val();
                self.is_data.d.next = self.is_words.q.val() & self.is_host_kind.q.val();
            }
            7 => {
                self.is_fit.d.next = false;
            }
            _ => {}
        }

        // Decide on the payload once, before its first byte: if room appeared later, the FIFO would get the end
        // of the payload only.
        self.header_before.d.next = self.header_comes.val();
        self.header_first.d.next = self.header_before.q.val();
        if self.header_first.q.val() {
            self.taking.d.next =
                self.is_data.q.val() & self.is_next.q.val() & self.has_room.q.val() & self.is_this_session.q.val();
        }
        // Look at the session again: one that has ended since the header came no longer counts (rule 4).
        self.is_ours.next = self.is_this_session.q.val() & self.open.val().is_open;
        self.is_wanted.next = self.comes.val() & self.is_sound.val() & self.is_fit.q.val();
        self.wide_kind.next = bit_cast::<8, 3>(self.kind_low.q.val());
        self.kinds.next = self.one.val() << self.wide_kind.val();
        self.is_behind.next = self.distance.q.val().get_bit(7);
        self.is_data_of_ours.next = self.is_wanted.val() & self.is_ours.val() & self.kinds.val().get_bit(5);
        self.is_of_session.next = self.kinds.val().get_bit(3)
            | self.kinds.val().get_bit(4)
            | self.kinds.val().get_bit(5)
            | self.kinds.val().get_bit(6);
        self.answer.d.next.hears = self.is_wanted.val();
        self.answer.d.next.hello = self.is_wanted.val() & self.kinds.val().get_bit(1);
        self.answer.d.next.opens = self.is_wanted.val() & self.kinds.val().get_bit(2);
        self.answer.d.next.rate = self.is_wanted.val() & self.is_ours.val() & self.kinds.val().get_bit(3);
        self.answer.d.next.polls = self.is_wanted.val() & self.is_ours.val() & self.kinds.val().get_bit(4);
        self.answer.d.next.closes = self.is_wanted.val() & self.is_ours.val() & self.kinds.val().get_bit(6);
        self.answer.d.next.takes = self.is_data_of_ours.val() & self.taking.q.val();
        self.answer.d.next.repeats = self.is_data_of_ours.val() & self.is_behind.val();
        self.answer.d.next.gap = self.is_data_of_ours.val() & (!self.taking.q.val()) & (!self.is_behind.val());
        self.answer.d.next.no_session = self.is_wanted.val() & self.is_of_session.val() & (!self.open.val().is_open);
        self.answer.d.next.drops = self.comes.val() & (!self.is_wanted.val());
        if self.comes.val() | self.reset.val() {
            self.taking.d.next = false;
        }
        if self.reset.val() {
            self.header_before.d.next = false;
            self.header_first.d.next = false;
        }
    }
}
