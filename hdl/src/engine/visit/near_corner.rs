//! Chooses the corner of a record that is nearest to the point, with its two spokes.
//!
//! 1. The block takes new corners at every edge. There is no reset.
//! 2. The infinite vertex is never the nearest. Of equal distances the smaller point is the nearer, by `x`, then by
//!    `y`. With another rule, a search that goes from a vertex to a nearer neighbour could end at a wrong vertex of a
//!    tie: only the smallest point of a circle is a neighbour of all others.
//! 3. The record comes as rotated; the slot of the corner is that of the record as stored.
//!
//! Latency: corners and record that are valid before edge 1 give the corner after edge `LATENCY` = 10, with all signs
//! of [`VisitPredicates`](crate::predicate::VisitPredicates). `pairs` comes after edge 5; edge 6 is for the corner, 7
//! for its spokes.

use crate::engine::types::{Slot, Turned};
use crate::leaf::FlagDelay;
use crate::predicate::{CornerPairs, Corners, InfiniteCorners, NearSigns, OrderFlags, PairFlags, VertexOrder};
use crate::prelude::*;

#[derive(LogicBlock)]
pub struct NearCorner {
    pub clock: Signal<In, Clock>,
    pub corners: Signal<In, Corners>,
    /// The record, with the flags of its infinite corner and the stored slot that came first.
    pub rotated: Signal<In, Turned>,
    pub pairs: Signal<In, PairFlags>,
    pub nearest: Signal<Out, NearSigns>,
    order: VertexOrder,
    delay_infinite_0: FlagDelay,
    delay_infinite_1: FlagDelay,
    delay_infinite_2: FlagDelay,
    pairs6: DFF<PairFlags>,
    infinite6: DFF<InfiniteCorners>,
    slot6: DFF<Slot>,
    near7: DFF<NearSigns>,
    near8: DFF<NearSigns>,
    near9: DFF<NearSigns>,
    near10: DFF<NearSigns>,
    rank: Signal<Local, OrderFlags>,
    infinite_0: Signal<Local, Bit>,
    infinite_1: Signal<Local, Bit>,
    infinite_2: Signal<Local, Bit>,
    beats_10: Signal<Local, Bit>,
    beats_20: Signal<Local, Bit>,
    beats_21: Signal<Local, Bit>,
    second_slot: Signal<Local, Slot>,
    third_slot: Signal<Local, Slot>,
}

impl NearCorner {
    /// Number of clock edges from the corners to their signs.
    pub const LATENCY: usize = CornerPairs::LATENCY + 5;
}

impl Default for NearCorner {
    fn default() -> Self {
        let delay = || FlagDelay::new(CornerPairs::LATENCY);
        Self {
            clock: Signal::default(),
            corners: Signal::default(),
            rotated: Signal::default(),
            pairs: Signal::default(),
            nearest: Signal::default(),
            order: VertexOrder::new(CornerPairs::LATENCY),
            delay_infinite_0: delay(),
            delay_infinite_1: delay(),
            delay_infinite_2: delay(),
            pairs6: DFF::default(),
            infinite6: DFF::default(),
            slot6: DFF::default(),
            near7: DFF::default(),
            near8: DFF::default(),
            near9: DFF::default(),
            near10: DFF::default(),
            rank: Signal::default(),
            infinite_0: Signal::default(),
            infinite_1: Signal::default(),
            infinite_2: Signal::default(),
            beats_10: Signal::default(),
            beats_20: Signal::default(),
            beats_21: Signal::default(),
            second_slot: Signal::default(),
            third_slot: Signal::default(),
        }
    }
}

impl Logic for NearCorner {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, order, delay_infinite_0, delay_infinite_1, delay_infinite_2);
        dff_setup!(self, clock, pairs6, infinite6, slot6, near7, near8, near9, near10);
        self.second_slot.next = 1.into();
        self.third_slot.next = 2.into();
        self.delay_infinite_0.flag_in.next = self.rotated.val().infinite0;
        self.delay_infinite_1.flag_in.next = self.rotated.val().infinite1;
        self.delay_infinite_2.flag_in.next = self.rotated.val().infinite2;
        if self.rotated.val().slot == self.second_slot.val() {
            self.delay_infinite_0.flag_in.next = self.rotated.val().infinite2;
            self.delay_infinite_1.flag_in.next = self.rotated.val().infinite0;
            self.delay_infinite_2.flag_in.next = self.rotated.val().infinite1;
        }
        if self.rotated.val().slot == self.third_slot.val() {
            self.delay_infinite_0.flag_in.next = self.rotated.val().infinite1;
            self.delay_infinite_1.flag_in.next = self.rotated.val().infinite2;
            self.delay_infinite_2.flag_in.next = self.rotated.val().infinite0;
        }
        self.order.corners.next = self.corners.val();
        self.order.p.next = self.corners.val().r0;

        // Edge 6: which corner of each two is the nearer.
        self.rank.next = self.order.flags.val();
        self.infinite_0.next = self.delay_infinite_0.flag_out.val();
        self.infinite_1.next = self.delay_infinite_1.flag_out.val();
        self.infinite_2.next = self.delay_infinite_2.flag_out.val();
        self.beats_10.next = self.infinite_0.val()
            | ((!self.infinite_1.val())
                & (self.pairs.val().nearer_10 | (self.pairs.val().equal_10 & (!self.rank.val().r0_before_r1))));
        self.beats_20.next = self.infinite_0.val()
            | ((!self.infinite_2.val())
                & (self.pairs.val().nearer_20 | (self.pairs.val().equal_20 & (!self.rank.val().r0_before_r2))));
        self.beats_21.next = self.infinite_1.val()
            | ((!self.infinite_2.val())
                & (self.pairs.val().nearer_21 | (self.pairs.val().equal_21 & (!self.rank.val().r1_before_r2))));
        self.slot6.d.next = 0.into();
        if self.beats_10.val() & (!self.beats_21.val()) {
            self.slot6.d.next = self.second_slot.val();
        }
        if self.beats_20.val() & self.beats_21.val() {
            self.slot6.d.next = self.third_slot.val();
        }
        self.pairs6.d.next = self.pairs.val();
        self.infinite6.d.next.c0 = self.infinite_0.val();
        self.infinite6.d.next.c1 = self.infinite_1.val();
        self.infinite6.d.next.c2 = self.infinite_2.val();

        // Edge 7: the spokes of that corner.
        self.near7.d.next.slot = self.slot6.q.val();
        self.near7.d.next.next_is_ahead = self.pairs6.q.val().ahead_01;
        self.near7.d.next.before_is_ahead = self.pairs6.q.val().ahead_02;
        self.near7.d.next.next_is_infinite = self.infinite6.q.val().c1;
        self.near7.d.next.before_is_infinite = self.infinite6.q.val().c2;
        if self.slot6.q.val() == self.second_slot.val() {
            self.near7.d.next.next_is_ahead = self.pairs6.q.val().ahead_12;
            self.near7.d.next.before_is_ahead = self.pairs6.q.val().ahead_10;
            self.near7.d.next.next_is_infinite = self.infinite6.q.val().c2;
            self.near7.d.next.before_is_infinite = self.infinite6.q.val().c0;
        }
        if self.slot6.q.val() == self.third_slot.val() {
            self.near7.d.next.next_is_ahead = self.pairs6.q.val().ahead_20;
            self.near7.d.next.before_is_ahead = self.pairs6.q.val().ahead_21;
            self.near7.d.next.next_is_infinite = self.infinite6.q.val().c0;
            self.near7.d.next.before_is_infinite = self.infinite6.q.val().c1;
        }
        self.near8.d.next = self.near7.q.val();
        self.near9.d.next = self.near8.q.val();
        self.near10.d.next = self.near9.q.val();
        self.nearest.next = self.near10.q.val();
    }
}
