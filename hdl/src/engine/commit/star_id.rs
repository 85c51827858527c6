//! What lies ahead of the current entry of a commit: the entry after it, and the id of the record that one becomes.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `head`, `head_shares` | in | Entry, 1 | the next entry of the list; rule 1 denies it its cavity triangle's id |
//! | `first` | in | Entry | the first entry |
//! | `current_is_last` | in | 1 | the ring closes: the first entry lies ahead |
//! | `inner_id`, `inner_is_used_up` | in | 15, 1 | the next inner triangle, unless there is none left |
//! | `fresh` | in | 15 | the next new id |
//! | `ahead`, `id` | out | Entry, 15 | the entry ahead, and its id |
//! | `is_inner`, `is_fresh` | out | 1 | the id is the inner triangle's, or the new one |
//!
//! 1. An entry takes the id of the cavity triangle behind it, unless the entry before or the first entry took that.
//! 2. The ring entries behind which one cavity triangle lies follow each other, so these two tell all.
//!
//! Latency: none (combinational).

use crate::engine::types::Entry;
use rust_hdl_core::prelude::*;

/// The id rule of the commit; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct StarId {
    /// The next entry of the list.
    pub head: Signal<In, Entry>,
    /// Its cavity triangle has a record already.
    pub head_shares: Signal<In, Bit>,
    /// The first entry.
    pub first: Signal<In, Entry>,
    /// The first entry lies ahead.
    pub current_is_last: Signal<In, Bit>,
    /// The next inner triangle.
    pub inner_id: Signal<In, Bits<15>>,
    /// There is none left.
    pub inner_is_used_up: Signal<In, Bit>,
    /// The next new id.
    pub fresh: Signal<In, Bits<15>>,
    /// The entry ahead.
    pub ahead: Signal<Out, Entry>,
    /// Its id.
    pub id: Signal<Out, Bits<15>>,
    /// It is the inner triangle's.
    pub is_inner: Signal<Out, Bit>,
    /// It is the new one.
    pub is_fresh: Signal<Out, Bit>,
    shares: Signal<Local, Bit>,
}

impl Logic for StarId {
    #[hdl_gen]
    fn update(&mut self) {
        self.shares.next = self.head_shares.val() & (!self.current_is_last.val());
        self.is_inner.next = self.shares.val() & (!self.inner_is_used_up.val());
        self.is_fresh.next = self.shares.val() & self.inner_is_used_up.val();
        self.ahead.next = self.head.val();
        self.id.next = self.head.val().f;
        if self.shares.val() {
            self.id.next = self.inner_id.val();
            if self.inner_is_used_up.val() {
                self.id.next = self.fresh.val();
            }
        }
        if self.current_is_last.val() {
            self.ahead.next = self.first.val();
            self.id.next = self.first.val().f;
        }
    }
}
