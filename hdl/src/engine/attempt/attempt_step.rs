//! The state of an attempt after one of its tests.
//!
//! 1. A test is one visit less; if it passes through its edge, two more and one more entry.
//! 2. A failed attempt drains: it is over when its last visit is, not before, because a visit that is out may take a lock (L1).
//! 3. A cavity triangle brings two open edges, the root three; when the last is passed it is an inner one.
//!
//! Latency: none (combinational).

use crate::engine::types::Attempt;
use rust_hdl_core::prelude::*;

/// The step of an attempt; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct AttemptStep {
    /// The state before.
    pub attempt: Signal<In, Attempt>,
    /// Of that state: one visit is out; `half_open` at `f_entry`.
    pub is_last: Signal<In, Bit>,
    pub edge_was_passed: Signal<In, Bit>,
    /// The entry that names the cavity triangle the test came from, a bit each.
    pub entry_bit: Signal<In, Bits<64>>,
    /// The visit took a lock.
    pub took: Signal<In, Bit>,
    /// From `VisitCase`.
    pub is_test: Signal<In, Bit>,
    pub splits: Signal<In, Bit>,
    pub repeats: Signal<In, Bit>,
    pub gives_up: Signal<In, Bit>,
    pub overflows: Signal<In, Bit>,
    /// The state afterwards.
    pub after: Signal<Out, Attempt>,
    /// No visit of the attempt is out any more.
    pub is_over: Signal<Out, Bit>,
    /// And it has not failed: the ring is finished.
    pub succeeds: Signal<Out, Bit>,
    /// The cavity triangle behind the edge has no boundary edge left.
    pub finds_inner: Signal<Out, Bit>,
    /// The second edge of the root is passed.
    pub passes_root: Signal<Out, Bit>,
    fails: Signal<Local, Bit>,
    ends_here: Signal<Local, Bit>,
    passes_second: Signal<Local, Bit>,
    root_keeps_an_edge: Signal<Local, Bit>,
    passes_last_edge: Signal<Local, Bit>,
    half_open: Signal<Local, Bits<64>>,
    second_bit: Signal<Local, Bits<64>>,
    outstanding: Signal<Local, Bits<7>>,
    count: Signal<Local, Bits<7>>,
    inners: Signal<Local, Bits<7>>,
    logged: Signal<Local, Bits<7>>,
    one: Signal<Local, Bits<7>>,
}

impl Logic for AttemptStep {
    #[hdl_gen]
    fn update(&mut self) {
        self.one.next = 1.into();
        self.second_bit.next = 2.into();
        self.outstanding.next = self.attempt.val().outstanding;
        self.count.next = self.attempt.val().count;
        self.inners.next = self.attempt.val().inners;
        self.logged.next = self.attempt.val().logged;
        self.half_open.next = self.attempt.val().half_open;

        // L1: a failed attempt is over when its last visit is in.
        self.fails.next = self.attempt.val().drains | self.gives_up.val() | self.overflows.val();
        self.ends_here.next = self.is_test.val() & self.is_last.val() & (!self.splits.val()) & (!self.repeats.val());
        self.is_over.next = self.ends_here.val();
        self.succeeds.next = self.ends_here.val() & (!self.fails.val());

        // Does the cavity triangle behind the edge keep another one?
        self.root_keeps_an_edge.next = self.entry_bit.val().get_bit(0) & (!self.half_open.val().get_bit(1));
        self.passes_last_edge.next = self.splits.val() & self.edge_was_passed.val() & (!self.root_keeps_an_edge.val());
        self.finds_inner.next = self.passes_last_edge.val();
        self.passes_second.next = self.splits.val() & self.edge_was_passed.val() & self.root_keeps_an_edge.val();
        self.passes_root.next = self.passes_second.val();

        self.after.next = self.attempt.val();
        self.after.next.drains = self.fails.val();
        self.after.next.outstanding = self.outstanding.val() - self.one.val();
        if self.repeats.val() {
            self.after.next.outstanding = self.outstanding.val();
        }
        if self.took.val() {
            self.after.next.logged = self.logged.val() + self.one.val();
        }
        if self.splits.val() {
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
