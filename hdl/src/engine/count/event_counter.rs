//! Counters of events: one of a word, and one of two words.
//!
//! An event is noted at its edge and counted at the next one, so that the logic behind `count` does not reach the
//! carries of a word.
//!
//! Latency: 2 clocks to the count.

use crate::prelude::*;

/// A counter of one word.
#[derive(LogicBlock, Default)]
pub struct EventCounter {
    pub clock: Signal<In, Clock>,
    /// The count goes to zero at this edge.
    pub zero: Signal<In, Bit>,
    /// An event happens in this clock.
    pub count: Signal<In, Bit>,
    /// The number of clocks with an event, modulo 2^32.
    pub value: Signal<Out, Bits<32>>,
    counts: DFF<Bit>,
    word: DFF<Bits<32>>,
    one: Signal<Local, Bits<32>>,
}

impl Logic for EventCounter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, counts, word);
        self.one.next = 1.into();
        self.value.next = self.word.q.val();
        self.counts.d.next = self.count.val();
        if self.counts.q.val() {
            self.word.d.next = self.word.q.val() + self.one.val();
        }
        if self.zero.val() {
            self.word.d.next = 0.into();
        }
    }
}

/// A counter of two words of `N` bits.
#[derive(LogicBlock)]
pub struct WideCounter<const N: usize> {
    pub clock: Signal<In, Clock>,
    /// The count goes to zero at this edge.
    pub zero: Signal<In, Bit>,
    /// An event happens in this clock.
    pub count: Signal<In, Bit>,
    /// The two words of the count; `high` follows a clock after `low` has wrapped.
    pub low: Signal<Out, Bits<N>>,
    pub high: Signal<Out, Bits<N>>,
    counts: DFF<Bit>,
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
            counts: DFF::default(),
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
        dff_setup!(self, clock, counts, low_word, high_word, carries);
        self.one.next = 1.into();
        self.low.next = self.low_word.q.val();
        self.high.next = self.high_word.q.val();
        self.counts.d.next = self.count.val();
        self.carries.d.next = self.counts.q.val() & (self.low_word.q.val() == self.all_ones.val());
        if self.counts.q.val() {
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
