//! Holds the point that has just come, gives it its id, and counts the points.
//!
//! 1. The registers of `arrival.id` and `arrival.point` load at every clock, so that no enable has to reach all of
//!    them.
//! 2. No point comes in the clock of `came`, because the counts are compared in that clock.
//!
//! Latency: 1 clock; 2 to `refused` and `some_refused`.

use super::types::{TakenWord, Tally, VertexCount, Word};
use crate::engine::types::VertexId;
use crate::engine::{Arrival, EngineState};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct PointSlot {
    pub clock: Signal<In, Clock>,
    /// A reset drops the point; reset and `clears` set the counts to zero.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// Number of points that the core holds; a constant.
    pub capacity: Signal<In, VertexCount>,
    /// State of the insertion engine; while it is `collinear` or `stuck`, points are refused.
    pub engine: Signal<In, EngineState>,
    /// The word that the core takes from the command stream, if there is one.
    pub taken: Signal<In, TakenWord>,
    /// The point that came with the last edge, unless it was refused.
    pub arrival: Signal<Out, Arrival>,
    pub tally: Signal<Out, Tally>,
    /// In a core with changes: a run has put this vertex into the mesh, and later points have higher ids.
    pub raises: Vec<Signal<In, Bit>>,
    pub raised: Vec<Signal<In, VertexId>>,
    is_new: DFF<Bit>,
    last_id: DFF<VertexId>,
    last_point: DFF<Word>,
    arrivals: DFF<VertexCount>,
    /// As many points have come as the core holds.
    is_full: DFF<Bit>,
    /// The last point was refused, and is counted now.
    is_surplus: DFF<Bit>,
    refusals: DFF<Word>,
    has_refused: DFF<Bit>,
    stores: Signal<Local, Bit>,
    has_room: Signal<Local, Bit>,
    one_arrival: Signal<Local, VertexCount>,
    one: Signal<Local, Word>,
}

impl PointSlot {
    /// The slot of a core with changes.
    pub fn with_changes() -> Self {
        Self { raises: vec![Signal::default()], raised: vec![Signal::default()], ..Self::default() }
    }
}

impl Logic for PointSlot {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_new, last_id, last_point, arrivals, refusals);
        dff_setup!(self, clock, is_full, is_surplus, has_refused);
        self.one_arrival.next = 1.into();
        self.one.next = 1.into();
        self.arrival.next.came = self.is_new.q.val();
        self.arrival.next.id = self.last_id.q.val();
        self.arrival.next.point = self.last_point.q.val();
        self.tally.next.arrived = self.arrivals.q.val();
        self.tally.next.refused = self.refusals.q.val();
        self.tally.next.some_refused = self.has_refused.q.val();

        self.is_full.d.next = self.arrivals.q.val() == self.capacity.val();
        self.has_room.next = (!self.engine.val().collinear) & (!self.engine.val().stuck) & (!self.is_full.q.val());
        self.stores.next = self.taken.val().is_point & self.has_room.val();
        self.is_surplus.d.next = self.taken.val().is_point & (!self.has_room.val());
        self.is_new.d.next = self.stores.val();
        self.last_id.d.next = self.arrivals.q.val();
        self.last_point.d.next = self.taken.val().word;
        if self.stores.val() {
            self.arrivals.d.next = self.arrivals.q.val() + self.one_arrival.val();
        }
        for i in 0..self.raises.len() {
            if self.raises[i].val() & (self.raised[i].val() >= self.arrivals.q.val()) {
                self.arrivals.d.next = self.raised[i].val() + self.one_arrival.val();
            }
        }
        if self.is_surplus.q.val() {
            self.refusals.d.next = self.refusals.q.val() + self.one.val();
            self.has_refused.d.next = true;
        }
        if self.clears.val() | self.reset.val() {
            self.arrivals.d.next = 0.into();
            self.is_full.d.next = false;
            self.is_surplus.d.next = false;
            self.refusals.d.next = 0.into();
            self.has_refused.d.next = false;
        }
        if self.reset.val() {
            self.is_new.d.next = false;
        }
    }
}
