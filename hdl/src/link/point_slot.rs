//! The place where a point waits for the engine, and the count of points.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset`, `clears` | in | 1 | reset drops the point; reset and clear set the counts to zero |
//! | `capacity` | in | 15 | points the core holds, a constant |
//! | `collinear` | in | 1 | the first three points are collinear: all others are refused |
//! | `accepts`, `word` | in | 1, 32 | a point comes; only while none waits |
//! | `takes` | in | 1 | the engine takes the waiting point at this edge |
//! | `valid`, `id`, `point` | out | 1, 15, 32 | the waiting point |
//! | `is_new` | out | 1 | it came with the last edge |
//! | `arrived`, `refused` | out | 15, 32 | points that were given an id, and points that were not |
//!
//! 1. `id` and `point` are held until the next point comes.
//!
//! Latency: 1 clock.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The waiting point; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct PointSlot {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Drops the point.
    pub reset: Signal<In, Bit>,
    /// Sets the counts to zero.
    pub clears: Signal<In, Bit>,
    /// Points the core holds.
    pub capacity: Signal<In, Bits<15>>,
    /// Points are refused.
    pub collinear: Signal<In, Bit>,
    /// A point comes.
    pub accepts: Signal<In, Bit>,
    /// It.
    pub word: Signal<In, Bits<32>>,
    /// The waiting point is taken.
    pub takes: Signal<In, Bit>,
    /// A point waits.
    pub valid: Signal<Out, Bit>,
    /// Its vertex id.
    pub id: Signal<Out, Bits<15>>,
    /// Its coordinates.
    pub point: Signal<Out, Bits<32>>,
    /// It came with the last edge.
    pub is_new: Signal<Out, Bit>,
    /// Points with an id.
    pub arrived: Signal<Out, Bits<15>>,
    /// Points refused.
    pub refused: Signal<Out, Bits<32>>,
    waits: DFF<Bit>,
    waiting_id: DFF<Bits<15>>,
    waiting_point: DFF<Bits<32>>,
    came: DFF<Bit>,
    arrivals: DFF<Bits<15>>,
    refusals: DFF<Bits<32>>,
    stores: Signal<Local, Bit>,
    refuses: Signal<Local, Bit>,
    has_room: Signal<Local, Bit>,
    one_arrival: Signal<Local, Bits<15>>,
    one: Signal<Local, Bits<32>>,
}

impl Logic for PointSlot {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, waits, waiting_id, waiting_point, came, arrivals, refusals);
        self.one_arrival.next = 1.into();
        self.one.next = 1.into();
        self.valid.next = self.waits.q.val();
        self.id.next = self.waiting_id.q.val();
        self.point.next = self.waiting_point.q.val();
        self.is_new.next = self.came.q.val();
        self.arrived.next = self.arrivals.q.val();
        self.refused.next = self.refusals.q.val();

        self.has_room.next = (!self.collinear.val()) & (self.arrivals.q.val() != self.capacity.val());
        self.stores.next = self.accepts.val() & self.has_room.val();
        self.refuses.next = self.accepts.val() & (!self.has_room.val());
        self.came.d.next = self.stores.val();
        if self.takes.val() {
            self.waits.d.next = false;
        }
        if self.stores.val() {
            self.waits.d.next = true;
            self.waiting_id.d.next = self.arrivals.q.val();
            self.waiting_point.d.next = self.word.val();
            self.arrivals.d.next = self.arrivals.q.val() + self.one_arrival.val();
        }
        if self.refuses.val() {
            self.refusals.d.next = self.refusals.q.val() + self.one.val();
        }
        if self.clears.val() | self.reset.val() {
            self.arrivals.d.next = 0.into();
            self.refusals.d.next = 0.into();
        }
        if self.reset.val() {
            self.waits.d.next = false;
            self.came.d.next = false;
        }
    }
}
