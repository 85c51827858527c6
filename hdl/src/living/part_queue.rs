//! The answer to a run: its head, and the parts in the order in which their items end.
//!
//! 1. A part has as many beats as the head says, of two words each, and one beat leaves in each clock.
//! 2. An item begins only if there is a place for its part (`has_room`), so a part that comes always has one. The place
//!    is free again when the last beat of the part is on offer.
//! 3. `head` comes while no answer is under way, and before the first part of its answer.
//! 4. A beat on offer stays until it is taken; `response_valid` does not wait for `response_ready`. A reset drops the
//!    answer.
//!
//! Latency: 2 clocks from `head` to its beat, and from `came` to the first beat of the part.
//!
//! An answer of one part, whose head has to wait for the reader:
//! ```text
//! head            /^^\_____________________________
//! begins          ___/^^\__________________________
//! came            _________/^^\____________________
//! response_valid  ______/^^^^^^^^^^^^^^^^^\________
//! response_ready  _______________/^^^^^^^^^^^^^^^^^
//! response_last   _____________________/^^\________
//! low               .  . 85 85 85 85  6  7  .  .  .
//! is_over         /^^\____________________/^^^^^^^^
//! ```

use super::part_beat::PartBeat;
use super::types::{BeatNumber, Part, PartCame, RunHead, PART_ADDRESS_BITS, PART_BITS};
use crate::commands::types::Word;
use crate::commands::{AnswerBeat, AnswerSource, WordPair, WORD_PAIR_BITS};
use crate::leaf::{Fifo, Unpack};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct PartQueue {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The head of an answer, which comes before the first item begins.
    pub head: Signal<In, RunHead>,
    /// An item begins at this edge, which takes a place; only with `has_room`. A user who cannot tell whether another
    /// item takes a place in the next clock waits until two are free (`has_two_places`).
    pub begins: Signal<In, Bit>,
    pub has_room: Signal<Out, Bit>,
    pub has_two_places: Signal<Out, Bit>,
    /// The part of an item that ends.
    pub came: Signal<In, PartCame>,
    pub response: AnswerSource,
    /// The last word of the last answer has been taken.
    pub is_over: Signal<Out, Bit>,
    parts: Fifo<PART_ADDRESS_BITS, PART_BITS>,
    first: Unpack<Part, PART_BITS>,
    kept: DFF<PartCame>,
    /// Number of places that are taken; whether all are, and whether at most one is free.
    places: DFF<Bits<6>>,
    is_full: DFF<Bit>,
    is_almost_full: DFF<Bit>,
    announced: DFF<RunHead>,
    head_is_due: DFF<Bit>,
    /// Number of parts that are still to leave, and whether there are any.
    left: DFF<Word>,
    some_are_left: DFF<Bit>,
    /// Number of the next beat in its part.
    beat: DFF<BeatNumber>,
    valid: DFF<Bit>,
    offered: DFF<AnswerBeat>,
    words: PartBeat,
    part: Signal<Local, Part>,
    part_bits: Signal<Local, Bits<PART_BITS>>,
    pair: Signal<Local, WordPair>,
    pair_bits: Signal<Local, Bits<WORD_PAIR_BITS>>,
    loads: Signal<Local, Bit>,
    loads_head: Signal<Local, Bit>,
    loads_part: Signal<Local, Bit>,
    leaves: Signal<Local, Bit>,
    ends_part: Signal<Local, Bit>,
    is_last: Signal<Local, Bit>,
    next_places: Signal<Local, Bits<6>>,
    one: Signal<Local, Word>,
    one_beat: Signal<Local, BeatNumber>,
    one_place: Signal<Local, Bits<6>>,
    all_places: Signal<Local, Bits<6>>,
    last_place: Signal<Local, Bits<6>>,
}

// The kernel holds the number of places as a literal, because rust-hdl allows no constants there.
const _: () = assert!(PART_ADDRESS_BITS == 5, "the kernel of this block is for 32 parts");

impl Logic for PartQueue {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            kept,
            places,
            is_full,
            is_almost_full,
            announced,
            head_is_due,
            left,
            some_are_left,
            beat
        );
        dff_setup!(self, clock, valid, offered);
        clock!(self, clock, parts);
        self.one.next = 1.into();
        self.one_beat.next = 1.into();
        self.one_place.next = 1.into();
        self.all_places.next = 32.into();
        self.last_place.next = 31.into();
        self.pair.next.low = self.offered.q.val().low;
        self.pair.next.high = self.offered.q.val().high;
        self.pair_bits.next = self.pair.val().into();
        self.response.valid.next = self.valid.q.val();
        self.response.data.next = self.pair_bits.val();
        self.response.both.next = self.offered.q.val().both;
        self.response.last.next = self.offered.q.val().last;
        self.loads.next = (!self.valid.q.val()) | self.response.ready.val();
        self.is_over.next = (!self.head_is_due.q.val()) & (!self.some_are_left.q.val()) & (!self.valid.q.val());
        self.has_room.next = !self.is_full.q.val();
        self.has_two_places.next = !self.is_almost_full.q.val();

        // The fields of a part settle late in their clock, so a register keeps them before the memory does.
        self.kept.d.next = self.came.val();
        self.part.next = self.kept.q.val().part;
        self.part_bits.next = self.part.val().into();
        self.parts.reset.next = self.reset.val();
        self.parts.push.next = self.kept.q.val().valid;
        self.parts.push_data.next = self.part_bits.val();
        self.first.bits.next = self.parts.data.val();

        self.loads_head.next = self.loads.val() & self.head_is_due.q.val();
        self.loads_part.next = self.loads.val() & (!self.head_is_due.q.val()) & self.parts.valid.val();
        self.ends_part.next = self.beat.q.val() == self.announced.q.val().last_beat;
        self.leaves.next = self.loads_part.val() & self.ends_part.val();
        self.parts.pop.next = self.leaves.val();
        self.is_last.next = self.left.q.val() == self.one.val();
        self.words.part.next = self.first.value.val();
        self.words.beat.next = self.beat.q.val();
        self.valid.d.next = self.valid.q.val() & (!self.loads.val());
        if self.loads_head.val() {
            self.valid.d.next = true;
            self.head_is_due.d.next = false;
            self.offered.d.next.low = self.announced.q.val().header;
            self.offered.d.next.high = self.announced.q.val().length;
            self.offered.d.next.both = true;
            self.offered.d.next.last = !self.some_are_left.q.val();
        }
        if self.loads_part.val() {
            self.valid.d.next = true;
            self.beat.d.next = self.beat.q.val() + self.one_beat.val();
            self.offered.d.next.low = self.words.low.val();
            self.offered.d.next.high = self.words.high.val();
            self.offered.d.next.last = self.ends_part.val() & self.is_last.val();
        }
        if self.leaves.val() {
            self.beat.d.next = 0.into();
            self.left.d.next = self.left.q.val() - self.one.val();
            self.some_are_left.d.next = !self.is_last.val();
        }
        if self.head.val().valid {
            self.announced.d.next = self.head.val();
            self.head_is_due.d.next = true;
            self.left.d.next = self.head.val().parts;
            self.some_are_left.d.next = self.head.val().parts.any();
        }

        self.next_places.next = self.places.q.val();
        if self.begins.val() & (!self.leaves.val()) {
            self.next_places.next = self.places.q.val() + self.one_place.val();
        }
        if self.leaves.val() & (!self.begins.val()) {
            self.next_places.next = self.places.q.val() - self.one_place.val();
        }
        self.places.d.next = self.next_places.val();
        self.is_full.d.next = self.next_places.val() == self.all_places.val();
        self.is_almost_full.d.next =
            self.next_places.val().get_bit(5) | (self.next_places.val() == self.last_place.val());
        if self.reset.val() {
            self.kept.d.next.valid = false;
            self.places.d.next = 0.into();
            self.is_full.d.next = false;
            self.is_almost_full.d.next = false;
            self.head_is_due.d.next = false;
            self.some_are_left.d.next = false;
            self.beat.d.next = 0.into();
            self.valid.d.next = false;
        }
    }
}
