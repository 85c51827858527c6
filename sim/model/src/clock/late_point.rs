//! The point of a move in place, or the word that takes the place of the point of a vertex that is out of the mesh, on
//! its way to the vertex memory. That word has the two ids that are kept for the vertex.
//!
//! Hardware twin: the block `LatePoint`.

use super::wires::Wires;
use crate::predicate::Point;

/// Number of clocks that a point waits at most behind the register into which it has come, so that it is written six
/// clocks after its attempt has ended at the latest. The first lock of the attempt is cleared five clocks after that
/// end at the earliest, and a visit that takes it in the next clock reads points two clocks later.
const MOST: u32 = 4;

/// A point that waits for a clock in which no visit fetches a fourth point, because both use one port.
#[derive(Clone, Copy, Debug)]
pub(super) struct LatePoint {
    vertex: u32,
    point: Point,
    waited: u32,
}

impl LatePoint {
    pub fn new((vertex, point): (u32, Point)) -> Self {
        Self { vertex, point, waited: 0 }
    }

    /// Whether the point wants the port in this clock, in which a visit `fetches` a point or not, and another point may
    /// come out of the register.
    pub fn is_due(&self, fetches: bool, comes: bool) -> bool {
        !fetches || comes || self.waited == MOST
    }

    /// The vertex and its point.
    pub fn arrival(&self) -> (u32, Point) {
        (self.vertex, self.point)
    }

    /// The point that waits after an edge.
    pub fn after(was: Option<Self>, coming: Option<Self>, wires: &Wires) -> Option<Self> {
        let waits = was.filter(|late| wires.new_point != Some(late.arrival()));
        coming.or(waits.map(|late| Self { waited: late.waited + 1, ..late }))
    }
}
