//! Packs the vertices of records into beats of two words, as ids of 16 bits without gaps, so that four records take six
//! words and not twelve.
//!
//! 1. Four records fill three beats. The first of the four fills none; each of the others fills one and leaves the ids
//!    that do not fit.
//! 2. The ids that the last record leaves follow a clock later as a beat of their own, with as many words as they need;
//!    an odd half is zero.
//! 3. Nothing can stall this block: the user makes sure that there is room for every beat.
//!
//! Latency: 1 clock from a record to the beat that it fills, 2 to the beat with the rest.
//!
//! Five records, whose ids are numbered from 1 on; `half` is the lowest id of a beat's four:
//! ```text
//! starts          /^^\__________________________
//! comes           ___/^^^^^^^^\__/^^^^^\________
//! v0                .  1  4  7  . 10 13  .  .  .
//! valid           _________/^^^^^\__/^^\__/^^\__
//! half              .  .  .  1  5  .  9  . 13  .
//! last            ________________________/^^\__
//! ```

use super::types::{AnswerBeat, RecordCount, Word};
use crate::engine::types::VertexId;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct VertexPacker {
    pub clock: Signal<In, Clock>,
    /// A reset drops the beat.
    pub reset: Signal<In, Bit>,
    /// A payload of `count` records begins; `count` is at least 1.
    pub starts: Signal<In, Bit>,
    pub count: Signal<In, RecordCount>,
    /// A record comes, with these vertices.
    pub comes: Signal<In, Bit>,
    pub v0: Signal<In, VertexId>,
    pub v1: Signal<In, VertexId>,
    pub v2: Signal<In, VertexId>,
    /// A beat is full or is the last one; held for one clock.
    pub valid: Signal<Out, Bit>,
    pub beat: Signal<Out, AnswerBeat>,
    is_there: DFF<Bit>,
    filled: DFF<AnswerBeat>,
    /// Number of records of the present four that have come.
    place: DFF<Bits<2>>,
    left: DFF<RecordCount>,
    /// One record is left to come.
    is_last: DFF<Bit>,
    /// A beat with the rest is due.
    flushes: DFF<Bit>,
    held0: DFF<VertexId>,
    held1: DFF<VertexId>,
    held2: DFF<VertexId>,
    takes: Signal<Local, Bit>,
    ends_full: Signal<Local, Bit>,
    new0: Signal<Local, VertexId>,
    new1: Signal<Local, VertexId>,
    new2: Signal<Local, VertexId>,
    half1: Signal<Local, VertexId>,
    half2: Signal<Local, VertexId>,
    half3: Signal<Local, VertexId>,
    even0: Signal<Local, Word>,
    even1: Signal<Local, Word>,
    odd0: Signal<Local, Word>,
    odd1: Signal<Local, Word>,
    high0: Signal<Local, Word>,
    high1: Signal<Local, Word>,
    half_shift: Signal<Local, Word>,
    one: Signal<Local, RecordCount>,
    two: Signal<Local, RecordCount>,
    first_place: Signal<Local, Bits<2>>,
    second_place: Signal<Local, Bits<2>>,
    last_place: Signal<Local, Bits<2>>,
}

impl Logic for VertexPacker {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_there, filled, place, left, is_last, flushes, held0, held1, held2);
        self.half_shift.next = 16.into();
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.first_place.next = 0.into();
        self.second_place.next = 1.into();
        self.last_place.next = 3.into();
        self.valid.next = self.is_there.q.val();
        self.beat.next = self.filled.q.val();

        // The rest goes out as if a record of zeros had come, so it needs no path of its own.
        self.takes.next = self.comes.val() | self.flushes.q.val();
        self.new0.next = self.v0.val();
        self.new1.next = self.v1.val();
        self.new2.next = self.v2.val();
        if self.flushes.q.val() {
            self.new0.next = 0.into();
            self.new1.next = 0.into();
            self.new2.next = 0.into();
        }

        // Ids held from earlier records come before those of the new one. How many are held depends on the
        // place among the four.
        self.half1.next = self.held1.q.val();
        self.half2.next = self.held2.q.val();
        self.half3.next = self.new0.val();
        match self.place.q.val().index() {
            2 => {
                self.half2.next = self.new0.val();
                self.half3.next = self.new1.val();
            }
            3 => {
                self.half1.next = self.new0.val();
                self.half2.next = self.new1.val();
                self.half3.next = self.new2.val();
            }
            _ => {}
        }
        if self.takes.val() {
            match self.place.q.val().index() {
                0 => {
                    self.held0.d.next = self.new0.val();
                    self.held1.d.next = self.new1.val();
                    self.held2.d.next = self.new2.val();
                }
                1 => {
                    self.held0.d.next = self.new1.val();
                    self.held1.d.next = self.new2.val();
                }
                _ => {
                    self.held0.d.next = self.new2.val();
                }
            }
            self.place.d.next = self.place.q.val() + self.second_place.val();
        }
        self.even0.next = bit_cast::<32, 15>(self.held0.q.val());
        self.odd0.next = bit_cast::<32, 15>(self.half1.val());
        self.even1.next = bit_cast::<32, 15>(self.half2.val());
        self.odd1.next = bit_cast::<32, 15>(self.half3.val());
        self.high0.next = self.odd0.val() << self.half_shift.val();
        self.high1.next = self.odd1.val() << self.half_shift.val();
        self.ends_full.next = self.is_last.q.val() & (self.place.q.val() == self.last_place.val());
        self.filled.d.next.low = self.even0.val() | self.high0.val();
        self.filled.d.next.high = self.even1.val() | self.high1.val();
        self.filled.d.next.both = (!self.flushes.q.val()) | (self.place.q.val() == self.second_place.val());
        self.filled.d.next.last = self.flushes.q.val() | self.ends_full.val();
        self.is_there.d.next = self.takes.val() & (self.place.q.val() != self.first_place.val());

        self.flushes.d.next = self.comes.val() & self.is_last.q.val() & (!self.ends_full.val());
        if self.comes.val() {
            self.left.d.next = self.left.q.val() - self.one.val();
            self.is_last.d.next = self.left.q.val() == self.two.val();
        }
        if self.starts.val() {
            self.place.d.next = self.first_place.val();
            self.left.d.next = self.count.val();
            self.is_last.d.next = self.count.val() == self.one.val();
        }
        if self.reset.val() {
            self.is_there.d.next = false;
            self.flushes.d.next = false;
        }
    }
}
