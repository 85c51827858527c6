//! The state of an attempt after one of its tests.
//!
//! 1. A test that completes leaves one visit fewer in flight. If the tested record joins the cavity, two new visits and
//!    one new entry come.
//! 2. An aborted attempt drains: it is over when its last visit completes and not before, because a visit in flight may
//!    still take a lock (L1).
//! 3. A record that joins the cavity brings two open edges, the root brings three. When the records behind all of them
//!    have joined the cavity too, the record is an inner one.
//!
//! Latency: none, the block is combinational.

use super::attempt_store::Held;
use crate::engine::types::{Attempt, Case, LockCount, RingCount, Step};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct AttemptStep {
    /// The state before the test, with the flags that are kept beside it.
    pub held: Signal<In, Held>,
    /// The visit took a lock.
    pub took: Signal<In, Bit>,
    /// The case of the visit.
    pub found: Signal<In, Case>,
    /// The state after the test, and its effect on the attempt.
    pub after: Signal<Out, Attempt>,
    pub step: Signal<Out, Step>,
    attempt: Signal<Local, Attempt>,
    entry_bit: Signal<Local, Bits<64>>,
    fails: Signal<Local, Bit>,
    ends_here: Signal<Local, Bit>,
    passes_second: Signal<Local, Bit>,
    root_keeps_an_edge: Signal<Local, Bit>,
    passes_last_edge: Signal<Local, Bit>,
    half_open: Signal<Local, Bits<64>>,
    second_bit: Signal<Local, Bits<64>>,
    outstanding: Signal<Local, RingCount>,
    count: Signal<Local, RingCount>,
    inners: Signal<Local, RingCount>,
    logged: Signal<Local, LockCount>,
    one: Signal<Local, RingCount>,
}

impl Logic for AttemptStep {
    #[hdl_gen]
    fn update(&mut self) {
        self.one.next = 1.into();
        self.second_bit.next = 2.into();
        self.attempt.next = self.held.val().attempt;
        self.entry_bit.next = self.held.val().entry_bit;
        self.outstanding.next = self.attempt.val().outstanding;
        self.count.next = self.attempt.val().count;
        self.inners.next = self.attempt.val().inners;
        self.logged.next = self.attempt.val().logged;
        self.half_open.next = self.attempt.val().half_open;

        // L1: visits in flight may still take locks, so an aborted attempt lasts until its last visit has completed.
        self.fails.next = self.attempt.val().drains | self.found.val().aborts | self.found.val().overflows;
        self.ends_here.next = self.found.val().is_test
            & self.held.val().is_last
            & (!self.found.val().splits)
            & (!self.found.val().revisits);
        self.step.next.is_over = self.ends_here.val();
        self.step.next.succeeds = self.ends_here.val() & (!self.fails.val());

        // The root has three edges and so two bits: its first edge sets bit 0, the second bit 1, and only the third
        // makes the root an inner record. For all other cavity records the second edge does.
        self.root_keeps_an_edge.next = self.entry_bit.val().get_bit(0) & (!self.half_open.val().get_bit(1));
        self.passes_last_edge.next =
            self.found.val().splits & self.held.val().edge_was_passed & (!self.root_keeps_an_edge.val());
        self.step.next.finds_inner = self.passes_last_edge.val();
        self.passes_second.next =
            self.found.val().splits & self.held.val().edge_was_passed & self.root_keeps_an_edge.val();
        self.step.next.passes_root = self.passes_second.val();

        self.after.next = self.attempt.val();
        self.after.next.drains = self.fails.val();
        self.after.next.outstanding = self.outstanding.val() - self.one.val();
        if self.found.val().revisits {
            self.after.next.outstanding = self.outstanding.val();
        }
        if self.took.val() {
            self.after.next.logged = self.logged.val() + self.one.val();
        }
        if self.found.val().splits {
            self.after.next.outstanding = self.outstanding.val() + self.one.val();
            self.after.next.count = self.count.val() + self.one.val();
            self.after.next.half_open = self.half_open.val() | self.entry_bit.val();
            if self.passes_second.val() {
                self.after.next.half_open = self.half_open.val() | self.second_bit.val();
            }
        }
        if self.passes_last_edge.val() {
            self.after.next.inners = self.inners.val() + self.one.val();
        }
    }
}
