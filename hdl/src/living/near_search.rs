//! Goes round vertices in search of the one nearest to a place, in all contexts side by side.
//!
//! 1. The nearest corner of the record in which a walk has ended is the first *centre*. Two chains of visits go round
//!    the centre, one each way; [`NearLogic`](crate::engine::NearLogic) says where they begin and end.
//! 2. Each visit of a chain rotates its record so that the new corner comes first. If that corner is nearer than the
//!    centre, it becomes the centre at once, and the search begins in that record. A visit of the other chain that is
//!    still in flight counts no more when it completes. It looked for a centre of the other *parity*, which changes
//!    with each new centre; one bit is enough, because visits complete in the order in which they were asked for. So up
//!    to three visits of a context are in flight: two chains, and a chain round the centre before.
//! 3. When both chains have ended, the centre is the nearest vertex, and the item ends. Then none of its visits is in
//!    flight. If a new centre has no chain, while a visit of the old one is in flight, the record is visited once more:
//!    that visit completes behind the other. No mesh needs this visit; it is a guard.
//! 4. In a visit, bit 1 of `entry` says that it belongs to a chain, bit 2 that the chain goes to the left, and bit 3
//!    that the record is visited once more. Bit 0 of `cavity_entry` is the parity, and `cavity_record` the record that
//!    the chain comes from.
//!
//! Latency: none (combinational) from a completed visit to the visits that follow.

use crate::engine::types::{
    context_bits, Bundle, Completion, NearVerdict, RingEntry, TriangleId, Turned, VertexId, Visit, CONTEXT_BITS,
};
use crate::leaf::{LutMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

crate::packed! {
    /// The search of a context.
    pub struct SearchState {
        pub parity: bool,
        /// A visit of the chain to the right is in flight, and one of the chain to the left.
        pub right_goes: bool,
        pub left_goes: bool,
    }
}

/// Number of bits of a [`SearchState`].
pub const SEARCH_BITS: usize = SearchState::BITS;

#[derive(LogicBlock, Default)]
pub struct NearSearch {
    pub clock: Signal<In, Clock>,
    /// The visit that completes, and what it says about the nearest corner of its record.
    pub completion: Signal<In, Completion>,
    pub nearest: Signal<In, NearVerdict>,
    /// `begins`: the visit ends the walk of a search, or visits a record once more. `follows`: it belongs to a chain.
    pub begins: Signal<In, Bit>,
    pub follows: Signal<In, Bit>,
    /// Visits follow, and those visits.
    pub asks: Signal<Out, Bit>,
    pub bundle: Signal<Out, Bundle>,
    /// The item ends, with this vertex.
    pub ends: Signal<Out, Bit>,
    pub vertex: Signal<Out, VertexId>,
    states: LutMemory<CONTEXT_BITS, SEARCH_BITS>,
    stored: Unpack<SearchState, SEARCH_BITS>,
    state: Signal<Local, SearchState>,
    next_state: Signal<Local, SearchState>,
    next_bits: Signal<Local, Bits<SEARCH_BITS>>,
    visit: Signal<Local, Visit>,
    turned: Signal<Local, Turned>,
    entry: Signal<Local, RingEntry>,
    parity_entry: Signal<Local, RingEntry>,
    is_left: Signal<Local, Bit>,
    counts: Signal<Local, Bit>,
    is_nearer: Signal<Local, Bit>,
    restarts: Signal<Local, Bit>,
    stays: Signal<Local, Bit>,
    goes_on: Signal<Local, Bit>,
    other_goes: Signal<Local, Bit>,
    begins_any: Signal<Local, Bit>,
    looks: Signal<Local, Bit>,
    next_parity: Signal<Local, Bit>,
    takes_left: Signal<Local, Bit>,
    left_record: Signal<Local, TriangleId>,
    right_record: Signal<Local, TriangleId>,
    first_slot: Signal<Local, Bits<2>>,
    second_slot: Signal<Local, Bits<2>>,
    third_slot: Signal<Local, Bits<2>>,
}

impl NearSearch {
    /// The searches of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { states: LutMemory::new(context_bits(config), SEARCH_BITS), ..Self::default() }
    }
}

impl Logic for NearSearch {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, states);
        self.first_slot.next = 0.into();
        self.second_slot.next = 1.into();
        self.third_slot.next = 2.into();
        self.visit.next = self.completion.val().visit;
        self.turned.next = self.completion.val().turned;
        self.entry.next = self.visit.val().entry;
        self.parity_entry.next = self.visit.val().cavity_entry;
        self.states.read_address.next = self.visit.val().context;
        self.stored.bits.next = self.states.read_data.val();
        self.state.next = self.stored.value.val();
        self.is_left.next = self.entry.val().get_bit(2);

        // In a record that a chain has come to, the corner in slot 0 is the new one.
        self.counts.next = self.follows.val() & (!(self.parity_entry.val().get_bit(0) ^ self.state.val().parity));
        self.is_nearer.next = self.nearest.val().slot == self.first_slot.val();
        self.restarts.next = self.begins.val() | (self.counts.val() & self.is_nearer.val());
        self.stays.next = self.counts.val() & (!self.is_nearer.val());
        self.goes_on.next = self.nearest.val().goes_right;
        self.other_goes.next = self.state.val().left_goes;
        if self.is_left.val() {
            self.goes_on.next = self.nearest.val().goes_left;
            self.other_goes.next = self.state.val().right_goes;
        }
        self.begins_any.next = self.nearest.val().begins_right | self.nearest.val().begins_left;
        self.looks.next = (!self.begins.val()) & self.is_nearer.val() & (!self.begins_any.val());
        self.asks.next = (self.restarts.val() & self.begins_any.val())
            | (self.counts.val() & self.looks.val() & self.other_goes.val())
            | (self.stays.val() & self.goes_on.val());
        self.ends.next = (self.begins.val() & (!self.begins_any.val()))
            | (self.counts.val() & self.looks.val() & (!self.other_goes.val()))
            | (self.stays.val() & (!self.goes_on.val()) & (!self.other_goes.val()));

        self.next_parity.next = (!self.begins.val()) & (self.state.val().parity ^ self.is_nearer.val());
        self.next_state.next.parity = self.next_parity.val();
        self.next_state.next.right_goes = self.nearest.val().begins_right;
        self.next_state.next.left_goes = self.nearest.val().begins_left;
        if self.stays.val() {
            self.next_state.next.right_goes = self.state.val().right_goes & self.is_left.val();
            self.next_state.next.left_goes = self.state.val().left_goes & (!self.is_left.val());
        }
        self.next_bits.next = self.next_state.val().into();
        self.states.write_address.next = self.visit.val().context;
        self.states.write_data.next = self.next_bits.val();
        self.states.write_enable.next = self.restarts.val() | (self.stays.val() & (!self.goes_on.val()));

        // The chain to the left leaves across the edge opposite the next corner, that to the right across the edge
        // opposite the corner before.
        self.vertex.next = self.turned.val().v0;
        self.left_record.next = self.turned.val().n1;
        self.right_record.next = self.turned.val().n2;
        if self.nearest.val().slot == self.second_slot.val() {
            self.vertex.next = self.turned.val().v1;
            self.left_record.next = self.turned.val().n2;
            self.right_record.next = self.turned.val().n0;
        }
        if self.nearest.val().slot == self.third_slot.val() {
            self.vertex.next = self.turned.val().v2;
            self.left_record.next = self.turned.val().n0;
            self.right_record.next = self.turned.val().n1;
        }
        self.takes_left.next = self.nearest.val().begins_left;
        if self.stays.val() {
            self.takes_left.next = self.is_left.val();
        }
        self.bundle.next.is_pair =
            self.restarts.val() & self.nearest.val().begins_right & self.nearest.val().begins_left;
        self.bundle.next.is_triple = false;
        self.bundle.next.context = self.visit.val().context;
        self.bundle.next.rotates = !self.looks.val();
        self.bundle.next.locks = false;
        self.bundle.next.entry = 2.into();
        self.bundle.next.record = self.right_record.val();
        if self.takes_left.val() {
            self.bundle.next.entry = 6.into();
            self.bundle.next.record = self.left_record.val();
        }
        if self.looks.val() {
            self.bundle.next.entry = 8.into();
            self.bundle.next.record = self.visit.val().record;
        }
        self.bundle.next.after = 2.into();
        self.bundle.next.cavity_entry = 0.into();
        if self.next_parity.val() {
            self.bundle.next.cavity_entry = 1.into();
        }
        self.bundle.next.cavity_record = self.visit.val().record;
        self.bundle.next.second_after = 0.into();
        self.bundle.next.second_record = self.right_record.val();
        self.bundle.next.third_record = 0.into();
    }
}
