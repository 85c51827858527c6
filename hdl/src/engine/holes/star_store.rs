//! The stars of all contexts. The star of a context is at hand in the clock in which one of its visits completes, and
//! changes in the same clock.
//!
//! 1. A visit sees the effects of all visits before it, also of one in the clock before.
//! 2. Whether the next record of a chain is the head of the other one (`meets`) is found a clock ahead, because the
//!    comparison takes long: against the stored head, and against the one that the visit before has left.
//! 3. A root that opens a star begins a new one: with three visits in flight, three records, and the lock of the root.
//!
//! Latency: 1 clock from `early_visit` to `held`.

use crate::engine::types::{context_bits, RingCount, RingEntry, Star, TriangleId, Visit, CONTEXT_BITS, STAR_BITS};
use crate::leaf::{LutMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct StarStore {
    pub clock: Signal<In, Clock>,
    /// The visit that completes in the next clock, and the one that completes in this clock.
    pub early_visit: Signal<In, Visit>,
    pub visit: Signal<In, Visit>,
    /// The star of the visit of this clock, and its state after the visit (`changes`).
    pub held: Signal<Out, Star>,
    pub changes: Signal<In, Bit>,
    pub after: Signal<In, Star>,
    /// The next record of the chain of either visit, if it is one of a star; the one of this clock becomes the head of
    /// its chain (`goes`); and whether the next record of this clock's visit is the head of the other chain.
    pub early_next: Signal<In, TriangleId>,
    pub onward: Signal<In, TriangleId>,
    pub goes: Signal<In, Bit>,
    pub meets: Signal<Out, Bit>,
    /// The visit is a root that opens a star, the first records of the chains to the left and to the right, and whether
    /// the root's triangle turns left at the new place of a vertex that moves.
    pub opens: Signal<In, Bit>,
    pub keeps: Signal<In, Bit>,
    pub left: Signal<In, TriangleId>,
    pub right: Signal<In, TriangleId>,
    /// The number of entries that a ring can have, a constant.
    pub ring_capacity: Signal<In, RingCount>,
    stars: LutMemory<CONTEXT_BITS, STAR_BITS>,
    stored: Unpack<Star, STAR_BITS>,
    written: Signal<Local, Bits<STAR_BITS>>,
    state: DFF<Star>,
    met: DFF<Bit>,
    early_entry: Signal<Local, RingEntry>,
    entry: Signal<Local, RingEntry>,
    is_early_right: Signal<Local, Bit>,
    has_new_head: Signal<Local, Bit>,
    stored_head: Signal<Local, TriangleId>,
    held_head: Signal<Local, TriangleId>,
    new_state: Signal<Local, Star>,
    is_written: Signal<Local, Bit>,
    goes_round: Signal<Local, Bit>,
    three: Signal<Local, RingCount>,
}

impl StarStore {
    pub fn new(config: Config) -> Self {
        Self { stars: LutMemory::new(context_bits(config), STAR_BITS), ..Self::default() }
    }
}

impl Logic for StarStore {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, met);
        clock!(self, clock, stars);
        self.three.next = 3.into();
        self.held.next = self.state.q.val();
        self.new_state.next = self.after.val();
        if self.opens.val() {
            self.new_state.next.left_head = self.left.val();
            self.new_state.next.right_head = self.right.val();
            self.new_state.next.first = 0.into();
            self.new_state.next.last = 0.into();
            self.new_state.next.has_infinite = false;
            self.new_state.next.infinite = 0.into();
            self.new_state.next.has_triangle = false;
            self.new_state.next.drains = false;
            self.new_state.next.is_too_long = false;
            self.new_state.next.keeps = self.keeps.val();
            self.new_state.next.outstanding = 3.into();
            self.new_state.next.count = 3.into();
            self.new_state.next.logged = 1.into();
            self.new_state.next.is_one = false;
            self.new_state.next.is_full = self.ring_capacity.val() == self.three.val();
        }
        self.is_written.next = self.changes.val() | self.opens.val();
        self.written.next = self.new_state.val().into();
        self.stars.write_address.next = self.visit.val().context;
        self.stars.write_data.next = self.written.val();
        self.stars.write_enable.next = self.is_written.val();
        self.stars.read_address.next = self.early_visit.val().context;
        self.stored.bits.next = self.stars.read_data.val();
        self.goes_round.next = self.is_written.val() & (self.early_visit.val().context == self.visit.val().context);
        self.state.d.next = self.stored.value.val();

        self.early_entry.next = self.early_visit.val().entry;
        self.entry.next = self.visit.val().entry;
        self.is_early_right.next = self.early_entry.val().get_bit(5);
        self.stored_head.next = self.stored.value.val().right_head;
        self.held_head.next = self.state.q.val().right_head;
        if self.is_early_right.val() {
            self.stored_head.next = self.stored.value.val().left_head;
            self.held_head.next = self.state.q.val().left_head;
        }
        self.has_new_head.next = self.goes.val() & (self.is_early_right.val() != self.entry.val().get_bit(5));
        self.met.d.next = self.early_next.val() == self.stored_head.val();
        if self.goes_round.val() {
            self.state.d.next = self.new_state.val();
            self.met.d.next = self.early_next.val() == self.held_head.val();
            if self.has_new_head.val() {
                self.met.d.next = self.early_next.val() == self.onward.val();
            }
        }
        self.meets.next = self.met.q.val();
    }
}
