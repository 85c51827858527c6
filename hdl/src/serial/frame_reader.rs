//! Reads the frames of the host: header, payload, check sum.
//!
//! 1. Bytes of a frame, and its end, come at least 16 clocks apart.
//! 2. A frame whose header says more than 1,024 bytes has no payload and is not sound.
//! 3. The payload comes out before its check sum is known, so its user must be able to forget the payload again.
//!
//! Latency: 1 clock from a byte, or from `frame_ends`, to the outputs.

use super::crc32::Crc32;
use super::types::{Byte, FrameHead};
use crate::commands::types::Word;
use crate::prelude::*;
use incircle_protocol::{CRC_BYTES, HOST_HEADER_BYTES, MAX_PAYLOAD};

/// The field of the frame to which the next byte belongs.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum ReadState {
    /// Number of the session.
    Session,
    /// Type of the frame.
    Kind,
    /// Number of the frame.
    Number,
    /// The low byte of the length.
    LengthLow,
    /// The high byte of the length.
    LengthHigh,
    /// A byte of the payload.
    Payload,
    /// A byte of the check sum.
    Sum,
    /// A byte too many, or any byte after a length above 1,024.
    Excess,
}

#[derive(LogicBlock, Default)]
pub struct FrameReader {
    pub clock: Signal<In, Clock>,
    /// After a reset the reader awaits a frame.
    pub reset: Signal<In, Bit>,
    /// A byte of a frame, decoded.
    pub data_valid: Signal<In, Bit>,
    pub data: Signal<In, Byte>,
    /// The frame has ended; `is_broken` says that the frame lacks bytes.
    pub frame_ends: Signal<In, Bit>,
    pub is_broken: Signal<In, Bit>,
    /// The header of the frame, valid from `header_comes` until the next frame.
    pub head: Signal<Out, FrameHead>,
    /// The header is complete at this clock.
    pub header_comes: Signal<Out, Bit>,
    /// A byte of the payload.
    pub payload_valid: Signal<Out, Bit>,
    pub payload: Signal<Out, Byte>,
    /// The last four bytes of the payload, the last one on top.
    pub value: Signal<Out, Word>,
    /// A frame has ended; `is_sound` says that its check sum and its length are right.
    pub comes: Signal<Out, Bit>,
    pub is_sound: Signal<Out, Bit>,
    state: DFF<ReadState>,
    header: DFF<FrameHead>,
    /// Bytes of the payload or of the check sum that have yet to come.
    left: DFF<Bits<11>>,
    has_header: DFF<Bit>,
    gives: DFF<Bit>,
    given: DFF<Byte>,
    last_bytes: DFF<Word>,
    is_over: DFF<Bit>,
    is_good: DFF<Bit>,
    crc: Crc32,
    low_length: Signal<Local, Bits<16>>,
    high_length: Signal<Local, Bits<16>>,
    full_length: Signal<Local, Bits<16>>,
    wide_data: Signal<Local, Word>,
    top_byte: Signal<Local, Word>,
    older_bytes: Signal<Local, Word>,
    most: Signal<Local, Bits<16>>,
    eight: Signal<Local, Bits<16>>,
    wide_eight: Signal<Local, Word>,
    three_bytes: Signal<Local, Word>,
    one: Signal<Local, Bits<11>>,
    first_state: Signal<Local, Word>,
    sound_state: Signal<Local, Word>,
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    HOST_HEADER_BYTES == 5
        && MAX_PAYLOAD == 1024
        && CRC_BYTES == 4
        && Crc32::FIRST == 0xffff_ffff
        && Crc32::SOUND == 0xdebb_20e3,
    "the frames of this block follow the protocol"
);

impl Logic for FrameReader {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, header, left, has_header);
        dff_setup!(self, clock, gives, given, last_bytes, is_over, is_good);
        clock!(self, clock, crc);
        self.most.next = 1024.into();
        self.eight.next = 8.into();
        self.wide_eight.next = 8.into();
        self.three_bytes.next = 24.into();
        self.one.next = 1.into();
        self.first_state.next = 0xffff_ffffu64.into();
        self.sound_state.next = 0xdebb_20e3u64.into();
        self.head.next = self.header.q.val();
        self.header_comes.next = self.has_header.q.val();
        self.payload_valid.next = self.gives.q.val();
        self.payload.next = self.given.q.val();
        self.value.next = self.last_bytes.q.val();
        self.comes.next = self.is_over.q.val();
        self.is_sound.next = self.is_good.q.val();

        // The check sum runs over its own bytes too, so that a sound frame ends in one constant state.
        self.crc.sets.next = self.reset.val() | self.frame_ends.val();
        self.crc.start.next = self.first_state.val();
        self.crc.takes.next = self.data_valid.val();
        self.crc.byte_data.next = self.data.val();

        self.low_length.next = bit_cast::<16, 11>(self.header.q.val().length);
        self.high_length.next = bit_cast::<16, 8>(self.data.val()) << self.eight.val();
        self.full_length.next = self.low_length.val() | self.high_length.val();
        self.wide_data.next = bit_cast::<32, 8>(self.data.val());
        self.top_byte.next = self.wide_data.val() << self.three_bytes.val();
        self.older_bytes.next = self.last_bytes.q.val() >> self.wide_eight.val();
        self.given.d.next = self.data.val();
        self.gives.d.next = false;
        self.has_header.d.next = false;
        if self.data_valid.val() {
            self.left.d.next = self.left.q.val() - self.one.val();
            match self.state.q.val() {
                ReadState::Session => {
                    self.header.d.next.session = self.data.val();
                    self.state.d.next = ReadState::Kind;
                }
                ReadState::Kind => {
                    self.header.d.next.kind = self.data.val();
                    self.state.d.next = ReadState::Number;
                }
                ReadState::Number => {
                    self.header.d.next.number = self.data.val();
                    self.state.d.next = ReadState::LengthLow;
                }
                ReadState::LengthLow => {
                    self.header.d.next.length = bit_cast::<11, 8>(self.data.val());
                    self.state.d.next = ReadState::LengthHigh;
                }
                ReadState::LengthHigh => {
                    self.header.d.next.length = self.full_length.val().get_bits::<11>(0);
                    self.left.d.next = self.full_length.val().get_bits::<11>(0);
                    self.has_header.d.next = true;
                    self.state.d.next = ReadState::Payload;
                    if !self.full_length.val().any() {
                        self.left.d.next = 4.into();
                        self.state.d.next = ReadState::Sum;
                    }
                    if self.full_length.val() > self.most.val() {
                        self.has_header.d.next = false;
                        self.state.d.next = ReadState::Excess;
                    }
                }
                ReadState::Payload => {
                    self.gives.d.next = true;
                    self.last_bytes.d.next = self.older_bytes.val() | self.top_byte.val();
                    if self.left.q.val() == self.one.val() {
                        self.left.d.next = 4.into();
                        self.state.d.next = ReadState::Sum;
                    }
                }
                ReadState::Sum => {
                    if !self.left.q.val().any() {
                        self.state.d.next = ReadState::Excess;
                    }
                }
                _ => {
                    self.state.d.next = ReadState::Excess;
                }
            }
        }
        self.is_over.d.next = self.frame_ends.val();
        self.is_good.d.next = (self.state.q.val() == ReadState::Sum)
            & (!self.left.q.val().any())
            & (self.crc.state.val() == self.sound_state.val())
            & (!self.crc.is_busy.val())
            & (!self.is_broken.val());
        if self.frame_ends.val() | self.reset.val() {
            self.state.d.next = ReadState::Session;
        }
        if self.reset.val() {
            self.is_over.d.next = false;
            self.gives.d.next = false;
            self.has_header.d.next = false;
        }
    }
}
