//! The visits that follow a visit of a deletion.
//!
//! 1. The root asks for the next record to the left, the record outside, and the next record to the right, with the
//!    places 1, 0 and -1. A record of the star asks for the next one of its chain, with its own place as `after`, and
//!    for the record outside, with the mark 32.
//! 2. The test of the last edge of a star that moves has the ends of the two ring edges that meet there: the last
//!    place, the first one and the place after that. It has the mark 64 in `cavity_record`.
//! 3. By default the bundle is the same visit again.
//!
//! Latency: none, the block is combinational.

use super::next_place::NextPlace;
use crate::engine::types::{Bundle, Hole, RingEntry, Star, TriangleId, Turned, Visit};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct StarVisits {
    /// The visit that completes, with its record.
    pub visit: Signal<In, Visit>,
    pub turned: Signal<In, Turned>,
    /// The visit is a root that names the vertex, in slot 1 or 2 if not in slot 0; and the star opens.
    pub names1: Signal<In, Bit>,
    pub names2: Signal<In, Bit>,
    pub opens: Signal<In, Bit>,
    /// The record outside is asked for, and the next record of the chain.
    pub looks_outside: Signal<In, Bit>,
    pub goes_on: Signal<In, Bit>,
    pub onward: Signal<In, TriangleId>,
    pub outside: Signal<In, TriangleId>,
    pub next_place: Signal<In, RingEntry>,
    /// A test of this hole follows.
    pub tests: Signal<In, Bit>,
    pub hole: Signal<In, Hole>,
    /// The last edge of this star is tested.
    pub closes: Signal<In, Bit>,
    pub star: Signal<In, Star>,
    pub bundle: Signal<Out, Bundle>,
    /// The first records of the chains to the left and to the right.
    pub left: Signal<Out, TriangleId>,
    pub right: Signal<Out, TriangleId>,
    first_left: Signal<Local, TriangleId>,
    first_right: Signal<Local, TriangleId>,
    first_outside: Signal<Local, TriangleId>,
    mark: Signal<Local, RingEntry>,
    second: NextPlace,
}

impl StarVisits {
    /// The block of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { second: NextPlace::new(config), ..Self::default() }
    }
}

impl Logic for StarVisits {
    #[hdl_gen]
    fn update(&mut self) {
        self.mark.next = 32.into();
        self.first_left.next = self.turned.val().n1;
        self.first_right.next = self.turned.val().n2;
        self.first_outside.next = self.turned.val().n0;
        if self.names1.val() {
            self.first_left.next = self.turned.val().n2;
            self.first_right.next = self.turned.val().n0;
            self.first_outside.next = self.turned.val().n1;
        }
        if self.names2.val() {
            self.first_left.next = self.turned.val().n0;
            self.first_right.next = self.turned.val().n1;
            self.first_outside.next = self.turned.val().n2;
        }
        self.left.next = self.first_left.val();
        self.right.next = self.first_right.val();

        self.bundle.next.is_pair = self.opens.val() | self.goes_on.val();
        self.bundle.next.is_triple = self.opens.val();
        self.bundle.next.context = self.visit.val().context;
        self.bundle.next.rotates = true;
        self.bundle.next.locks = self.visit.val().locks;
        self.bundle.next.entry = self.visit.val().entry;
        self.bundle.next.after = self.visit.val().after;
        self.bundle.next.cavity_entry = self.visit.val().cavity_entry;
        self.bundle.next.cavity_record = self.visit.val().cavity_record;
        self.bundle.next.record = self.visit.val().record;
        self.bundle.next.second_after = self.mark.val();
        self.bundle.next.second_record = self.outside.val();
        self.bundle.next.third_record = self.first_right.val();
        if self.looks_outside.val() {
            self.bundle.next.after = self.mark.val();
            self.bundle.next.cavity_record = self.visit.val().record;
            self.bundle.next.record = self.outside.val();
        }
        if self.goes_on.val() {
            self.bundle.next.entry = self.next_place.val();
            self.bundle.next.after = self.visit.val().entry;
            self.bundle.next.record = self.onward.val();
        }
        if self.opens.val() {
            self.bundle.next.entry = 1.into();
            self.bundle.next.after = 0.into();
            self.bundle.next.cavity_entry = 0.into();
            self.bundle.next.cavity_record = self.visit.val().record;
            self.bundle.next.record = self.first_left.val();
            self.bundle.next.second_after = 63.into();
            self.bundle.next.second_record = self.first_outside.val();
        }
        if self.tests.val() {
            self.bundle.next.entry = self.hole.val().i;
            self.bundle.next.after = self.hole.val().j;
            self.bundle.next.cavity_entry = self.hole.val().best;
            self.bundle.next.cavity_record = bit_cast::<15, 6>(self.hole.val().challenger);
        }
        self.second.place.next = self.star.val().first;
        self.second.first.next = self.star.val().first;
        self.second.last.next = self.star.val().last;
        if self.closes.val() {
            self.bundle.next.locks = false;
            self.bundle.next.entry = self.star.val().first;
            self.bundle.next.after = self.star.val().last;
            self.bundle.next.cavity_entry = self.second.after.val();
            self.bundle.next.cavity_record = 64.into();
            self.bundle.next.record = 0.into();
        }
    }
}
