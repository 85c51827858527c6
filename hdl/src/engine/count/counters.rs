//! The event counters, and the clock count from which latencies are taken.
//!
//! 1. Cycle counts are two words of 32 bits; the high word follows a clock after the low one has wrapped.
//! 2. Every event, and `clears`, goes into a register first. A count that is read while events come is that
//!    of the clock before.
//!
//! Latency: an event is counted at the second edge, the range of latencies at the third; `value` follows
//! `select` by 2 clocks.

use super::cycle_counters::CycleCounters;
use super::event_counter::EventCounter;
use super::latency_range::LatencyRange;
use super::visit_counters::VisitCounters;
use crate::engine::types::{Clocks, Events};
use crate::prelude::*;
use incircle_protocol::Counter;

#[derive(LogicBlock, Default)]
pub struct Counters {
    pub clock: Signal<In, Clock>,
    /// Reset and clear set all counters to zero.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// A job is under way; the job has no point to work on; a read-out is under way.
    pub inserting: Signal<In, Bit>,
    pub waiting: Signal<In, Bit>,
    pub reading: Signal<In, Bit>,
    /// The events of this edge.
    pub events: Signal<In, Events>,
    /// The number of points refused, counted where they are refused.
    pub refused: Signal<In, Bits<32>>,
    /// The word to read, by its place in the answer to `Counters`.
    pub select: Signal<In, Bits<5>>,
    /// The word selected 2 clocks ago.
    pub value: Signal<Out, Bits<32>>,
    /// Two of the words, for the command port.
    pub insertions: Signal<Out, Bits<32>>,
    pub duplicates: Signal<Out, Bits<32>>,
    /// The number of clocks since reset, modulo 2^22; clear does not stop this count.
    pub now: Signal<Out, Clocks>,
    /// The latency of the commit that ended at the last edge.
    pub latency_comes: Signal<Out, Bit>,
    pub latency: Signal<Out, Clocks>,
    ticks: DFF<Clocks>,
    zeroes: DFF<Bit>,
    /// The group that the selected word belongs to, the selected word of the third group, and the answer.
    group: DFF<Bits<2>>,
    other: DFF<Bits<32>>,
    chosen: DFF<Bits<32>>,
    inserts: DFF<Bits<2>>,
    inserted: DFF<Bits<32>>,
    duplicated: EventCounter,
    cycles: CycleCounters,
    visits: VisitCounters,
    range: LatencyRange,
    one_tick: Signal<Local, Clocks>,
    last_other: Signal<Local, Bits<5>>,
    first_cycles: Signal<Local, Bits<5>>,
    more: Signal<Local, Bits<32>>,
}

// `select` counts in the order of `Counter`; a change there must come here.
const _: () = assert!(
    Counter::Insertions as usize == 6
        && Counter::Duplicates as usize == 7
        && Counter::Refused as usize == 8
        && Counter::WalkVisits as usize == 9
        && Counter::PrioritiesTaken as usize == 18
        && Counter::LatencyMin as usize == 23
        && Counter::LatencyMax as usize == 24,
    "the words of this block follow the protocol"
);

impl Logic for Counters {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, ticks, zeroes, group, other, chosen, inserts, inserted);
        clock!(self, clock, duplicated, cycles, visits, range);
        self.one_tick.next = 1.into();
        self.last_other.next = 8.into();
        self.first_cycles.next = 19.into();
        self.zeroes.d.next = self.reset.val() | self.clears.val();
        self.duplicated.zero.next = self.zeroes.q.val();
        self.cycles.zero.next = self.zeroes.q.val();
        self.visits.zero.next = self.zeroes.q.val();
        self.range.zero.next = self.zeroes.q.val();

        self.cycles.inserting.next = self.inserting.val();
        self.cycles.waiting.next = self.waiting.val();
        self.cycles.reading.next = self.reading.val();
        self.cycles.is_issuing.next = self.events.val().is_issuing;
        self.cycles.is_writing.next = self.events.val().is_writing;
        self.cycles.is_committing.next = self.events.val().is_committing;
        self.cycles.is_releasing.next = self.events.val().is_releasing;
        self.cycles.select.next = self.select.val();
        self.visits.events.next = self.events.val().visits;
        self.visits.select.next = self.select.val();

        self.ticks.d.next = self.ticks.q.val() + self.one_tick.val();
        self.now.next = self.ticks.q.val();
        self.range.commit_ends.next = self.events.val().commit_ends;
        self.range.now.next = self.ticks.q.val();
        self.range.since.next = self.events.val().since;
        self.latency_comes.next = self.range.latency_comes.val();
        self.latency.next = self.range.latency.val();

        self.duplicated.count.next = self.events.val().duplicate | self.events.val().solo_duplicate;
        self.inserts.d.next = 0.into();
        if self.events.val().commit_ends | self.events.val().solo_inserts {
            self.inserts.d.next = 1.into();
        }
        if self.events.val().seeds {
            self.inserts.d.next = 3.into();
        }
        self.more.next = bit_cast::<32, 2>(self.inserts.q.val());
        self.inserted.d.next = self.inserted.q.val() + self.more.val();
        self.insertions.next = self.inserted.q.val();
        self.duplicates.next = self.duplicated.value.val();

        // Each group chooses a word of its own first, so that no clock holds a choice among all words.
        self.value.next = self.chosen.q.val();
        self.group.d.next = 2.into();
        self.other.d.next = self.inserted.q.val();
        match self.select.val().index() {
            6 => {
                self.other.d.next = self.inserted.q.val();
            }
            7 => {
                self.other.d.next = self.duplicated.value.val();
            }
            8 => {
                self.other.d.next = self.refused.val();
            }
            23 => {
                self.other.d.next = bit_cast::<32, 22>(self.range.least.val());
            }
            24 => {
                self.other.d.next = bit_cast::<32, 22>(self.range.most.val());
            }
            _ => {
                self.group.d.next = 0.into();
                if (self.select.val() > self.last_other.val()) & (self.select.val() < self.first_cycles.val()) {
                    self.group.d.next = 1.into();
                }
            }
        }
        match self.group.q.val().index() {
            0 => {
                self.chosen.d.next = self.cycles.value.val();
            }
            1 => {
                self.chosen.d.next = self.visits.value.val();
            }
            _ => {
                self.chosen.d.next = self.other.q.val();
            }
        }
        if self.zeroes.q.val() {
            self.inserted.d.next = 0.into();
        }
        if self.reset.val() {
            self.ticks.d.next = 0.into();
        }
    }
}
