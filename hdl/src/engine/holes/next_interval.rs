//! Finds the next interval of a hole when the apex of the last one is known. [`FirstChallenge`](super::FirstChallenge)
//! then finds the first test of that interval.
//!
//! 1. The interval before the apex comes first, then the one behind it, which waits meanwhile; then one that waits. An
//!    interval without a vertex between its ends is none.
//! 2. If perhaps no triangle is left, nothing is written until one is found. Then the whole ring is filled anew.
//!
//! Latency: none, the block is combinational.

use super::next_place::NextPlace;
use crate::engine::types::{Hole, RingEntry};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct NextInterval {
    /// The hole, whose apex is known, and the ends of the last interval that waits.
    pub hole: Signal<In, Hole>,
    pub waiting_i: Signal<In, RingEntry>,
    pub waiting_j: Signal<In, RingEntry>,
    /// The hole with its next interval, but with the best apex of the last one; or no interval is left (`ends`).
    pub after: Signal<Out, Hole>,
    pub ends: Signal<Out, Bit>,
    /// The triangle is written; a ring edge is its side before the apex.
    pub writes: Signal<Out, Bit>,
    pub mends: Signal<Out, Bit>,
    /// The interval behind the apex waits.
    pub pushes: Signal<Out, Bit>,
    /// The first place of the whole ring, and the one after it.
    pub start: Signal<Out, RingEntry>,
    pub second: Signal<Out, RingEntry>,
    after_i: NextPlace,
    after_apex: NextPlace,
    after_end: NextPlace,
    after_first: NextPlace,
    has_left: Signal<Local, Bit>,
    has_right: Signal<Local, Bit>,
    restarts: Signal<Local, Bit>,
    some_wait: Signal<Local, Bit>,
    i: Signal<Local, RingEntry>,
    j: Signal<Local, RingEntry>,
    base: Signal<Local, Bits<2>>,
    depth: Signal<Local, Bits<4>>,
    one: Signal<Local, Bits<4>>,
}

impl NextInterval {
    /// The block of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let next = || NextPlace::new(config);
        Self { after_i: next(), after_apex: next(), after_end: next(), after_first: next(), ..Self::default() }
    }
}

impl Logic for NextInterval {
    #[hdl_gen]
    fn update(&mut self) {
        self.one.next = 1.into();
        self.after_i.first.next = self.hole.val().first;
        self.after_i.last.next = self.hole.val().last;
        self.after_apex.first.next = self.hole.val().first;
        self.after_apex.last.next = self.hole.val().last;
        self.after_end.first.next = self.hole.val().first;
        self.after_end.last.next = self.hole.val().last;
        self.after_first.first.next = self.hole.val().first;
        self.after_first.last.next = self.hole.val().last;
        self.after_i.place.next = self.hole.val().i;
        self.after_apex.place.next = self.hole.val().best;
        self.after_end.place.next = self.hole.val().end;
        self.after_first.place.next = self.after_end.after.val();
        self.start.next = self.after_end.after.val();
        self.second.next = self.after_first.after.val();
        self.depth.next = self.hole.val().depth;

        self.has_left.next = self.after_i.after.val() != self.hole.val().best;
        self.has_right.next = self.after_apex.after.val() != self.hole.val().j;
        self.some_wait.next = self.depth.val().any();
        self.restarts.next = self.hole.val().is_dry & self.has_left.val();
        self.writes.next = !self.hole.val().is_dry;
        self.mends.next = !self.has_left.val();
        self.pushes.next = self.has_left.val() & self.has_right.val() & (!self.hole.val().is_dry);
        self.ends.next = (!self.has_left.val()) & (!self.has_right.val()) & (!self.some_wait.val());

        self.i.next = self.waiting_i.val();
        self.j.next = self.waiting_j.val();
        self.base.next = 2.into();
        if self.has_right.val() {
            self.i.next = self.hole.val().best;
            self.j.next = self.hole.val().j;
        }
        if self.has_left.val() {
            self.i.next = self.hole.val().i;
            self.j.next = self.hole.val().best;
            self.base.next = 1.into();
        }
        if self.restarts.val() {
            self.i.next = self.after_end.after.val();
            self.j.next = self.hole.val().end;
            self.base.next = 0.into();
        }
        self.after.next = self.hole.val();
        self.after.next.i = self.i.val();
        self.after.next.j = self.j.val();
        self.after.next.base = self.base.val();
        if self.pushes.val() {
            self.after.next.depth = self.depth.val() + self.one.val();
        }
        if (!self.has_left.val()) & (!self.has_right.val()) {
            self.after.next.depth = self.depth.val() - self.one.val();
        }
        if self.restarts.val() {
            self.after.next.is_dry = false;
            self.after.next.depth = 0.into();
        }
    }
}
