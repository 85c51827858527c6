//! Checks the range of a read-out and computes the length of its payload, in two ranks of registers.
//!
//! 1. A range is outside the mesh if its last record does not exist.
//! 2. A `Read` has three words for a record. A `Triangles` has a word and a half, with short ids of 10 bits a word, and
//!    with those of 12 bits a word and one more for eight records. Each sum is rounded up.
//! 3. Lengths count only within the mesh, so they have the bits of as many records as there can be.
//!
//! Latency: 2 clocks from `request.first`, `request.count` and `records`, 1 clock from the form of the ids.

use super::types::{RecordCount, Request, Word};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct ReadRange {
    pub clock: Signal<In, Clock>,
    pub request: Signal<In, Request>,
    /// Number of records of the mesh.
    pub records: Signal<In, RecordCount>,
    pub is_outside: Signal<Out, Bit>,
    /// The range has no record.
    pub has_none: Signal<Out, Bit>,
    /// Number of payload words of a `Read` and of a `Triangles`.
    pub whole_length: Signal<Out, Bits<17>>,
    pub packed_length: Signal<Out, Bits<17>>,
    /// Registers of the first rank.
    range_end: DFF<Bits<33>>,
    bound: DFF<RecordCount>,
    counts_none: DFF<Bit>,
    triple: DFF<Bits<17>>,
    number: DFF<Bits<17>>,
    /// The number of records, enlarged so that its half or its eighth is rounded up.
    enlarged: DFF<Bits<17>>,
    /// Registers of the second rank.
    outside: DFF<Bit>,
    reads_none: DFF<Bit>,
    whole: DFF<Bits<17>>,
    vertices: DFF<Bits<17>>,
    wide_first: Signal<Local, Bits<33>>,
    wide_count: Signal<Local, Bits<33>>,
    wide_bound: Signal<Local, Bits<33>>,
    none: Signal<Local, Word>,
    few: Signal<Local, RecordCount>,
    count: Signal<Local, Bits<17>>,
    /// The words of a `Triangles` beyond one for each record.
    more: Signal<Local, Bits<17>>,
    added: Signal<Local, Bits<17>>,
    one: Signal<Local, Bits<17>>,
    three: Signal<Local, Bits<17>>,
}

impl Logic for ReadRange {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, range_end, bound, counts_none, triple, number, enlarged);
        dff_setup!(self, clock, outside, reads_none, whole, vertices);
        self.none.next = 0.into();
        self.one.next = 1.into();
        self.three.next = 3.into();

        // The first rank has the additions alone, because a sum and its comparison in one clock would be too slow.
        self.wide_first.next = bit_cast::<33, 32>(self.request.val().first);
        self.wide_count.next = bit_cast::<33, 32>(self.request.val().count);
        self.range_end.d.next = self.wide_first.val() + self.wide_count.val();
        self.bound.d.next = self.records.val();
        self.counts_none.d.next = self.request.val().count == self.none.val();
        self.few.next = bit_cast::<15, 32>(self.request.val().count);
        self.count.next = bit_cast::<17, 15>(self.few.val());
        self.triple.d.next = self.count.val() + (self.count.val() << self.one.val());
        self.number.d.next = self.count.val();
        self.added.next = 1.into();
        if self.request.val().has_short_ids {
            self.added.next = 7.into();
        }
        self.enlarged.d.next = self.count.val() + self.added.val();

        self.wide_bound.next = bit_cast::<33, 15>(self.bound.q.val());
        self.outside.d.next = self.range_end.q.val() > self.wide_bound.val();
        self.reads_none.d.next = self.counts_none.q.val();
        self.whole.d.next = self.triple.q.val();
        self.more.next = self.enlarged.q.val() >> self.one.val();
        if self.request.val().has_short_ids {
            self.more.next = self.enlarged.q.val() >> self.three.val();
            if !self.request.val().has_rests {
                self.more.next = 0.into();
            }
        }
        self.vertices.d.next = self.number.q.val() + self.more.val();

        self.is_outside.next = self.outside.q.val();
        self.has_none.next = self.reads_none.q.val();
        self.whole_length.next = self.whole.q.val();
        self.packed_length.next = self.vertices.q.val();
    }
}
