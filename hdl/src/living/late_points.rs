//! Makes items of the points of an `Insert` into a mesh that a run has changed, and deals them to the contexts in turn.
//!
//! 1. After a change, the order in which ids come is no longer the one by which the insertion engine deals points. So
//!    each point waits here until its context takes it as an item.
//! 2. The next point comes when the one before has been taken (`holds`).
//!
//! Latency: a point is on offer in the clock after it came.

use super::types::{DealtItem, Item, Launch};
use crate::engine::types::{Arrival, ContextId};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LatePoints {
    pub clock: Signal<In, Clock>,
    /// Reset and clear drop the point, and the next one goes to context 0.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// The mesh has been changed by a run; the number of contexts that work.
    pub has_changed: Signal<In, Bit>,
    pub contexts: Signal<In, ContextId>,
    pub arrival: Signal<In, Arrival>,
    pub holds: Signal<Out, Bit>,
    pub dealt: Signal<Out, DealtItem>,
    pub taken: Signal<In, Bit>,
    is_held: DFF<Bit>,
    held: DFF<Launch>,
    turn: DFF<ContextId>,
    item: Signal<Local, Item>,
    turn_after: Signal<Local, ContextId>,
    one_turn: Signal<Local, ContextId>,
}

impl Logic for LatePoints {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_held, held, turn);
        self.one_turn.next = 1.into();
        self.holds.next = self.is_held.q.val();
        self.dealt.next.valid = self.is_held.q.val();
        self.dealt.next.context = self.held.q.val().context;
        self.dealt.next.item = self.held.q.val().item;
        self.item.next.number = 0.into();
        self.item.next.place = self.arrival.val().point;
        self.item.next.vertex = self.arrival.val().id;
        self.item.next.owns = false;
        self.item.next.target = self.arrival.val().point;
        self.turn_after.next = self.turn.q.val() + self.one_turn.val();
        if self.taken.val() {
            self.is_held.d.next = false;
        }
        if self.arrival.val().came & self.has_changed.val() {
            self.is_held.d.next = true;
            self.held.d.next.context = self.turn.q.val();
            self.held.d.next.item = self.item.val();
            self.turn.d.next = self.turn_after.val();
            if self.turn_after.val() == self.contexts.val() {
                self.turn.d.next = 0.into();
            }
        }
        if self.reset.val() | self.clears.val() {
            self.is_held.d.next = false;
            self.turn.d.next = 0.into();
        }
    }
}
