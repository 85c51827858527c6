//! The item on offer, with what the memories say about its vertex: whether it is in use, whether ids are kept for it,
//! and its word in the vertex memory. That is the point of a vertex in use, and the place of an item that deletes or
//! moves it. For a vertex that keeps ids it is these ids, which an item that inserts it carries as its `target`.
//!
//! 1. Bits and word come two clocks after they are asked for (`asks`), and are kept until the next time.
//! 2. An item of a question stays as it is.
//!
//! Latency: 2 clocks from `asks` to `is_used`, and one more to `offered`; none for a question.

use super::types::{DealtItem, Item};
use crate::engine::types::VertexId;
use crate::predicate::Point;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct CheckedItem {
    pub clock: Signal<In, Clock>,
    /// What was asked for will not come.
    pub drops: Signal<In, Bit>,
    /// The item as it was dealt, whether it is one of a change, and of a deletion or move, and its vertex.
    pub dealt: Signal<In, DealtItem>,
    pub is_change: Signal<In, Bit>,
    pub hole_runs: Signal<In, Bit>,
    pub vertex: Signal<In, VertexId>,
    /// The bits and the word of the vertex are asked for at this edge, and come two clocks later.
    pub asks: Signal<In, Bit>,
    pub bit_in_use: Signal<In, Bit>,
    pub bit_has_ids: Signal<In, Bit>,
    pub fetched: Signal<In, Point>,
    /// The vertex was unknown, so no ids are kept for it.
    pub forgets: Signal<In, Bit>,
    /// The vertex has passed the check.
    pub has_passed: Signal<In, Bit>,
    pub is_used: Signal<Out, Bit>,
    pub offered: Signal<Out, DealtItem>,
    /// They were asked for one clock ago, and two clocks ago.
    asked1: DFF<Bit>,
    asked2: DFF<Bit>,
    kept_use: DFF<Bit>,
    kept_place: DFF<Point>,
    kept_owns: DFF<Bit>,
    dealt_item: Signal<Local, Item>,
    built: Signal<Local, Item>,
}

impl Logic for CheckedItem {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, asked1, asked2, kept_use, kept_place, kept_owns);
        self.asked1.d.next = self.asks.val();
        self.asked2.d.next = self.asked1.q.val();
        self.is_used.next = self.kept_use.q.val();
        if self.asked2.q.val() {
            self.is_used.next = self.bit_in_use.val();
            self.kept_use.d.next = self.bit_in_use.val();
            self.kept_place.d.next = self.fetched.val();
            self.kept_owns.d.next = self.bit_has_ids.val();
        }
        if self.forgets.val() {
            self.kept_owns.d.next = false;
        }
        self.dealt_item.next = self.dealt.val().item;
        self.built.next = self.dealt_item.val();
        if self.is_change.val() {
            self.built.next.vertex = self.vertex.val();
            self.built.next.owns = self.kept_owns.q.val();
        }
        if self.hole_runs.val() {
            self.built.next.place = self.kept_place.q.val();
        } else if self.is_change.val() {
            self.built.next.target = self.kept_place.q.val();
        }
        self.offered.next.context = self.dealt.val().context;
        self.offered.next.item = self.built.val();
        self.offered.next.valid = self.dealt.val().valid & (self.has_passed.val() | (!self.is_change.val()));
        if self.drops.val() {
            self.asked1.d.next = false;
            self.asked2.d.next = false;
        }
    }
}
