//! The record id of the ring entry ahead of a commit.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `ahead`, `ahead_is_first` | in | Entry, 1 | the entry ahead, and whether the ring has closed there |
//! | `current`, `first` | in | Entry | the entry before it, and the first one |
//! | `inner_id`, `inner_is_used_up` | in | 15, 1 | the next inner triangle, unless there is none left |
//! | `records` | in | 15 | the next new id |
//! | `id` | out | 15 | the id |
//! | `shares` | out | 1 | its cavity triangle's id is taken: it is an inner triangle's or a new one |
//!
//! 1. The ring entries behind which one cavity triangle lies follow each other, so two comparisons tell.
//!
//! Latency: none (combinational).

use super::Entry;
use rust_hdl_core::prelude::*;

/// The id rule of the commit; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct StarId {
    /// The entry ahead.
    pub ahead: Signal<In, Entry>,
    /// It is the first again.
    pub ahead_is_first: Signal<In, Bit>,
    /// The entry before it.
    pub current: Signal<In, Entry>,
    /// The first entry.
    pub first: Signal<In, Entry>,
    /// The next inner triangle.
    pub inner_id: Signal<In, Bits<15>>,
    /// There is none left.
    pub inner_is_used_up: Signal<In, Bit>,
    /// The next new id.
    pub records: Signal<In, Bits<15>>,
    /// The id.
    pub id: Signal<Out, Bits<15>>,
    /// It is not that of the cavity triangle behind.
    pub shares: Signal<Out, Bit>,
    is_taken: Signal<Local, Bit>,
}

impl Logic for StarId {
    #[hdl_gen]
    fn update(&mut self) {
        self.is_taken.next = (!self.ahead_is_first.val())
            & ((self.ahead.val().f == self.current.val().f) | (self.ahead.val().f == self.first.val().f));
        self.shares.next = self.is_taken.val();
        self.id.next = self.ahead.val().f;
        if self.ahead_is_first.val() {
            self.id.next = self.first.val().f;
        }
        if self.is_taken.val() {
            self.id.next = self.inner_id.val();
            if self.inner_is_used_up.val() {
                self.id.next = self.records.val();
            }
        }
    }
}
