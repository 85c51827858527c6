//! Puts the check sums into a datagram to the host: its own, and at the end of an answer the one of all its words.
//!
//! 1. A byte comes a clock behind its place. The bytes before the header, the receiver's addresses, belong to no sum.
//!    While a datagram waits for words, `at` stays at the place of the next byte.
//! 2. A sum goes out low byte first. While it does, each byte of it is taken into the sum as well, which moves the next
//!    one down: so a sum needs no choice among four bytes.
//!
//! 3. With `is_cut` no further byte goes out, and `out_drops` follows a clock later. `is_busy` is high until both are
//!    over, so that no datagram begins before.
//!
//! Latency: 2 clocks from a place to the byte that goes out.
//!
//! The last bytes of a datagram, and a datagram that is cut after three bytes:
//! ```text
//! moves           /^^^^^^^^^^^^^^^^^\___________/^^^^^^^^^^^\_____
//! at.part           0  0  5  5  5  5  .  .  .  .  0  0  0  0  .  .
//! is_last         _______________/^^\_____________________________
//! is_cut          _______________________________________/^^\_____
//! out_valid       /^^^^^^^^^^^^^^^^^^^^^^^\___________/^^^^^\_____
//! out_is_last     _____________________/^^  .  .  .  .______  .  .
//! out_drops       __________________________________________/^^\__
//! is_busy         /^^^^^^^^^^^^^^^^^^^^^^^\________/^^^^^^^^^^^\__
//! ```

use super::types::PartIndex;
use crate::ethernet::ByteCrc;
use crate::prelude::*;
use crate::serial::types::Byte;

#[derive(LogicBlock, Default)]
pub struct DatagramSums {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A byte passes at this place; it is the last one of the datagram.
    pub moves: Signal<In, Bit>,
    pub at: Signal<In, PartIndex>,
    pub is_last: Signal<In, Bit>,
    /// The byte of the place in the clock before.
    pub byte_data: Signal<In, Byte>,
    /// No answer has begun: the sum of an answer begins anew.
    pub awaits: Signal<In, Bit>,
    /// The datagram under way is dropped, with all bytes that have not gone out.
    pub is_cut: Signal<In, Bit>,
    /// The bytes for the port. With `out_drops` it forgets those of a datagram that has not ended.
    pub out_valid: Signal<Out, Bit>,
    pub out_data: Signal<Out, Byte>,
    pub out_is_last: Signal<Out, Bit>,
    pub out_drops: Signal<Out, Bit>,
    /// A byte is on its way through the block.
    pub is_busy: Signal<Out, Bit>,
    moved: DFF<Bit>,
    is_receiver: DFF<Bit>,
    is_word: DFF<Bit>,
    is_digest: DFF<Bit>,
    is_sum: DFF<Bit>,
    was_last: DFF<Bit>,
    leaves: DFF<Bit>,
    leaving: DFF<Byte>,
    leaves_last: DFF<Bit>,
    dropped: DFF<Bit>,
    frame_sum: ByteCrc,
    answer_sum: ByteCrc,
    place: Signal<Local, Bits<7>>,
    digest_low: Signal<Local, Byte>,
    sum_low: Signal<Local, Byte>,
    body: Signal<Local, Byte>,
    all: Signal<Local, Byte>,
    no_part: Signal<Local, Bit>,
}

const _: () = assert!(ByteCrc::FIRST == 0xffff_ffff, "the literal of this block follows the check sum");

impl Logic for DatagramSums {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, moved, is_receiver, is_word, is_digest, is_sum, was_last);
        dff_setup!(self, clock, leaves, leaving, leaves_last, dropped);
        clock!(self, clock, frame_sum, answer_sum);
        self.all.next = 0xff.into();
        self.place.next = self.at.val().index;
        self.no_part.next = !self.at.val().part.any();
        self.moved.d.next = self.moves.val() & (!self.is_cut.val());
        self.was_last.d.next = self.is_last.val();
        self.is_receiver.d.next = self.no_part.val()
            & (!self.place.val().get_bit(4))
            & (!(self.place.val().get_bit(3) & self.place.val().get_bit(2)));
        self.is_word.d.next = false;
        self.is_sum.d.next = false;
        self.is_digest.d.next = false;
        match self.at.val().part.index() {
            4 => {
                self.is_word.d.next = true;
            }
            5 => {
                self.is_sum.d.next = true;
            }
            7 => {
                self.is_digest.d.next = true;
            }
            _ => {}
        }

        self.digest_low.next = self.answer_sum.state.val().get_bits::<8>(0);
        self.sum_low.next = self.frame_sum.state.val().get_bits::<8>(0);
        self.body.next = self.byte_data.val();
        self.answer_sum.byte_data.next = self.byte_data.val();
        if self.is_digest.q.val() {
            self.body.next = self.digest_low.val() ^ self.all.val();
            self.answer_sum.byte_data.next = self.digest_low.val();
        }
        self.answer_sum.takes.next = self.moved.q.val() & (self.is_word.q.val() | self.is_digest.q.val());
        self.answer_sum.sets.next = self.awaits.val();
        self.answer_sum.start.next = 0xffff_ffffu64.into();
        self.frame_sum.byte_data.next = self.body.val();
        self.leaving.d.next = self.body.val();
        if self.is_sum.q.val() {
            self.frame_sum.byte_data.next = self.sum_low.val();
            self.leaving.d.next = self.sum_low.val() ^ self.all.val();
        }
        self.frame_sum.takes.next = self.moved.q.val();
        self.frame_sum.sets.next = self.is_receiver.q.val();
        self.frame_sum.start.next = 0xffff_ffffu64.into();
        self.leaves.d.next = self.moved.q.val() & (!self.is_cut.val());
        self.leaves_last.d.next = self.was_last.q.val();
        self.dropped.d.next = self.is_cut.val();
        self.out_valid.next = self.leaves.q.val();
        self.out_data.next = self.leaving.q.val();
        self.out_is_last.next = self.leaves_last.q.val();
        self.out_drops.next = self.dropped.q.val();
        self.is_busy.next = self.moved.q.val() | self.leaves.q.val() | self.dropped.q.val();
        if self.reset.val() {
            self.moved.d.next = false;
            self.leaves.d.next = false;
            self.dropped.d.next = false;
        }
    }
}
