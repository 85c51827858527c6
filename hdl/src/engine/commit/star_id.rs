//! What lies ahead of the current entry of a commit: the entry after it, and the id of the record that one becomes.
//!
//! 1. An entry takes the id of the cavity triangle behind it, unless the entry before or the first entry took that.
//! 2. The ring entries behind which one cavity triangle lies follow each other, so these two tell all.
//!
//! Latency: none (combinational).

use crate::engine::types::{Entry, RingHead, TriangleId};
use rust_hdl_core::prelude::*;

/// The id rule of the commit; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct StarId {
    /// The next entry of the list; rule 1 may deny it its cavity triangle's id.
    pub head: Signal<In, RingHead>,
    /// The first entry.
    pub first: Signal<In, Entry>,
    /// The ring closes: the first entry lies ahead.
    pub current_is_last: Signal<In, Bit>,
    /// The next inner triangle, unless there is none left.
    pub inner_id: Signal<In, TriangleId>,
    pub inner_is_used_up: Signal<In, Bit>,
    /// The next new id.
    pub fresh: Signal<In, TriangleId>,
    /// The entry ahead, and its id.
    pub ahead: Signal<Out, Entry>,
    pub id: Signal<Out, TriangleId>,
    /// The id is the inner triangle's, or the new one.
    pub is_inner: Signal<Out, Bit>,
    pub is_fresh: Signal<Out, Bit>,
    entry: Signal<Local, Entry>,
    shares: Signal<Local, Bit>,
}

impl Logic for StarId {
    #[hdl_gen]
    fn update(&mut self) {
        self.entry.next = self.head.val().entry;
        self.shares.next = self.head.val().shares & (!self.current_is_last.val());
        self.is_inner.next = self.shares.val() & (!self.inner_is_used_up.val());
        self.is_fresh.next = self.shares.val() & self.inner_is_used_up.val();
        self.ahead.next = self.entry.val();
        self.id.next = self.entry.val().cavity_record;
        if self.shares.val() {
            self.id.next = self.inner_id.val();
            if self.inner_is_used_up.val() {
                self.id.next = self.fresh.val();
            }
        }
        if self.current_is_last.val() {
            self.ahead.next = self.first.val();
            self.id.next = self.first.val().cavity_record;
        }
    }
}
