//! The point of a move in place, which waits for a clock in which no visit fetches a fourth point: both use one port of
//! the vertex memory, and a visit that meets the write is made again (M14).
//!
//! 1. A point is written in one of the five clocks after it has come. An item that begins may take the port first
//!    (`is_taken`). In the clock of its last chance the point is written whatever is fetched, and no item may begin
//!    (`is_last_chance`).
//! 2. It is also written when the next point comes, so one place is enough. A clock in which one comes has no item that
//!    begins.
//! 3. The write comes 5 clocks after the end of the attempt at the latest. The first lock of the attempt is cleared 5
//!    clocks after that end at the earliest, and a context that takes it then reads points 2 clocks later. So all of
//!    them read the new point.
//!
//! Latency: a point is written 1 to 5 clocks after it has come.

use crate::engine::types::Arrival;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LatePoint {
    pub clock: Signal<In, Clock>,
    /// Reset forgets the point that waits.
    pub reset: Signal<In, Bit>,
    /// The point of a move that ends in place.
    pub comes: Signal<In, Arrival>,
    /// A visit fetches a fourth point in this clock; the point of an item that begins takes the port.
    pub fetches: Signal<In, Bit>,
    pub is_taken: Signal<In, Bit>,
    /// A point waits, and this is the last clock in which it can be written.
    pub waits: Signal<Out, Bit>,
    pub is_last_chance: Signal<Out, Bit>,
    /// The point is written at this edge.
    pub writes: Signal<Out, Bit>,
    pub arrival: Signal<Out, Arrival>,
    late: DFF<Arrival>,
    waited: DFF<Bits<3>>,
    is_last: Signal<Local, Bit>,
    is_written: Signal<Local, Bit>,
}

impl Logic for LatePoint {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, late, waited);
        self.is_last.next = self.late.q.val().came & self.waited.q.val().get_bit(2);
        self.is_written.next = self.late.q.val().came
            & (!self.is_taken.val())
            & ((!self.fetches.val()) | self.comes.val().came | self.is_last.val());
        self.waits.next = self.late.q.val().came;
        self.is_last_chance.next = self.is_last.val();
        self.arrival.next = self.late.q.val();
        self.arrival.next.came = self.is_written.val();
        self.writes.next = self.is_written.val();

        self.waited.d.next = self.waited.q.val() + 1;
        if self.is_written.val() {
            self.late.d.next.came = false;
        }
        if self.comes.val().came {
            self.late.d.next = self.comes.val();
            self.waited.d.next = 0.into();
        }
        if self.reset.val() {
            self.late.d.next.came = false;
        }
    }
}
