//! Encodes frames in reverse COBS, so that no byte of a frame is zero and a zero can end it, without a
//! buffer for a piece.
//!
//! 1. A byte other than zero goes out as it comes. A zero, and the end of the frame, become a length byte: one more
//!    than the number of bytes since the last length byte. After 254 bytes without a zero the length byte 255 goes out
//!    and stands for no zero.
//! 2. A frame that is cut ends with a zero at once, without a length byte. The host drops the frame, because its
//!    check sum is missing.
//! 3. `byte_valid` and `byte_data` depend combinationally on the frame's ports, and `data_ready` on `byte_ready`.
//!
//! Latency: none (combinational) for a byte.
//!
//! The frame 11 0 22, sent to a line that takes a byte every second clock; the numbers of the wave are decimal:
//! ```text
//! data_valid      ___/^^^^^^^^^^^^^^^^^\___________
//! data              . 11 11  0  0 22 22  .  .  .  .
//! data_ready      ______/^^\__/^^\__/^^\___________
//! ends            _____________________/^^^^^^^^^^^
//! byte_ready      /^^\__/^^\__/^^\__/^^\__/^^\__/^^
//! byte_data         .  . 11  .  2  . 22  .  2  .  0
//! ended           ______________________________/^^
//! ```

use super::types::Byte;
use crate::prelude::*;

/// The byte that goes out next.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum EncodeState {
    /// A byte of the frame, or the length byte that replaces it.
    Frame,
    /// The length byte 255 behind 254 bytes.
    Longest,
    /// The zero that ends the frame.
    Zero,
}

#[derive(LogicBlock, Default)]
pub struct CobsEncoder {
    pub clock: Signal<In, Clock>,
    /// After a reset the encoder awaits a frame.
    pub reset: Signal<In, Bit>,
    /// The bytes of a frame.
    pub data_valid: Signal<In, Bit>,
    pub data_ready: Signal<Out, Bit>,
    pub data: Signal<In, Byte>,
    /// No byte follows; held until `ended`. With `cuts` the frame is left invalid.
    pub ends: Signal<In, Bit>,
    pub cuts: Signal<In, Bit>,
    /// The line takes the zero behind the frame at this edge.
    pub ended: Signal<Out, Bit>,
    /// Bytes for the line.
    pub byte_valid: Signal<Out, Bit>,
    pub byte_ready: Signal<In, Bit>,
    pub byte_data: Signal<Out, Byte>,
    state: DFF<EncodeState>,
    /// One more than the number of bytes since the last length byte.
    length: DFF<Byte>,
    is_zero: Signal<Local, Bit>,
    is_frame: Signal<Local, Bit>,
    one: Signal<Local, Byte>,
    last_length: Signal<Local, Byte>,
}

impl Logic for CobsEncoder {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, length);
        self.one.next = 1.into();
        self.last_length.next = 254.into();
        self.is_zero.next = !self.data.val().any();
        self.is_frame.next = self.state.q.val() == EncodeState::Frame;
        self.data_ready.next = self.is_frame.val() & self.byte_ready.val();
        self.ended.next = (self.state.q.val() == EncodeState::Zero) & self.byte_ready.val();
        self.byte_valid.next = true;
        self.byte_data.next = 0.into();
        match self.state.q.val() {
            EncodeState::Frame => {
                self.byte_valid.next = self.data_valid.val() | (self.ends.val() & (!self.cuts.val()));
                self.byte_data.next = self.data.val();
                if (!self.data_valid.val()) | self.is_zero.val() {
                    self.byte_data.next = self.length.q.val();
                }
                if self.data_valid.val() & self.byte_ready.val() {
                    self.length.d.next = self.length.q.val() + self.one.val();
                    if self.is_zero.val() {
                        self.length.d.next = 1.into();
                    } else {
                        if self.length.q.val() == self.last_length.val() {
                            self.state.d.next = EncodeState::Longest;
                        }
                    }
                }
                if (!self.data_valid.val()) & self.ends.val() & (self.byte_ready.val() | self.cuts.val()) {
                    self.state.d.next = EncodeState::Zero;
                }
            }
            EncodeState::Longest => {
                self.byte_data.next = 255.into();
                self.length.d.next = 1.into();
                if self.byte_ready.val() {
                    self.state.d.next = EncodeState::Frame;
                }
            }
            EncodeState::Zero => {
                self.length.d.next = 1.into();
                if self.byte_ready.val() {
                    self.state.d.next = EncodeState::Frame;
                }
            }
            _ => {
                self.state.d.next = EncodeState::Frame;
            }
        }
        if self.reset.val() {
            self.state.d.next = EncodeState::Frame;
            self.length.d.next = 1.into();
        }
    }
}
