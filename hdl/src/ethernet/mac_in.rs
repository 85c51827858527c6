//! Takes Ethernet frames from the pins of a PHY, as GMII gives them, and says at their end whether they are sound.
//!
//! 1. A frame begins behind a byte D5. Only bytes 55 may stand before it, also none; otherwise nothing of the frame
//!    comes out.
//! 2. The check sum comes out too, as the last four bytes. Of a frame that is too long, bytes 0 to 1,517 come out.
//! 3. A frame is sound if it has 64 to 1,518 bytes with its check sum, the check sum is right and the PHY saw no error.
//! 4. `begins`, a byte and `ends` never come at the same clock. The bytes of a frame come before its end is judged, so
//!    their user must be able to forget them.
//!
//! Latency: 1 clock from a byte of the PHY to the byte, and from the end of a frame to `ends`.
//!
//! A frame with three bytes, which is not sound:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8
//! data_valid      ___/^^^^^^^^^^^^^^\________
//! begins          _________/^^\______________
//! byte_valid      ____________/^^^^^^^^\_____
//! place             .  .  .  .  0  1  2  .  .
//! ends            _____________________/^^\__
//! is_sound        ___________________________
//! ```
//! Source: IEEE 802.3, clauses 3 and 35.

use super::byte_crc::ByteCrc;
use super::types::{Byte, Place};
use crate::commands::types::Word;
use crate::prelude::*;

/// The part of a frame that the receiver awaits from the PHY.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum FrameState {
    /// The beginning of a frame.
    Preamble,
    /// A byte of a frame.
    Body,
    /// The end of what is no frame.
    Skip,
}

#[derive(LogicBlock, Default)]
pub struct MacIn {
    pub clock: Signal<In, Clock>,
    /// After a reset the block awaits the end of what the PHY is giving, and then a frame.
    pub reset: Signal<In, Bit>,
    /// The PHY gives a byte, or reports an error.
    pub data_valid: Signal<In, Bit>,
    pub data_error: Signal<In, Bit>,
    pub data: Signal<In, Byte>,
    /// A frame begins; its first byte comes next.
    pub begins: Signal<Out, Bit>,
    /// A byte of the frame, and its place, which stays until the next byte.
    pub byte_valid: Signal<Out, Bit>,
    pub byte_data: Signal<Out, Byte>,
    pub place: Signal<Out, Place>,
    /// The frame has ended.
    pub ends: Signal<Out, Bit>,
    pub is_sound: Signal<Out, Bit>,
    state: DFF<FrameState>,
    /// Number of bytes of the frame that have come.
    count: DFF<Place>,
    is_bad: DFF<Bit>,
    starts: DFF<Bit>,
    gives: DFF<Bit>,
    given: DFF<Byte>,
    given_place: DFF<Place>,
    is_over: DFF<Bit>,
    is_good: DFF<Bit>,
    crc: ByteCrc,
    one: Signal<Local, Place>,
    longest: Signal<Local, Place>,
    /// The part of the count that only a frame of 64 bytes or more has.
    beyond: Signal<Local, Bits<5>>,
    preamble: Signal<Local, Byte>,
    delimiter: Signal<Local, Byte>,
    sound_state: Signal<Local, Word>,
    has_room: Signal<Local, Bit>,
}

const _: () = assert!(ByteCrc::SOUND == 0xdebb_20e3, "the kernel of this block holds the state as a literal");

impl Logic for MacIn {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, count, is_bad, starts, gives, given, given_place, is_over, is_good);
        clock!(self, clock, crc);
        self.one.next = 1.into();
        self.longest.next = 1518.into();
        self.beyond.next = self.count.q.val().get_bits::<5>(6);
        self.preamble.next = 0x55.into();
        self.delimiter.next = 0xd5.into();
        self.sound_state.next = 0xdebb_20e3u64.into();
        self.begins.next = self.starts.q.val();
        self.byte_valid.next = self.gives.q.val();
        self.byte_data.next = self.given.q.val();
        self.place.next = self.given_place.q.val();
        self.ends.next = self.is_over.q.val();
        self.is_sound.next = self.is_good.q.val();

        self.crc.start.next = 0xffff_ffffu64.into();
        self.crc.sets.next = self.state.q.val() != FrameState::Body;
        self.crc.takes.next = self.data_valid.val();
        self.crc.byte_data.next = self.data.val();
        self.has_room.next = self.count.q.val() != self.longest.val();
        self.starts.d.next = false;
        self.gives.d.next = false;
        self.is_over.d.next = false;
        self.is_good.d.next = false;
        match self.state.q.val() {
            FrameState::Preamble => {
                self.count.d.next = 0.into();
                self.is_bad.d.next = false;
                if self.data_valid.val() {
                    if self.data_error.val() | (self.data.val() != self.preamble.val()) {
                        self.state.d.next = FrameState::Skip;
                    }
                    if (!self.data_error.val()) & (self.data.val() == self.delimiter.val()) {
                        self.starts.d.next = true;
                        self.state.d.next = FrameState::Body;
                    }
                }
            }
            FrameState::Body => {
                if self.data_valid.val() {
                    self.is_bad.d.next = self.is_bad.q.val() | self.data_error.val() | (!self.has_room.val());
                    if self.has_room.val() {
                        self.gives.d.next = true;
                        self.given.d.next = self.data.val();
                        self.given_place.d.next = self.count.q.val();
                        self.count.d.next = self.count.q.val() + self.one.val();
                    }
                } else {
                    self.is_over.d.next = true;
                    self.is_good.d.next = (!self.is_bad.q.val())
                        & self.beyond.val().any()
                        & (self.crc.state.val() == self.sound_state.val());
                    self.state.d.next = FrameState::Preamble;
                }
            }
            _ => {
                if !self.data_valid.val() {
                    self.state.d.next = FrameState::Preamble;
                }
            }
        }
        if self.reset.val() {
            self.state.d.next = FrameState::Skip;
            self.starts.d.next = false;
            self.gives.d.next = false;
            self.is_over.d.next = false;
        }
    }
}
