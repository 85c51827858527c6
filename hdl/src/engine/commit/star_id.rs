//! What lies ahead of the current entry of a commit: the entry after it, and the id of the record that one becomes.
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
    /// The next entry of the list; rule 1 denies it its cavity triangle's id.
    pub head: Signal<In, Entry>,
    pub head_shares: Signal<In, Bit>,
    /// The first entry.
    pub first: Signal<In, Entry>,
    /// The ring closes: the first entry lies ahead.
    pub current_is_last: Signal<In, Bit>,
    /// The next inner triangle, unless there is none left.
    pub inner_id: Signal<In, Bits<15>>,
    pub inner_is_used_up: Signal<In, Bit>,
    /// The next new id.
    pub fresh: Signal<In, Bits<15>>,
    /// The entry ahead, and its id.
    pub ahead: Signal<Out, Entry>,
    pub id: Signal<Out, Bits<15>>,
    /// The id is the inner triangle's, or the new one.
    pub is_inner: Signal<Out, Bit>,
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
