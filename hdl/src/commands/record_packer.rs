//! Packs the records of a read-out into beats of two words without gaps. Their unit is half a word, and a beat has four
//! halves.
//!
//! 1. A whole record brings six halves. Two records fill three beats, and the third beat needs the clock after the
//!    second record, so no record may come in that clock.
//! 2. The vertices of a record are three halves. Four records fill three beats: the first of the four fills none, and
//!    each of the others fills one.
//! 3. With short ids a record brings two halves. Of 12 bits, every fourth record and the last one bring a third: the
//!    rests of up to four records, 4 bits each, that of the last one on top and zeros below that of the first.
//! 4. The halves that the last record leaves follow a clock later as a beat of their own, with as many words as they
//!    need; an odd half is zero.
//! 5. Nothing can stall this block: the user makes sure that there is room for every beat.
//!
//! Latency: 1 clock from a record to the beat that it fills, 2 to the beat with the rest.
//!
//! The vertices of five records, then three whole records. `half0` is the first half of a record, `lowest` that of a
//! beat; the halves are numbered from 1 on:
//! ```text
//! vertices_alone  /^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\____________________
//! starts          /^^\__________________________/^^\_________________
//! comes           ___/^^^^^^^^\__/^^^^^\___________/^^^^^\__/^^\_____
//! half0             .  1  4  7  . 10 13  .  .  .  .  1  7  . 13  .  .
//! valid           _________/^^^^^\__/^^\__/^^\________/^^^^^^^^^^^^^^
//! lowest            .  .  .  1  5  .  9  . 13  .  .  .  1  5  9 13 17
//! last            ________________________/^^\____________________/^^
//! ```

use super::types::{AnswerBeat, BeatHalves, Half, Halves, RecordCount, WORD_PAIR_BITS};
use crate::prelude::*;

/// Number of halves that earlier records left to the next beat.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum KeptHalves {
    /// No half.
    Zero,
    /// One half.
    One,
    /// Two halves.
    Two,
    /// Three halves.
    Three,
    /// As many as the next beat has: no record adds any to it.
    Rest,
}

#[derive(LogicBlock, Default)]
pub struct RecordPacker {
    pub clock: Signal<In, Clock>,
    /// A reset drops everything.
    pub reset: Signal<In, Bit>,
    /// A payload of `count` records begins; `count` is at least 1.
    pub starts: Signal<In, Bit>,
    pub count: Signal<In, RecordCount>,
    /// The payload has the vertices of the records alone.
    pub vertices_alone: Signal<In, Bit>,
    /// Ids are short in such a payload, of 10 bits; with `has_rests`, of 12.
    pub has_short_ids: Signal<In, Bit>,
    pub has_rests: Signal<In, Bit>,
    /// A record comes. With short ids its rest is on top of half 2.
    pub comes: Signal<In, Bit>,
    pub halves: Signal<In, Halves>,
    /// A beat is full or is the last one; held for one clock.
    pub valid: Signal<Out, Bit>,
    pub beat: Signal<Out, AnswerBeat>,
    is_there: DFF<Bit>,
    filled: DFF<AnswerBeat>,
    number: DFF<KeptHalves>,
    kept: DFF<BeatHalves>,
    /// The kept halves are more than two.
    many_are_kept: DFF<Bit>,
    left: DFF<RecordCount>,
    /// One record is left to come, and none is.
    is_last: DFF<Bit>,
    all_came: DFF<Bit>,
    /// The rests of the records of the group so far, and number of these records.
    rests: DFF<Half>,
    in_group: DFF<Bits<2>>,
    earlier: Signal<Local, Half>,
    together: Signal<Local, Half>,
    ends_group: Signal<Local, Bit>,
    is_short: Signal<Local, Bit>,
    brings_two: Signal<Local, Bit>,
    /// The third half that the record brings; zero if there is none.
    third: Signal<Local, Half>,
    fills_beat: Signal<Local, Bit>,
    four: Signal<Local, Half>,
    three_places: Signal<Local, Bits<2>>,
    one_place: Signal<Local, Bits<2>>,
    takes: Signal<Local, Bit>,
    sent: Signal<Local, BeatHalves>,
    sent_bits: Signal<Local, Bits<WORD_PAIR_BITS>>,
    one: Signal<Local, RecordCount>,
    two: Signal<Local, RecordCount>,
}

impl Logic for RecordPacker {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_there, filled, number, kept, many_are_kept);
        dff_setup!(self, clock, left, is_last, all_came, rests, in_group);
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.four.next = 4.into();
        self.three_places.next = 3.into();
        self.one_place.next = 1.into();
        self.valid.next = self.is_there.q.val();
        self.beat.next = self.filled.q.val();

        self.earlier.next = self.rests.q.val() >> self.four.val();
        if !self.in_group.q.val().any() {
            self.earlier.next = 0.into();
        }
        self.together.next = self.halves.val().half2 | self.earlier.val();
        self.ends_group.next = self.is_last.q.val() | (self.in_group.q.val() == self.three_places.val());
        self.is_short.next = self.vertices_alone.val() & self.has_short_ids.val();
        self.brings_two.next = self.is_short.val() & (!(self.has_rests.val() & self.ends_group.val()));
        self.third.next = self.halves.val().half2;
        if self.is_short.val() {
            self.third.next = self.together.val();
        }
        if self.brings_two.val() {
            self.third.next = 0.into();
        }

        // Kept halves come before those of the new record. What does not fit into the beat is kept, with zeros behind
        // it, because it may be the last beat.
        self.sent.next = self.kept.q.val();
        self.kept.d.next.half1 = 0.into();
        self.kept.d.next.half2 = 0.into();
        self.kept.d.next.half3 = 0.into();
        self.many_are_kept.d.next = false;
        self.takes.next = self.comes.val();
        self.is_there.d.next = self.comes.val();
        self.filled.d.next.both = true;
        self.filled.d.next.last = false;
        match self.number.q.val() {
            KeptHalves::Zero => {
                self.sent.next.half0 = self.halves.val().half0;
                self.sent.next.half1 = self.halves.val().half1;
                self.sent.next.half2 = self.halves.val().half2;
                self.sent.next.half3 = self.halves.val().half3;
                self.kept.d.next.half0 = self.halves.val().half4;
                self.kept.d.next.half1 = self.halves.val().half5;
                self.number.d.next = KeptHalves::Two;
                if self.vertices_alone.val() {
                    self.is_there.d.next = false;
                    self.kept.d.next.half0 = self.halves.val().half0;
                    self.kept.d.next.half1 = self.halves.val().half1;
                    self.kept.d.next.half2 = self.third.val();
                    self.many_are_kept.d.next = true;
                    self.number.d.next = KeptHalves::Three;
                    if self.brings_two.val() {
                        self.many_are_kept.d.next = false;
                        self.number.d.next = KeptHalves::Two;
                    }
                }
            }
            KeptHalves::One => {
                self.sent.next.half1 = self.halves.val().half0;
                self.sent.next.half2 = self.halves.val().half1;
                self.sent.next.half3 = self.third.val();
                self.filled.d.next.last = self.is_last.q.val();
                self.number.d.next = KeptHalves::Zero;
                if self.brings_two.val() {
                    self.is_there.d.next = false;
                    self.kept.d.next.half0 = self.kept.q.val().half0;
                    self.kept.d.next.half1 = self.halves.val().half0;
                    self.kept.d.next.half2 = self.halves.val().half1;
                    self.many_are_kept.d.next = true;
                    self.number.d.next = KeptHalves::Three;
                }
            }
            KeptHalves::Two => {
                self.sent.next.half2 = self.halves.val().half0;
                self.sent.next.half3 = self.halves.val().half1;
                self.kept.d.next.half0 = self.third.val();
                self.number.d.next = KeptHalves::One;
                if self.brings_two.val() {
                    self.filled.d.next.last = self.is_last.q.val();
                    self.number.d.next = KeptHalves::Zero;
                }
                if !self.vertices_alone.val() {
                    self.kept.d.next.half1 = self.halves.val().half3;
                    self.kept.d.next.half2 = self.halves.val().half4;
                    self.kept.d.next.half3 = self.halves.val().half5;
                    self.many_are_kept.d.next = true;
                    self.number.d.next = KeptHalves::Rest;
                }
            }
            KeptHalves::Three => {
                self.sent.next.half3 = self.halves.val().half0;
                self.kept.d.next.half0 = self.halves.val().half1;
                self.kept.d.next.half1 = self.third.val();
                self.number.d.next = KeptHalves::Two;
                if self.brings_two.val() {
                    self.number.d.next = KeptHalves::One;
                }
            }
            _ => {
                self.takes.next = true;
                self.is_there.d.next = true;
                self.filled.d.next.both = self.many_are_kept.q.val();
                self.filled.d.next.last = self.all_came.q.val();
                self.number.d.next = KeptHalves::Zero;
            }
        }
        // The last record leaves nothing behind the beat that it fills.
        self.fills_beat.next = ((self.number.q.val() == KeptHalves::One) & (!self.brings_two.val()))
            | ((self.number.q.val() == KeptHalves::Two) & self.brings_two.val());
        self.sent_bits.next = self.sent.val().into();
        self.filled.d.next.low = self.sent_bits.val().get_bits::<32>(0);
        self.filled.d.next.high = self.sent_bits.val().get_bits::<32>(32);
        if self.comes.val() {
            self.left.d.next = self.left.q.val() - self.one.val();
            self.is_last.d.next = self.left.q.val() == self.two.val();
            self.all_came.d.next = self.is_last.q.val();
            self.rests.d.next = self.together.val();
            self.in_group.d.next = self.in_group.q.val() + self.one_place.val();
            if self.is_last.q.val() & (!self.fills_beat.val()) {
                self.number.d.next = KeptHalves::Rest;
            }
        }
        if !self.takes.val() {
            self.number.d.next = self.number.q.val();
            self.kept.d.next = self.kept.q.val();
        }
        if self.starts.val() {
            self.in_group.d.next = 0.into();
            self.left.d.next = self.count.val();
            self.is_last.d.next = self.count.val() == self.one.val();
        }
        if self.reset.val() {
            self.is_there.d.next = false;
            self.number.d.next = KeptHalves::Zero;
        }
    }
}
