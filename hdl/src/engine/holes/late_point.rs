//! The point of a move in place, or the word that takes the place of the point of a vertex that is out of the mesh
//! ([`KeptIds`](crate::engine::KeptIds)). It waits for a clock in which no visit fetches a fourth point: both use one
//! port of the vertex memory, and a visit that meets the write is made again (M14).
//!
//! 1. A point comes into a register, and from the clock after that it has five clocks. It is written in the first of
//!    them in which no visit fetches; and, whatever is fetched, in the last of them and in that in which the next point
//!    stands in the register. So one place behind the register is enough.
//! 2. The port is free for it. A vertex that goes back into the mesh stores its point in the clock after its item has
//!    begun. Such an item begins only while no point waits, in the register or behind it (`waits`). A point that comes
//!    in the clock in which it begins is written two clocks later at the earliest. In a run of `InsertAs` every item
//!    stores its point, and no visit fetches, so a word is written two clocks after it has come. An item would have to
//!    begin in the clock between the two to meet it. In that clock a vertex falls out of use, and no item begins. In a
//!    run of `Delete` no item stores a point.
//! 3. The write comes 6 clocks after the end of the attempt at the latest. The first lock of the attempt is cleared 5
//!    clocks after that end at the earliest. A visit can take it in the clock after that, and reads points 2 clocks
//!    later, which is 8 clocks after the end. So all of them read the new point. The word of a vertex that is out of the
//!    mesh is read only by the check of an item, which waits while `waits` is 1.
//!
//! Latency: a point is written 2 to 6 clocks after it has come.

use crate::engine::types::Arrival;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LatePoint {
    pub clock: Signal<In, Clock>,
    /// Reset forgets the point that waits.
    pub reset: Signal<In, Bit>,
    /// The point of a move that ends in place, or the word of a vertex that is out of the mesh.
    pub comes: Signal<In, Arrival>,
    /// A visit fetches a fourth point in this clock.
    pub fetches: Signal<In, Bit>,
    /// A point waits.
    pub waits: Signal<Out, Bit>,
    /// The point is written at this edge.
    pub writes: Signal<Out, Bit>,
    pub arrival: Signal<Out, Arrival>,
    /// The point that came in the clock before; the point behind it, and the number of clocks that it has waited.
    coming: DFF<Arrival>,
    late: DFF<Arrival>,
    waited: DFF<Bits<3>>,
    is_last: Signal<Local, Bit>,
    is_written: Signal<Local, Bit>,
}

impl Logic for LatePoint {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, coming, late, waited);
        self.is_last.next = self.late.q.val().came & self.waited.q.val().get_bit(2);
        self.is_written.next =
            self.late.q.val().came & ((!self.fetches.val()) | self.coming.q.val().came | self.is_last.val());
        self.waits.next = self.late.q.val().came | self.coming.q.val().came;
        self.arrival.next = self.late.q.val();
        self.arrival.next.came = self.is_written.val();
        self.writes.next = self.is_written.val();

        self.waited.d.next = self.waited.q.val() + 1;
        if self.is_written.val() {
            self.late.d.next.came = false;
        }
        self.coming.d.next = self.comes.val();
        if self.coming.q.val().came {
            self.late.d.next = self.coming.q.val();
            self.waited.d.next = 0.into();
        }
        if self.reset.val() {
            self.coming.d.next.came = false;
            self.late.d.next.came = false;
        }
    }
}
