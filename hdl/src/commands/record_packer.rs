//! Packs the records of a read-out into beats of two words without gaps. Their unit is half a word, and a beat has four
//! halves.
//!
//! 1. A whole record brings six halves. Two records fill three beats, and the third beat needs the clock after the
//!    second record, so no record may come in that clock.
//! 2. The vertices of a record are three halves. Four records fill three beats: the first of the four fills none, and
//!    each of the others fills one.
//! 3. With short ids a record brings two halves. Of 12 bits, each record that ends a group of up to eight brings two
//!    more: the rests of the group, as [`RecordGroup`] collects them.
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

use super::kept_halves::{KeptHalves, KeptNumber};
use super::record_group::RecordGroup;
use super::types::{AnswerBeat, BeatHalves, Half, Halves, RecordCount, WORD_PAIR_BITS};
use crate::prelude::*;

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
    /// The payload has vertices alone, with short ids of 10 bits; with `has_rests`, of 12.
    pub has_short_ids: Signal<In, Bit>,
    pub has_rests: Signal<In, Bit>,
    /// A record comes. With short ids its first two halves count, and with those of 12 bits its rest.
    pub comes: Signal<In, Bit>,
    pub halves: Signal<In, Halves>,
    pub rest: Signal<In, Bits<4>>,
    /// A beat is full or is the last one; held for one clock.
    pub valid: Signal<Out, Bit>,
    pub beat: Signal<Out, AnswerBeat>,
    is_there: DFF<Bit>,
    filled: DFF<AnswerBeat>,
    kept: DFF<BeatHalves>,
    number: KeptHalves,
    group: RecordGroup,
    /// The record brings the rests of its group.
    brings_rests: Signal<Local, Bit>,
    /// The third and the fourth half that the record brings.
    third: Signal<Local, Half>,
    fourth: Signal<Local, Half>,
    sent: Signal<Local, BeatHalves>,
    sent_bits: Signal<Local, Bits<WORD_PAIR_BITS>>,
}

impl Logic for RecordPacker {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_there, filled, kept);
        clock!(self, clock, number, group);
        self.valid.next = self.is_there.q.val();
        self.beat.next = self.filled.q.val();
        self.group.starts.next = self.starts.val();
        self.group.count.next = self.count.val();
        self.group.comes.next = self.comes.val();
        self.group.rest.next = self.rest.val();
        self.brings_rests.next = self.has_rests.val() & self.group.ends_group.val();
        self.number.reset.next = self.reset.val();
        self.number.vertices_alone.next = self.vertices_alone.val();
        self.number.has_short_ids.next = self.has_short_ids.val();
        self.number.comes.next = self.comes.val();
        self.number.is_last.next = self.group.is_last.val();
        self.number.brings_rests.next = self.brings_rests.val();
        self.number.all_came.next = self.group.all_came.val();
        self.is_there.d.next = self.number.fills.val();
        self.filled.d.next.both = self.number.both.val();
        self.filled.d.next.last = self.number.last.val();

        self.third.next = self.halves.val().half2;
        self.fourth.next = self.halves.val().half3;
        if self.has_short_ids.val() {
            self.third.next = self.group.rests.val().get_bits::<16>(0);
            self.fourth.next = self.group.rests.val().get_bits::<16>(16);
        }
        // Kept halves come before those of the new record. What does not fit into the beat is kept, with zeros behind
        // it, because it may be the last beat. Short ids leave no half or two, so beside one half or three the third
        // half is always that of the record, not that of the rests.
        self.sent.next = self.kept.q.val();
        self.kept.d.next.half1 = 0.into();
        self.kept.d.next.half2 = 0.into();
        self.kept.d.next.half3 = 0.into();
        match self.number.number.val() {
            KeptNumber::Zero => {
                self.sent.next.half0 = self.halves.val().half0;
                self.sent.next.half1 = self.halves.val().half1;
                self.sent.next.half2 = self.third.val();
                self.sent.next.half3 = self.fourth.val();
                self.kept.d.next.half0 = self.halves.val().half4;
                self.kept.d.next.half1 = self.halves.val().half5;
                if self.vertices_alone.val() {
                    self.kept.d.next.half0 = self.halves.val().half0;
                    self.kept.d.next.half1 = self.halves.val().half1;
                    if !self.has_short_ids.val() {
                        self.kept.d.next.half2 = self.halves.val().half2;
                    }
                }
            }
            KeptNumber::One => {
                self.sent.next.half1 = self.halves.val().half0;
                self.sent.next.half2 = self.halves.val().half1;
                self.sent.next.half3 = self.halves.val().half2;
            }
            KeptNumber::Two => {
                self.sent.next.half2 = self.halves.val().half0;
                self.sent.next.half3 = self.halves.val().half1;
                self.kept.d.next.half0 = self.third.val();
                if self.has_short_ids.val() | (!self.vertices_alone.val()) {
                    self.kept.d.next.half1 = self.fourth.val();
                }
                if !self.vertices_alone.val() {
                    self.kept.d.next.half2 = self.halves.val().half4;
                    self.kept.d.next.half3 = self.halves.val().half5;
                }
            }
            KeptNumber::Three => {
                self.sent.next.half3 = self.halves.val().half0;
                self.kept.d.next.half0 = self.halves.val().half1;
                self.kept.d.next.half1 = self.halves.val().half2;
            }
            _ => {}
        }
        self.sent_bits.next = self.sent.val().into();
        self.filled.d.next.low = self.sent_bits.val().get_bits::<32>(0);
        self.filled.d.next.high = self.sent_bits.val().get_bits::<32>(32);
        if !self.number.moves.val() {
            self.kept.d.next = self.kept.q.val();
        }
        if self.reset.val() {
            self.is_there.d.next = false;
        }
    }
}
