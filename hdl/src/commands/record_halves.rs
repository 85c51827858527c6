//! Keeps a record of the read-out for a clock, and gives its words or the ids of its vertices as halves of words.
//!
//! 1. Word `k` of a record holds `v[k]` in bits 0 to 14 and `n[k]` in bits 15 to 29; bit 31 of word 0 is the lock bit.
//!    Halves `2 k` and `2 k + 1` are the lower and the upper half of word `k`.
//! 2. Of a payload of vertices, half `k` is `v[k]`, and only the first three halves count.
//! 3. With short ids, halves 0 and 1 are a word with the lower ten bits of `v[0]`, `v[1]` and `v[2]`, and with bits 11
//!    and 10 of `v[0]` above them. The rest has bits 11 and 10 of `v[1]`, and above them those of `v[2]`.
//! 4. The record goes into registers straight from the memory, and the halves are made behind them, so that no path
//!    begins in the memory and ends in the answer stream.
//!
//! Latency: 1 clock from `record` to `halves` and `rest`.

use super::types::{Half, Halves};
use crate::mesh::Record;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RecordHalves {
    pub clock: Signal<In, Clock>,
    pub record: Signal<In, Record>,
    /// The payload has the vertices of the records alone.
    pub vertices_alone: Signal<In, Bit>,
    /// The payload has vertices alone, with short ids.
    pub has_short_ids: Signal<In, Bit>,
    pub halves: Signal<Out, Halves>,
    /// With short ids of 12 bits, what the record has beyond its first two halves.
    pub rest: Signal<Out, Bits<4>>,
    kept: DFF<Record>,
    vertex0: Signal<Local, Half>,
    vertex1: Signal<Local, Half>,
    vertex2: Signal<Local, Half>,
    link0: Signal<Local, Half>,
    link1: Signal<Local, Half>,
    link2: Signal<Local, Half>,
    /// The lowest bit of a link, where the word has it, and the other bits.
    bottom0: Signal<Local, Half>,
    bottom1: Signal<Local, Half>,
    bottom2: Signal<Local, Half>,
    top0: Signal<Local, Half>,
    lock: Signal<Local, Half>,
    id_bits: Signal<Local, Half>,
    one: Signal<Local, Half>,
    two_bits: Signal<Local, Bits<4>>,
    four: Signal<Local, Half>,
    six: Signal<Local, Half>,
    ten: Signal<Local, Half>,
    low_ten: Signal<Local, Half>,
    low_four: Signal<Local, Half>,
    top_two: Signal<Local, Half>,
}

impl Logic for RecordHalves {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, kept);
        self.id_bits.next = 15.into();
        self.one.next = 1.into();
        self.two_bits.next = 2.into();
        self.four.next = 4.into();
        self.six.next = 6.into();
        self.ten.next = 10.into();
        self.low_ten.next = 0x03ff.into();
        self.low_four.next = 0x000f.into();
        self.top_two.next = 0xc000.into();
        self.kept.d.next = self.record.val();
        self.lock.next = 0.into();
        if self.kept.q.val().was_set {
            self.lock.next = 0x8000.into();
        }
        self.vertex0.next = bit_cast::<16, 15>(self.kept.q.val().v0);
        self.vertex1.next = bit_cast::<16, 15>(self.kept.q.val().v1);
        self.vertex2.next = bit_cast::<16, 15>(self.kept.q.val().v2);
        self.link0.next = bit_cast::<16, 15>(self.kept.q.val().n0);
        self.link1.next = bit_cast::<16, 15>(self.kept.q.val().n1);
        self.link2.next = bit_cast::<16, 15>(self.kept.q.val().n2);
        self.bottom0.next = self.link0.val() << self.id_bits.val();
        self.bottom1.next = self.link1.val() << self.id_bits.val();
        self.bottom2.next = self.link2.val() << self.id_bits.val();
        self.top0.next = self.link0.val() >> self.one.val();
        self.halves.next.half0 = self.vertex0.val() | self.bottom0.val();
        self.halves.next.half1 = self.top0.val() | self.lock.val();
        self.halves.next.half2 = self.vertex1.val() | self.bottom1.val();
        self.halves.next.half3 = self.link1.val() >> self.one.val();
        self.halves.next.half4 = self.vertex2.val() | self.bottom2.val();
        self.halves.next.half5 = self.link2.val() >> self.one.val();
        if self.vertices_alone.val() {
            self.halves.next.half0 = self.vertex0.val();
            self.halves.next.half1 = self.vertex1.val();
            self.halves.next.half2 = self.vertex2.val();
            if self.has_short_ids.val() {
                self.halves.next.half0 =
                    (self.vertex0.val() & self.low_ten.val()) | (self.vertex1.val() << self.ten.val());
                self.halves.next.half1 = ((self.vertex1.val() >> self.six.val()) & self.low_four.val())
                    | ((self.vertex2.val() & self.low_ten.val()) << self.four.val())
                    | ((self.vertex0.val() << self.four.val()) & self.top_two.val());
            }
        }
        self.rest.next = bit_cast::<4, 2>(self.vertex1.val().get_bits::<2>(10))
            | (bit_cast::<4, 2>(self.vertex2.val().get_bits::<2>(10)) << self.two_bits.val());
    }
}
