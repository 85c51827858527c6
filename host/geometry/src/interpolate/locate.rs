//! The visibility walk to the triangle of a place.

use super::record::{after, Record, NONE};
use crate::double::orient2d;

/// The corner, edge or record at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// The corner of a record.
    Corner(u32, usize),
    /// The middle of an edge of a record.
    Edge(u32, usize),
    /// The inside of a record.
    Inside(u32),
    /// The place lies outside the hull, beyond an edge of this record.
    Outside(u32),
}

/// Walks from a record to a place. The walk ends in every Delaunay triangulation, from whatever record it begins
/// (De Floriani and others 1991); in lists that are none it ends after as many steps as there are records, outside.
pub(super) fn locate(records: &[Record], start: u32, q: [f64; 2]) -> Place {
    let (mut at, mut from) = (start, NONE);
    for _ in 0..=records.len() {
        let record = &records[at as usize];
        let (mut next, mut zeros, mut on) = (None, 0, 0);
        for k in 0..3 {
            // The place lies on this side of the edge across which the walk came.
            if record.behind[k] == from && from != NONE {
                continue;
            }
            match orient2d(record.corners[k], record.corners[after(k)], q) {
                core::cmp::Ordering::Less => {
                    next = Some(k);
                    break;
                }
                core::cmp::Ordering::Equal => {
                    zeros += 1;
                    on = if zeros == 2 && k == after(on) {
                        k
                    } else if zeros == 2 {
                        on
                    } else {
                        k
                    };
                }
                core::cmp::Ordering::Greater => {}
            }
        }
        match (next, zeros) {
            (Some(k), _) if record.behind[k] == NONE => return Place::Outside(at),
            (Some(k), _) => (at, from) = (record.behind[k], at),
            (None, 0) => return Place::Inside(at),
            (None, 1) => return Place::Edge(at, on),
            // The corner between two edges is the one at which the later begins.
            (None, _) => return Place::Corner(at, on),
        }
    }
    Place::Outside(at)
}
