//! The entry ahead of the current entry of a commit, and the id that its record takes.
//!
//! 1. A record takes the id of the cavity record behind its entry, unless the entry before or the first entry
//!    has taken that id.
//! 2. Ring entries along one cavity record follow each other, so a comparison with these two finds every
//!    id that is taken.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{Entry, RingHead, TriangleId};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct StarId {
    /// The next entry of the ring reader; its flag `shares` says that rule 1 denies it the id of its cavity record.
    pub head: Signal<In, RingHead>,
    /// The first entry of the ring.
    pub first: Signal<In, Entry>,
    /// The ring closes: the first entry lies ahead.
    pub current_is_last: Signal<In, Bit>,
    /// The id of the next inner record, unless the list is used up.
    pub inner_id: Signal<In, TriangleId>,
    pub inner_is_used_up: Signal<In, Bit>,
    /// The next new id.
    pub fresh: Signal<In, TriangleId>,
    /// The entry ahead, and the id of its record.
    pub ahead: Signal<Out, Entry>,
    pub id: Signal<Out, TriangleId>,
    /// The id is that of an inner record (`is_inner`) or a new one (`is_fresh`).
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
