//! The event counters, and the clock that latencies are taken from.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset`, `clears` | in | 1 | reset and clear set all counters to zero |
//! | `inserting`, `waiting`, `reading` | in | 1 | a job is under way; it has no point to work on; a read-out is under way |
//! | `is_issuing`, `is_writing` | in | 1 | a visit is issued; a record or a link is written |
//! | `is_committing`, `is_releasing` | in | 1 | a commit is at work; a lock is cleared |
//! | `walk_visit`, `root_visit`, `test`, `solo_test` | in | 1 | a visit of that kind completes |
//! | `revisit` | in | 1 | it is made once more |
//! | `gives_up`, `retries` | in | 1 | an attempt ends at a foreign lock; a located triangle no longer holds the point |
//! | `takes_token` | in | 1 | the waiting token is taken |
//! | `overflows`, `flip` | in | 1 | a boundary list has overflowed; a flip of an insertion alone is finished |
//! | `cavity_ends`, `cavity_triangles` | in | 1, 7 | a cavity is complete, and consists of so many triangles |
//! | `seeds`, `commit_ends`, `solo_inserts` | in | 1 | 3, 1 or 1 points are inserted |
//! | `since` | in | 22 | when the point whose commit ends was taken: `now` at that edge |
//! | `duplicate`, `solo_duplicate` | in | 1 | a point is found to be a duplicate |
//! | `refused` | in | 32 | points refused, counted where they are refused |
//! | `select` | in | 5 | word to read: its place in the answer to `Counters` |
//! | `value` | out | 32 | that word, 2 clocks later |
//! | `insertions`, `duplicates` | out | 32 | two of them |
//! | `now` | out | 22 | clocks since reset, modulo 2^22; clear does not stop it |
//! | `latency_comes`, `latency` | out | 1, 22 | the latency of the commit that ended with the last edge |
//!
//! 1. Cycle counts are two words of 32 bits; the high one follows a clock after the low one has wrapped.
//!
//! 2. Every event, and `clears`, goes into a register first. A count that is read while events come is that of the clock before.
//!
//! Latency: an event is counted at the second edge, the range of latencies at the third; `value` follows `select` by 2 clocks.

use super::cycle_counters::CycleCounters;
use super::event_counter::EventCounter;
use super::latency_range::LatencyRange;
use super::visit_counters::VisitCounters;
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
    /// A visit is issued.
    pub is_issuing: Signal<In, Bit>,
    /// A record or a link is written.
    pub is_writing: Signal<In, Bit>,
    /// A commit is at work.
    pub is_committing: Signal<In, Bit>,
    /// A lock is cleared.
    pub is_releasing: Signal<In, Bit>,
    /// A walk visits a triangle.
    pub walk_visit: Signal<In, Bit>,
    /// A cavity test is finished.
    pub test: Signal<In, Bit>,
    /// A test of an insertion alone is finished.
    pub solo_test: Signal<In, Bit>,
    /// A list has overflowed.
    pub overflows: Signal<In, Bit>,
    /// A flip is finished.
    pub flip: Signal<In, Bit>,
    /// A located triangle is visited for its lock.
    pub root_visit: Signal<In, Bit>,
    /// A visit is made once more.
    pub revisit: Signal<In, Bit>,
    /// An attempt is given up at a foreign lock.
    pub gives_up: Signal<In, Bit>,
    /// A triangle no longer holds the point when it is locked.
    pub retries: Signal<In, Bit>,
    /// A context takes the waiting token.
    pub takes_token: Signal<In, Bit>,
    /// A cavity is complete.
    pub cavity_ends: Signal<In, Bit>,
    /// Its triangles.
    pub cavity_triangles: Signal<In, Bits<7>>,
    /// The first triangle is finished.
    pub seeds: Signal<In, Bit>,
    /// A commit is finished.
    pub commit_ends: Signal<In, Bit>,
    /// When its point was taken.
    pub since: Signal<In, Bits<22>>,
    /// An insertion alone has inserted its point.
    pub solo_inserts: Signal<In, Bit>,
    /// A walk or the visit of a root finds a duplicate.
    pub duplicate: Signal<In, Bit>,
    /// An insertion alone finds one.
    pub solo_duplicate: Signal<In, Bit>,
    /// Points refused.
    pub refused: Signal<In, Bits<32>>,
    /// Word to read.
    pub select: Signal<In, Bits<5>>,
    /// It.
    pub value: Signal<Out, Bits<32>>,
    /// Points inserted.
    pub insertions: Signal<Out, Bits<32>>,
    /// Points that fell onto another.
    pub duplicates: Signal<Out, Bits<32>>,
    /// Clocks since reset.
    pub now: Signal<Out, Bits<22>>,
    /// A commit has ended.
    pub latency_comes: Signal<Out, Bit>,
    /// Its latency.
    pub latency: Signal<Out, Bits<22>>,
    ticks: DFF<Bits<22>>,
    zeroes: DFF<Bit>,
    /// The group of the word, one of the third group, and the word.
    group: DFF<Bits<2>>,
    other: DFF<Bits<32>>,
    chosen: DFF<Bits<32>>,
    inserts: DFF<Bits<2>>,
    inserted: DFF<Bits<32>>,
    duplicated: EventCounter,
    cycles: CycleCounters,
    visits: VisitCounters,
    range: LatencyRange,
    one_tick: Signal<Local, Bits<22>>,
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
        && Counter::WaitingTokens as usize == 18
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
        self.cycles.is_issuing.next = self.is_issuing.val();
        self.cycles.is_writing.next = self.is_writing.val();
        self.cycles.is_committing.next = self.is_committing.val();
        self.cycles.is_releasing.next = self.is_releasing.val();
        self.cycles.select.next = self.select.val();
        self.visits.walk_visit.next = self.walk_visit.val();
        self.visits.test.next = self.test.val() | self.solo_test.val();
        self.visits.overflows.next = self.overflows.val();
        self.visits.flip.next = self.flip.val();
        self.visits.root_visit.next = self.root_visit.val();
        self.visits.revisit.next = self.revisit.val();
        self.visits.gives_up.next = self.gives_up.val();
        self.visits.retries.next = self.retries.val();
        self.visits.takes_token.next = self.takes_token.val();
        self.visits.cavity_ends.next = self.cavity_ends.val();
        self.visits.cavity_triangles.next = self.cavity_triangles.val();
        self.visits.select.next = self.select.val();

        self.ticks.d.next = self.ticks.q.val() + self.one_tick.val();
        self.now.next = self.ticks.q.val();
        self.range.commit_ends.next = self.commit_ends.val();
        self.range.now.next = self.ticks.q.val();
        self.range.since.next = self.since.val();
        self.latency_comes.next = self.range.latency_comes.val();
        self.latency.next = self.range.latency.val();

        self.duplicated.count.next = self.duplicate.val() | self.solo_duplicate.val();
        self.inserts.d.next = 0.into();
        if self.commit_ends.val() | self.solo_inserts.val() {
            self.inserts.d.next = 1.into();
        }
        if self.seeds.val() {
            self.inserts.d.next = 3.into();
        }
        self.more.next = bit_cast::<32, 2>(self.inserts.q.val());
        self.inserted.d.next = self.inserted.q.val() + self.more.val();
        self.insertions.next = self.inserted.q.val();
        self.duplicates.next = self.duplicated.value.val();

        // A word is chosen within its group first: clocks, visits, others.
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
