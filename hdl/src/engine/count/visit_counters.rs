//! Counts of completed visits and their effects.
//!
//! Latency: 2 clocks to a count; `value` follows `select` by 1.

use super::event_counter::EventCounter;
use crate::engine::types::{RingCount, VisitEvents};
use crate::prelude::*;
use incircle_protocol::Counter;

#[derive(LogicBlock, Default)]
pub struct VisitCounters {
    pub clock: Signal<In, Clock>,
    /// All counts go to zero at this edge.
    pub zero: Signal<In, Bit>,
    /// The events of visits at this edge.
    pub events: Signal<In, VisitEvents>,
    /// The word to read, by its place in the answer to `Counters`.
    pub select: Signal<In, Bits<5>>,
    /// The selected word a clock later, if it is one of this block.
    pub value: Signal<Out, Bits<32>>,
    chosen: DFF<Bits<32>>,
    last_triangles: DFF<RingCount>,
    triangles: DFF<Bits<32>>,
    walk_visits: EventCounter,
    tests: EventCounter,
    overflowed: EventCounter,
    flips: EventCounter,
    root_visits: EventCounter,
    revisits: EventCounter,
    aborts: EventCounter,
    root_retries: EventCounter,
    priorities_taken: EventCounter,
    wide_triangles: Signal<Local, Bits<32>>,
}

// `select` counts in the order of `Counter`; a change there must come here.
const _: () = assert!(
    Counter::WalkVisits as usize == 9
        && Counter::Tests as usize == 10
        && Counter::CavityTriangles as usize == 11
        && Counter::Overflows as usize == 12
        && Counter::Flips as usize == 13
        && Counter::RootVisits as usize == 14
        && Counter::Revisits as usize == 15
        && Counter::Aborts as usize == 16
        && Counter::RootRetries as usize == 17
        && Counter::PrioritiesTaken as usize == 18,
    "the words of this block follow the protocol"
);

impl Logic for VisitCounters {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, chosen, last_triangles, triangles);
        clock!(self, clock, walk_visits, tests, overflowed, flips, root_visits);
        clock!(self, clock, revisits, aborts, root_retries, priorities_taken);
        self.walk_visits.zero.next = self.zero.val();
        self.tests.zero.next = self.zero.val();
        self.overflowed.zero.next = self.zero.val();
        self.flips.zero.next = self.zero.val();
        self.root_visits.zero.next = self.zero.val();
        self.revisits.zero.next = self.zero.val();
        self.aborts.zero.next = self.zero.val();
        self.root_retries.zero.next = self.zero.val();
        self.priorities_taken.zero.next = self.zero.val();
        self.walk_visits.count.next = self.events.val().walk_visit;
        self.tests.count.next = self.events.val().test;
        self.overflowed.count.next = self.events.val().overflows;
        self.flips.count.next = self.events.val().flip;
        self.root_visits.count.next = self.events.val().root_visit;
        self.revisits.count.next = self.events.val().revisit;
        self.aborts.count.next = self.events.val().aborts;
        self.root_retries.count.next = self.events.val().root_changed;
        self.priorities_taken.count.next = self.events.val().takes_priority;
        self.last_triangles.d.next = 0.into();
        if self.events.val().cavity_ends {
            self.last_triangles.d.next = self.events.val().cavity_triangles;
        }
        self.wide_triangles.next = bit_cast::<32, 7>(self.last_triangles.q.val());
        self.triangles.d.next = self.triangles.q.val() + self.wide_triangles.val();
        if self.zero.val() {
            self.triangles.d.next = 0.into();
        }
        self.value.next = self.chosen.q.val();
        match self.select.val().index() {
            9 => {
                self.chosen.d.next = self.walk_visits.value.val();
            }
            10 => {
                self.chosen.d.next = self.tests.value.val();
            }
            11 => {
                self.chosen.d.next = self.triangles.q.val();
            }
            12 => {
                self.chosen.d.next = self.overflowed.value.val();
            }
            13 => {
                self.chosen.d.next = self.flips.value.val();
            }
            14 => {
                self.chosen.d.next = self.root_visits.value.val();
            }
            15 => {
                self.chosen.d.next = self.revisits.value.val();
            }
            16 => {
                self.chosen.d.next = self.aborts.value.val();
            }
            17 => {
                self.chosen.d.next = self.root_retries.value.val();
            }
            _ => {
                self.chosen.d.next = self.priorities_taken.value.val();
            }
        }
    }
}
