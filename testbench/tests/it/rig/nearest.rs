//! The corner of a record nearest to a place, and where a search round that corner begins and goes on, in plain code.

use crate::rig::stepper::bundles::pack;
use crate::rig::visit_model::{orientation, Point};

/// Squared distance of two points.
pub fn distance(a: Point, b: Point) -> i64 {
    (a.0 - b.0).pow(2) + (a.1 - b.1).pow(2)
}

/// Whether the spoke from a corner to another makes an angle of less than 90 degrees with the direction to the place.
pub fn is_ahead(corner: Point, other: Point, place: Point) -> bool {
    (other.0 - corner.0) * (place.0 - corner.0) + (other.1 - corner.1) * (place.1 - corner.1) > 0
}

/// The nearest corner of a record as stored.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nearest {
    pub slot: usize,
    /// A search that begins in the record has a chain to the right, to the left.
    pub begins: [bool; 2],
    /// A chain to the right, to the left, that has come to the record goes on.
    pub goes: [bool; 2],
}

impl Nearest {
    /// Looks at corners of which none or one is infinite, with any place.
    pub fn of(corners: [Point; 3], infinite: Option<usize>, place: Point) -> Self {
        let finite = (0..3).filter(|&slot| Some(slot) != infinite);
        let slot = finite.min_by_key(|&slot| (distance(corners[slot], place), corners[slot])).unwrap_or(0);
        let center = corners[slot];
        // For the chain to the right a spoke counts as it is, for the one to the left in a mirror.
        let ends = [(1, 2, 1), (2, 1, -1)].map(|(leaves, enters, mirror)| {
            let [out, into] = [leaves, enters].map(|step| (slot + step) % 3);
            // Positive on the chain's own side of the direction to the place.
            let side = |far: usize| mirror * orientation(center, corners[far], place).signum();
            match (Some(out) == infinite, Some(into) == infinite) {
                (false, false) => {
                    let is_past = side(out) >= 0 && !is_ahead(center, corners[out], place);
                    let looks_away = side(into) > 0 && side(out) < 0;
                    [is_past || looks_away && leaves == 1, is_past || looks_away]
                }
                (true, _) => [side(into) >= 0; 2],
                (false, true) => {
                    let is_past = side(out) >= 0 && !is_ahead(center, corners[out], place);
                    [is_past, is_past || side(out) < 0]
                }
            }
        });
        Self { slot, begins: ends.map(|[at_first, _]| !at_first), goes: ends.map(|[_, later]| !later) }
    }

    /// Packs it as a `NearVerdict` of the record rotated by `first` slots.
    pub fn packed(self, first: usize) -> u128 {
        let slot = (self.slot + 3 - first) % 3;
        let [right, left] = self.begins.map(u64::from);
        let [goes_right, goes_left] = self.goes.map(u64::from);
        pack([2, 1, 1, 1, 1], [slot as u64, right, left, goes_right, goes_left])
    }
}
