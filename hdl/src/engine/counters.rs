//! The event counters.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset`, `clears` | in | 1 | reset and clear set all to zero |
//! | `inserting`, `waiting`, `reading` | in | 1 | this clock counts as that kind of cycle |
//! | `seeds`, `commit_ends`, `solo_ends` | in | 1 | 3, 1 or 1 points are inserted |
//! | `duplicate`, `walk_visit`, `test`, `drained`, `flip` | in | 1 | one such event |
//! | `cavity_triangles` | in | 7 | triangles of the cavity that a commit replaces |
//! | `select` | in | 4 | word to read: its place in the answer to `Counters` |
//! | `value` | out | 32 | that word |
//! | `insertions`, `duplicates` | out | 32 | two of them |
//!
//! 1. Cycle counts are two words of 32 bits; the high one follows a clock after the low one has wrapped.
//!
//! Latency: an event is counted at its edge; `value` follows `select` at once.

use incircle_protocol::Counter;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The event counters; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Counters {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Zero.
    pub reset: Signal<In, Bit>,
    /// Zero.
    pub clears: Signal<In, Bit>,
    /// A job is under way.
    pub inserting: Signal<In, Bit>,
    /// It has no point to work on.
    pub waiting: Signal<In, Bit>,
    /// A read-out is under way.
    pub reading: Signal<In, Bit>,
    /// The first triangle is finished.
    pub seeds: Signal<In, Bit>,
    /// A commit is finished.
    pub commit_ends: Signal<In, Bit>,
    /// An insertion alone is finished.
    pub solo_ends: Signal<In, Bit>,
    /// A duplicate is found.
    pub duplicate: Signal<In, Bit>,
    /// A walk visits a triangle.
    pub walk_visit: Signal<In, Bit>,
    /// A conflict test is finished.
    pub test: Signal<In, Bit>,
    /// A list has overflowed.
    pub drained: Signal<In, Bit>,
    /// A flip is finished.
    pub flip: Signal<In, Bit>,
    /// Triangles that a commit replaces.
    pub cavity_triangles: Signal<In, Bits<7>>,
    /// Points refused, counted where they are refused.
    pub refused: Signal<In, Bits<32>>,
    /// Word to read.
    pub select: Signal<In, Bits<4>>,
    /// It.
    pub value: Signal<Out, Bits<32>>,
    /// Points inserted.
    pub insertions: Signal<Out, Bits<32>>,
    /// Points that fell onto another.
    pub duplicates: Signal<Out, Bits<32>>,
    insert_cycles: WideCounter<32>,
    wait_cycles: WideCounter<32>,
    read_cycles: WideCounter<32>,
    inserted: DFF<Bits<32>>,
    duplicated: DFF<Bits<32>>,
    walk_visits: DFF<Bits<32>>,
    tests: DFF<Bits<32>>,
    triangles: DFF<Bits<32>>,
    overflows: DFF<Bits<32>>,
    flips: DFF<Bits<32>>,
    one: Signal<Local, Bits<32>>,
    three: Signal<Local, Bits<32>>,
    wide_triangles: Signal<Local, Bits<32>>,
}

// `select` counts in the order of `Counter`; a change there must come here.
const _: () = assert!(
    Counter::ReadCycles as usize == 4 && Counter::Insertions as usize == 6 && Counter::Flips as usize == 13,
    "the words of this block follow the protocol"
);

impl Logic for Counters {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, inserted, duplicated, walk_visits, tests, triangles, overflows, flips);
        clock!(self, clock, insert_cycles, wait_cycles, read_cycles);
        self.one.next = 1.into();
        self.three.next = 3.into();
        self.wide_triangles.next = bit_cast::<32, 7>(self.cavity_triangles.val());
        self.insert_cycles.zero.next = self.reset.val() | self.clears.val();
        self.wait_cycles.zero.next = self.reset.val() | self.clears.val();
        self.read_cycles.zero.next = self.reset.val() | self.clears.val();
        self.insert_cycles.count.next = self.inserting.val();
        self.wait_cycles.count.next = self.waiting.val();
        self.read_cycles.count.next = self.reading.val();
        self.insertions.next = self.inserted.q.val();
        self.duplicates.next = self.duplicated.q.val();

        if self.commit_ends.val() | self.solo_ends.val() {
            self.inserted.d.next = self.inserted.q.val() + self.one.val();
        }
        if self.seeds.val() {
            self.inserted.d.next = self.inserted.q.val() + self.three.val();
        }
        if self.commit_ends.val() {
            self.triangles.d.next = self.triangles.q.val() + self.wide_triangles.val();
        }
        if self.duplicate.val() {
            self.duplicated.d.next = self.duplicated.q.val() + self.one.val();
        }
        if self.walk_visit.val() {
            self.walk_visits.d.next = self.walk_visits.q.val() + self.one.val();
        }
        if self.test.val() {
            self.tests.d.next = self.tests.q.val() + self.one.val();
        }
        if self.drained.val() {
            self.overflows.d.next = self.overflows.q.val() + self.one.val();
        }
        if self.flip.val() {
            self.flips.d.next = self.flips.q.val() + self.one.val();
        }

        match self.select.val().index() {
            0 => {
                self.value.next = self.insert_cycles.low.val();
            }
            1 => {
                self.value.next = self.insert_cycles.high.val();
            }
            2 => {
                self.value.next = self.wait_cycles.low.val();
            }
            3 => {
                self.value.next = self.wait_cycles.high.val();
            }
            4 => {
                self.value.next = self.read_cycles.low.val();
            }
            5 => {
                self.value.next = self.read_cycles.high.val();
            }
            6 => {
                self.value.next = self.inserted.q.val();
            }
            7 => {
                self.value.next = self.duplicated.q.val();
            }
            8 => {
                self.value.next = self.refused.val();
            }
            9 => {
                self.value.next = self.walk_visits.q.val();
            }
            10 => {
                self.value.next = self.tests.q.val();
            }
            11 => {
                self.value.next = self.triangles.q.val();
            }
            12 => {
                self.value.next = self.overflows.q.val();
            }
            _ => {
                self.value.next = self.flips.q.val();
            }
        }

        if self.reset.val() | self.clears.val() {
            self.inserted.d.next = 0.into();
            self.duplicated.d.next = 0.into();
            self.walk_visits.d.next = 0.into();
            self.tests.d.next = 0.into();
            self.triangles.d.next = 0.into();
            self.overflows.d.next = 0.into();
            self.flips.d.next = 0.into();
        }
    }
}

/// A counter of two words of `N` bits.
///
/// | port | direction | bits | meaning |
/// |---|---|---|---|
/// | `clock`, `zero` | in | 1 | `zero` clears it |
/// | `count` | in | 1 | this clock counts |
/// | `low`, `high` | out | N | its words; `high` follows a clock after `low` has wrapped |
#[derive(LogicBlock)]
pub struct WideCounter<const N: usize> {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Clears it.
    pub zero: Signal<In, Bit>,
    /// This clock counts.
    pub count: Signal<In, Bit>,
    /// Low word.
    pub low: Signal<Out, Bits<N>>,
    /// High word.
    pub high: Signal<Out, Bits<N>>,
    low_word: DFF<Bits<N>>,
    high_word: DFF<Bits<N>>,
    carries: DFF<Bit>,
    one: Signal<Local, Bits<N>>,
    all_ones: Constant<Bits<N>>,
}

impl<const N: usize> Default for WideCounter<N> {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            zero: Signal::default(),
            count: Signal::default(),
            low: Signal::default(),
            high: Signal::default(),
            low_word: DFF::default(),
            high_word: DFF::default(),
            carries: DFF::default(),
            one: Signal::default(),
            all_ones: Constant::new(Bits::<N>::mask()),
        }
    }
}

impl<const N: usize> Logic for WideCounter<N> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, low_word, high_word, carries);
        self.one.next = 1.into();
        self.low.next = self.low_word.q.val();
        self.high.next = self.high_word.q.val();
        self.carries.d.next = self.count.val() & (self.low_word.q.val() == self.all_ones.val());
        if self.count.val() {
            self.low_word.d.next = self.low_word.q.val() + self.one.val();
        }
        if self.carries.q.val() {
            self.high_word.d.next = self.high_word.q.val() + self.one.val();
        }
        if self.zero.val() {
            self.low_word.d.next = 0.into();
            self.high_word.d.next = 0.into();
            self.carries.d.next = false;
        }
    }
}
