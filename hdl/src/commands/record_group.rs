//! Counts down the records of a payload, and collects the rests of short ids of 12 bits, which follow the words of up
//! to eight records as a word of their own.
//!
//! 1. A record ends a group if it is the eighth of it or the last of the payload.
//! 2. `rests` has the rest of the record that comes in bits 31 to 28, those of the records before it in its group
//!    below, and zeros below the first.
//!
//! Latency: none from `rest` to `rests`; 1 clock from a record to the outputs for the next one.

use super::types::{RecordCount, Word};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RecordGroup {
    pub clock: Signal<In, Clock>,
    /// A payload of `count` records begins; `count` is at least 1.
    pub starts: Signal<In, Bit>,
    pub count: Signal<In, RecordCount>,
    /// A record comes, with this rest.
    pub comes: Signal<In, Bit>,
    pub rest: Signal<In, Bits<4>>,
    /// The next record is the last one; it ends a group; the last record has come.
    pub is_last: Signal<Out, Bit>,
    pub ends_group: Signal<Out, Bit>,
    pub all_came: Signal<Out, Bit>,
    pub rests: Signal<Out, Word>,
    left: DFF<RecordCount>,
    one_is_left: DFF<Bit>,
    none_is_left: DFF<Bit>,
    /// The records of the group so far: their number and their rests.
    place: DFF<Bits<3>>,
    earlier: DFF<Word>,
    together: Signal<Local, Word>,
    ends: Signal<Local, Bit>,
    one: Signal<Local, RecordCount>,
    two: Signal<Local, RecordCount>,
    one_place: Signal<Local, Bits<3>>,
    last_place: Signal<Local, Bits<3>>,
    rest_bits: Signal<Local, Word>,
    rest_shift: Signal<Local, Word>,
}

impl Logic for RecordGroup {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left, one_is_left, none_is_left, place, earlier);
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.one_place.next = 1.into();
        self.last_place.next = 7.into();
        self.rest_bits.next = 4.into();
        self.rest_shift.next = 28.into();
        self.is_last.next = self.one_is_left.q.val();
        self.all_came.next = self.none_is_left.q.val();
        self.ends.next = self.one_is_left.q.val() | (self.place.q.val() == self.last_place.val());
        self.ends_group.next = self.ends.val();
        self.together.next = (self.earlier.q.val() >> self.rest_bits.val())
            | (bit_cast::<32, 4>(self.rest.val()) << self.rest_shift.val());
        self.rests.next = self.together.val();
        if self.comes.val() {
            self.left.d.next = self.left.q.val() - self.one.val();
            self.one_is_left.d.next = self.left.q.val() == self.two.val();
            self.none_is_left.d.next = self.one_is_left.q.val();
            self.place.d.next = self.place.q.val() + self.one_place.val();
            self.earlier.d.next = self.together.val();
            if self.ends.val() {
                self.earlier.d.next = 0.into();
            }
        }
        if self.starts.val() {
            self.left.d.next = self.count.val();
            self.one_is_left.d.next = self.count.val() == self.one.val();
            self.place.d.next = 0.into();
            self.earlier.d.next = 0.into();
        }
    }
}
