//! Decodes COBS: bytes of the line in, the bytes of frames and their ends out.
//!
//! 1. A zero ends a frame. Two zeros with nothing between them are no frame.
//! 2. A frame is broken if it ends inside a piece or if the line lost one of its bytes. Noise
//!    between frames changes nothing.
//!
//! Latency: 1 clock. A byte of the line yields at most one byte of a frame: a length byte yields the
//! zero before its piece.
//!
//! The frame 11 0 22, then a frame that ends too early; the numbers of the wave are decimal:
//! ```text
//! byte_valid      ___/^^\__/^^^^^^^^^^^^^^\__/^^^^^^^^\___________
//! byte_data         .  2  . 11  2 22  0  0  .  5 33  0  .  .  .  .
//! data_valid      ____________/^^^^^^^^\___________/^^\___________
//! data              .  .  .  . 11  0 22  .  .  .  . 33  .  .  .  .
//! frame_ends      _____________________/^^\___________/^^\________
//! is_broken       ____________________________________/^^\________
//! ```

use super::types::Byte;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct CobsDecoder {
    pub clock: Signal<In, Clock>,
    /// After a reset the decoder awaits a frame.
    pub reset: Signal<In, Bit>,
    /// A byte from the line.
    pub byte_valid: Signal<In, Bit>,
    pub byte_data: Signal<In, Byte>,
    /// The line lost a byte.
    pub noise: Signal<In, Bit>,
    /// A byte of a frame.
    pub data_valid: Signal<Out, Bit>,
    pub data: Signal<Out, Byte>,
    /// The frame has ended; `is_broken` is valid at the same time and says that the frame lacks bytes.
    pub frame_ends: Signal<Out, Bit>,
    pub is_broken: Signal<Out, Bit>,
    /// Bytes of the line before the next length byte.
    left: DFF<Byte>,
    in_frame: DFF<Bit>,
    /// The piece stands for a zero behind it too, if another piece follows.
    owes_zero: DFF<Bit>,
    lacks: DFF<Bit>,
    gives: DFF<Bit>,
    value: DFF<Byte>,
    ends: DFF<Bit>,
    ends_broken: DFF<Bit>,
    is_end: Signal<Local, Bit>,
    is_length: Signal<Local, Bit>,
    one: Signal<Local, Byte>,
    longest: Signal<Local, Byte>,
}

impl Logic for CobsDecoder {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left, in_frame, owes_zero, lacks, gives, value, ends, ends_broken);
        self.one.next = 1.into();
        self.longest.next = 255.into();
        self.data_valid.next = self.gives.q.val();
        self.data.next = self.value.q.val();
        self.frame_ends.next = self.ends.q.val();
        self.is_broken.next = self.ends_broken.q.val();

        self.is_end.next = !self.byte_data.val().any();
        self.is_length.next = !self.left.q.val().any();
        self.gives.d.next = false;
        self.ends.d.next = false;
        if self.noise.val() {
            self.lacks.d.next = self.in_frame.q.val();
        }
        if self.byte_valid.val() {
            if self.is_end.val() {
                self.ends.d.next = self.in_frame.q.val();
                self.ends_broken.d.next = self.lacks.q.val() | (!self.is_length.val());
                self.in_frame.d.next = false;
                self.owes_zero.d.next = false;
                self.lacks.d.next = false;
                self.left.d.next = 0.into();
            } else {
                self.left.d.next = self.left.q.val() - self.one.val();
                self.value.d.next = self.byte_data.val();
                self.gives.d.next = true;
                if self.is_length.val() {
                    self.left.d.next = self.byte_data.val() - self.one.val();
                    self.value.d.next = 0.into();
                    self.gives.d.next = self.owes_zero.q.val();
                    self.owes_zero.d.next = self.byte_data.val() != self.longest.val();
                    self.in_frame.d.next = true;
                }
            }
        }
        if self.reset.val() {
            self.left.d.next = 0.into();
            self.in_frame.d.next = false;
            self.owes_zero.d.next = false;
            self.lacks.d.next = false;
            self.gives.d.next = false;
            self.ends.d.next = false;
        }
    }
}
