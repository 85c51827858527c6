//! Reads the record of a visit, rotates it by the edge it was reached through, and passes on the coordinates of its
//! corners. A test then finds the edge it came across opposite slot 0, whatever the stored order.
//!
//! 1. With `visit.rotates` the slot whose neighbour is `visit.cavity_record` comes first, otherwise slot 0 does. The
//!    neighbours of a record differ, so the slot is unique.
//! 2. `took`, `foreign` and `again` pass unchanged into `turned`.
//! 3. No logic stands between the output of a memory and the first register, because block RAM lies far from all other
//!    logic. The corners therefore stay as stored, and `VerdictLogic` allows for the rotation.
//!
//! Latency: see the clocks named at the ports; `LATENCY` is that of the corners.
//!
//! A visit reaches its record through neighbour 1, so that vertex 1 comes first, and takes the lock:
//! ```text
//! visit.cavity_record  30  .  .  .  .  .  .
//! n1                    .  . 30  .  .  .  .
//! v0                    .  . 11  .  .  .  .
//! v1                    .  . 12  .  .  .  .
//! again               ______/^^\___________
//! took                _________/^^\________
//! turned.v0             .  .  .  .  . 12  .
//! turned.slot           .  .  .  .  .  1  .
//! turned.again          .  .  .  .  ./^^  .
//! turned.took           .  .  .  .  ./^^  .
//! position0             .  .  .  . 51  .  .
//! r0                    .  .  .  .  . 51  .
//! ```

use crate::engine::types::{Slot, Turned, VertexId, Visit};
use crate::mesh::{Record, TriangleStore, VertexStore};
use crate::predicate::Corners;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct VisitReader {
    pub clock: Signal<In, Clock>,
    /// The number of the infinite vertex, a constant.
    pub infinite: Signal<In, VertexId>,
    /// The visit, in clock 0.
    pub visit: Signal<In, Visit>,
    /// The record of the visit from the triangle memory, in clock 2.
    pub record: Signal<In, Record>,
    /// The record is not written yet or is being written; in clock 2.
    pub again: Signal<In, Bit>,
    /// The outcome for the lock, in clock 3.
    pub took: Signal<In, Bit>,
    pub foreign: Signal<In, Bit>,
    /// The coordinates of the vertices, in clock 4.
    pub stored_corners: Signal<In, Corners>,
    /// The rotated record, in clock 5.
    pub turned: Signal<Out, Turned>,
    /// The visit in clock 2, for the delay line that carries it to the verdict.
    pub visit_at_record: Signal<Out, Visit>,
    /// The coordinates of the vertices, not rotated, in clock 5.
    pub corners: Signal<Out, Corners>,
    visit1: DFF<Visit>,
    visit2: DFF<Visit>,
    visit3: DFF<Visit>,
    /// The record as it comes from the memory.
    stored: DFF<Turned>,
    /// The record as stored; `slot` is the one that will come first.
    found: DFF<Turned>,
    rotated: DFF<Turned>,
    kept_corners: DFF<Corners>,
    first_slot: Signal<Local, Slot>,
    second_slot: Signal<Local, Slot>,
    third_slot: Signal<Local, Slot>,
}

impl VisitReader {
    /// The number of clocks from the visit to the corners.
    pub const LATENCY: usize = TriangleStore::LATENCY + VertexStore::LATENCY + 1;
    /// The number of clocks from the visit to the rotated record: memory, register, slot search, rotation.
    pub const TURNED_LATENCY: usize = TriangleStore::LATENCY + 3;
}

impl Logic for VisitReader {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, visit1, visit2, visit3, stored, found, rotated, kept_corners);
        self.first_slot.next = 0.into();
        self.second_slot.next = 1.into();
        self.third_slot.next = 2.into();
        self.visit1.d.next = self.visit.val();
        self.visit2.d.next = self.visit1.q.val();
        self.visit_at_record.next = self.visit2.q.val();

        // Clock 2 only stores the record: the memory's output has no time left for logic.
        self.visit3.d.next = self.visit2.q.val();
        self.stored.d.next.v0 = self.record.val().v0;
        self.stored.d.next.v1 = self.record.val().v1;
        self.stored.d.next.v2 = self.record.val().v2;
        self.stored.d.next.n0 = self.record.val().n0;
        self.stored.d.next.n1 = self.record.val().n1;
        self.stored.d.next.n2 = self.record.val().n2;
        self.stored.d.next.again = self.again.val();

        // Clock 3 searches the slot that comes first. The outcome for the lock joins here, because it comes a
        // clock after the record.
        self.found.d.next = self.stored.q.val();
        self.found.d.next.took = self.took.val();
        self.found.d.next.foreign = self.foreign.val();
        self.found.d.next.infinite0 = self.stored.q.val().v0 == self.infinite.val();
        self.found.d.next.infinite1 = self.stored.q.val().v1 == self.infinite.val();
        self.found.d.next.infinite2 = self.stored.q.val().v2 == self.infinite.val();
        self.found.d.next.slot = self.first_slot.val();
        if self.visit3.q.val().rotates & (self.stored.q.val().n1 == self.visit3.q.val().cavity_record) {
            self.found.d.next.slot = self.second_slot.val();
        }
        if self.visit3.q.val().rotates & (self.stored.q.val().n2 == self.visit3.q.val().cavity_record) {
            self.found.d.next.slot = self.third_slot.val();
        }

        // Clock 4 rotates the record by the slot that is now known.
        self.rotated.d.next = self.found.q.val();
        if self.found.q.val().slot == self.second_slot.val() {
            self.rotated.d.next.v0 = self.found.q.val().v1;
            self.rotated.d.next.v1 = self.found.q.val().v2;
            self.rotated.d.next.v2 = self.found.q.val().v0;
            self.rotated.d.next.n0 = self.found.q.val().n1;
            self.rotated.d.next.n1 = self.found.q.val().n2;
            self.rotated.d.next.n2 = self.found.q.val().n0;
            self.rotated.d.next.infinite0 = self.found.q.val().infinite1;
            self.rotated.d.next.infinite1 = self.found.q.val().infinite2;
            self.rotated.d.next.infinite2 = self.found.q.val().infinite0;
        }
        if self.found.q.val().slot == self.third_slot.val() {
            self.rotated.d.next.v0 = self.found.q.val().v2;
            self.rotated.d.next.v1 = self.found.q.val().v0;
            self.rotated.d.next.v2 = self.found.q.val().v1;
            self.rotated.d.next.n0 = self.found.q.val().n2;
            self.rotated.d.next.n1 = self.found.q.val().n0;
            self.rotated.d.next.n2 = self.found.q.val().n1;
            self.rotated.d.next.infinite0 = self.found.q.val().infinite2;
            self.rotated.d.next.infinite1 = self.found.q.val().infinite0;
            self.rotated.d.next.infinite2 = self.found.q.val().infinite1;
        }
        self.turned.next = self.rotated.q.val();

        self.kept_corners.d.next = self.stored_corners.val();
        self.corners.next = self.kept_corners.q.val();
    }
}
