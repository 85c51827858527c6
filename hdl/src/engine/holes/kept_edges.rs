//! Whether a vertex that moves keeps its edges, as far as the completed visit can tell (M12), which is judged by the
//! new place ([`MovedStar`](crate::engine::MovedStar)); and the vertices that the chains round its star carry.
//!
//! 1. At the root, the triangle must turn left. So must a record of the star, and the edge to the record before must
//!    stay. A record outside must not conflict with the new place.
//! 2. An edge of the star ends at a vertex of the ring. It is lost if and only if that vertex and its two neighbours in
//!    the ring turn left and their circle leaves the new place out. The edge at which the chains meet has a visit of
//!    its own.
//! 3. The carried vertex of a chain is the corner that the next record does not have: `v2` of the record to the left,
//!    `v1` of the one to the right.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{Carried, RingEntry, Slot, Turned, VertexId, Visit};
use crate::predicate::EdgeFlags;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct KeptEdges {
    /// The visit that completes with its record; the root that opens a star, and the slot of the vertex in it.
    pub visit: Signal<In, Visit>,
    pub turned: Signal<In, Turned>,
    pub opens: Signal<In, Bit>,
    pub names1: Signal<In, Bit>,
    pub names2: Signal<In, Bit>,
    /// The visit lies outside the star; it is the test of the last edge; a record of the star counts.
    pub is_outside: Signal<In, Bit>,
    pub is_last_edge: Signal<In, Bit>,
    pub goes_round: Signal<In, Bit>,
    /// The point against the sides of the corners as stored; whether it conflicts with them; whether they turn left.
    pub flags: Signal<In, EdgeFlags>,
    pub conflict: Signal<In, Bit>,
    pub turns_left: Signal<In, Bit>,
    pub keeps: Signal<Out, Bit>,
    pub carried: Signal<Out, Carried>,
    is_right: Signal<Local, Bit>,
    entry: Signal<Local, RingEntry>,
    slot: Signal<Local, Slot>,
    first_slot: Signal<Local, Slot>,
    second_slot: Signal<Local, Slot>,
    stored_first: Signal<Local, Bit>,
    stored_second: Signal<Local, Bit>,
    is_left0: Signal<Local, Bit>,
    is_left1: Signal<Local, Bit>,
    is_left2: Signal<Local, Bit>,
    turns: Signal<Local, Bit>,
    stays: Signal<Local, Bit>,
    root_left: Signal<Local, VertexId>,
    root_right: Signal<Local, VertexId>,
}

impl Logic for KeptEdges {
    #[hdl_gen]
    fn update(&mut self) {
        self.first_slot.next = 0.into();
        self.second_slot.next = 1.into();
        self.entry.next = self.visit.val().entry;
        self.is_right.next = self.entry.val().get_bit(5);
        self.slot.next = self.turned.val().slot;
        self.is_left0.next = (!self.flags.val().e0_negative) & (!self.flags.val().e0_zero);
        self.is_left1.next = (!self.flags.val().e1_negative) & (!self.flags.val().e1_zero);
        self.is_left2.next = (!self.flags.val().e2_negative) & (!self.flags.val().e2_zero);

        // In a record of the star, the vertex stands in slot 1 to the left and in slot 2 to the right, as turned.
        self.stored_first.next = self.slot.val() == self.first_slot.val();
        self.stored_second.next = self.slot.val() == self.second_slot.val();
        self.turns.next = self.is_left0.val();
        if self.stored_first.val() {
            self.turns.next = self.is_left1.val();
        }
        if self.stored_second.val() {
            self.turns.next = self.is_left2.val();
        }
        if self.is_right.val() {
            self.turns.next = self.is_left1.val();
            if self.stored_first.val() {
                self.turns.next = self.is_left2.val();
            }
            if self.stored_second.val() {
                self.turns.next = self.is_left0.val();
            }
        }
        self.stays.next = (!self.turns_left.val()) | self.conflict.val();
        self.keeps.next = self.turns.val() & self.stays.val();
        if self.is_outside.val() {
            self.keeps.next = !self.conflict.val();
        }
        if self.is_last_edge.val() {
            self.keeps.next = self.stays.val();
        }

        // A root comes as stored.
        self.root_left.next = self.turned.val().v1;
        self.root_right.next = self.turned.val().v2;
        if self.names1.val() {
            self.root_left.next = self.turned.val().v2;
            self.root_right.next = self.turned.val().v0;
        }
        if self.names2.val() {
            self.root_left.next = self.turned.val().v0;
            self.root_right.next = self.turned.val().v1;
        }
        self.carried.next.context = self.visit.val().context;
        self.carried.next.sets_left = self.goes_round.val() & (!self.is_right.val());
        self.carried.next.sets_right = self.goes_round.val() & self.is_right.val();
        self.carried.next.left = self.turned.val().v2;
        self.carried.next.right = self.turned.val().v1;
        if self.opens.val() {
            self.keeps.next = self.is_left0.val();
            if self.names1.val() {
                self.keeps.next = self.is_left1.val();
            }
            if self.names2.val() {
                self.keeps.next = self.is_left2.val();
            }
            self.carried.next.sets_left = true;
            self.carried.next.sets_right = true;
            self.carried.next.left = self.root_left.val();
            self.carried.next.right = self.root_right.val();
        }
    }
}
