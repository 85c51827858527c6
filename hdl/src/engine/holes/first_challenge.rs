//! Finds the first test of an interval of a hole: the first vertex between the ends of the interval is the best apex so
//! far, and the second one is tested against it.
//!
//! 1. An interval with one vertex between its ends has that vertex as its apex, without a test (`is_ready`).
//!
//! Latency: none, the block is combinational.

use super::next_place::NextPlace;
use crate::engine::types::Hole;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct FirstChallenge {
    /// The hole with the ends of its interval, and the same hole with the vertices of the first test.
    pub hole: Signal<In, Hole>,
    pub after: Signal<Out, Hole>,
    /// `is_ready` of `after`, for the state of the user.
    pub is_ready: Signal<Out, Bit>,
    best: NextPlace,
    challenger: NextPlace,
    has_one: Signal<Local, Bit>,
}

impl FirstChallenge {
    /// The block of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { best: NextPlace::new(config), challenger: NextPlace::new(config), ..Self::default() }
    }
}

impl Logic for FirstChallenge {
    #[hdl_gen]
    fn update(&mut self) {
        self.best.place.next = self.hole.val().i;
        self.best.first.next = self.hole.val().first;
        self.best.last.next = self.hole.val().last;
        self.challenger.place.next = self.best.after.val();
        self.challenger.first.next = self.hole.val().first;
        self.challenger.last.next = self.hole.val().last;
        self.has_one.next = self.challenger.after.val() == self.hole.val().j;
        self.is_ready.next = self.has_one.val();
        self.after.next = self.hole.val();
        self.after.next.best = self.best.after.val();
        self.after.next.challenger = self.challenger.after.val();
        self.after.next.is_ready = self.has_one.val();
        self.after.next.is_new = false;
    }
}
