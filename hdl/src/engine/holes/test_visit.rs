//! The visit that makes the first test of an interval of a hole.
//!
//! 1. A test turns its record and takes no lock, as no other visit of a deletion does. It carries four places of the
//!    ring: beginning and end of the interval, the best apex so far, and the vertex that is tested against it.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{Bundle, Hole, HoleOf};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct TestVisit {
    /// The hole with the interval, and its context.
    pub asked: Signal<In, HoleOf>,
    pub bundle: Signal<Out, Bundle>,
    hole: Signal<Local, Hole>,
}

impl Logic for TestVisit {
    #[hdl_gen]
    fn update(&mut self) {
        self.hole.next = self.asked.val().hole;
        self.bundle.next.is_pair = false;
        self.bundle.next.is_triple = false;
        self.bundle.next.context = self.asked.val().context;
        self.bundle.next.rotates = true;
        self.bundle.next.locks = false;
        self.bundle.next.entry = self.hole.val().i;
        self.bundle.next.after = self.hole.val().j;
        self.bundle.next.cavity_entry = self.hole.val().best;
        self.bundle.next.cavity_record = bit_cast::<15, 6>(self.hole.val().challenger);
        self.bundle.next.record = 0.into();
        self.bundle.next.second_after = 0.into();
        self.bundle.next.second_record = 0.into();
        self.bundle.next.third_record = 0.into();
    }
}
