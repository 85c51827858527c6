//! The search for the triangles of a part that are not final, without a look at most of the others.
//!
//! A triangle is *open* if its closed circumscribed disc touches or crosses a side of the part's cell. The west and
//! south sides are here the lines one step outside the cell, as in [`Reach`], so that all points lie strictly inside.
//! Open triangles form strips along the sides, and nearly all triangles lie far from them. The search tests a triangle
//! only if one of its corners is *shallow*: near a side, or on the hull. All other vertices are *deep*.
//!
//! **Why the others are final.** Let `T` be an open triangle, and `q` a point of its closed disc on a side of the cell.
//! All points of the part lie strictly inside the cell, so `q` lies outside the hull. Draw a line from a place in `T`
//! to `q` that meets no vertex. It runs through triangles of the part until it crosses an edge of the hull.
//! - *All of these triangles are open.* Let the line cross the edge between triangle `A` and the next one, `B`. The
//!   power of a place with respect to the circle of `A`, less its power with respect to the circle of `B`, is a linear
//!   function of the place. This function is 0 on the line of the edge, and not negative at the far corner of `B`,
//!   which is on the circle of `B` and not inside that of `A`. So it is not negative on the whole side of `B`, where
//!   `q` lies: if `q` is in the closed disc of `A`, it is in that of `B`.
//! - *So one triangle along the line is tested.* The edge of the hull has shallow ends. If `T` has only deep corners,
//!   there is a first triangle along the line that has a shallow one. This triangle is open, and shares an edge with
//!   two deep ends with the triangle before it.
//!
//! So if no open triangle that was tested has two deep corners, all open triangles were tested. Else these corners are
//! called shallow from then on, and the triangles around them are tested as well. Sets whose open triangles reach far
//! into the part, such as points on a curve, have all their triangles tested after a few rounds.

use alloc::vec::Vec;

use super::super::view::Site;
use super::Unsound;
use crate::point::Point;
use crate::tiles::reach::{Reach, Sides, TilePoint};
use crate::tiles::region::Region;

/// A vertex that no tested triangle has.
const DEEP: u8 = 0;
/// A vertex all of whose triangles have been tested.
const SHALLOW: u8 = 1;
/// A vertex whose triangles are tested in this round.
const NEW: u8 = 2;
/// The number of rounds after which all triangles are tested. Evenly spread points need fewer.
const ROUNDS: usize = 4;
/// The depth up to which vertices are shallow from the start, in mean distances of neighbours. A larger depth means
/// more tests, and a smaller one more rounds.
const DEPTH: u64 = 3;

/// Takes the triangles that are not final out of the list. The others stay there, in any order.
///
/// # Errors
/// A triangle names a vertex that does not exist.
pub(super) fn take_open(
    triangles: &mut Vec<[u32; 3]>,
    hull: &[u32],
    sites: &[Site],
    region: &Region,
    far: [u32; 2],
) -> Result<Vec<[u32; 3]>, Unsound> {
    let mut search = Search { states: shallow(sites, hull, region, far), sites, sides: Point::sides(region) };
    let mut open = Vec::new();
    for round in 1.. {
        let before = open.len();
        search.test(triangles, &mut open)?;
        let grown = search.deep_corners(&open[before..]);
        if grown.is_empty() {
            break;
        }
        search.next_round(&grown, round >= ROUNDS);
    }
    Ok(open)
}

/// The states of all vertices at the start: those near a side of the region or on the hull are new.
fn shallow(sites: &[Site], hull: &[u32], region: &Region, far: [u32; 2]) -> Vec<u8> {
    let Region { west, east, south, north } = *region;
    let length = |low: Option<i64>, high: Option<i64>, far: u32| {
        (high.unwrap_or(i64::from(far)) - low.unwrap_or(0)).unsigned_abs().min(u32::MAX.into())
    };
    let area = length(west, east, far[0]) * length(south, north, far[1]);
    let depth = i64::try_from(DEPTH * (area / sites.len().max(1) as u64).isqrt()).unwrap_or(i64::MAX);
    // Where the set ends, no side is there. But the discs of thin triangles along the hull reach far.
    let rim = depth / 2;
    // Which vertices are called shallow is a matter of speed alone, so limits may be rounded to the grid.
    let limit = |limit: i64| u32::try_from(limit.max(0)).unwrap_or(u32::MAX);
    let low = |side: Option<i64>| limit(side.map_or(rim, |side| side + depth));
    let high = |side: Option<i64>, far: u32| limit(side.map_or(i64::from(far) - rim, |side| side - depth));
    let ([west, south], [east, north]) = ([low(west), low(south)], [high(east, far[0]), high(north, far[1])]);
    let state = |site: &Site| {
        let is_shallow = (site.x() < west) | (site.x() > east) | (site.y() < south) | (site.y() > north);
        NEW * u8::from(is_shallow)
    };
    let mut states: Vec<u8> = sites.iter().map(state).collect();
    hull.iter().for_each(|&v| states[v as usize] = NEW);
    states
}

/// A search under way.
struct Search<'a> {
    /// The state of each vertex: [`DEEP`], [`SHALLOW`] or [`NEW`].
    states: Vec<u8>,
    sites: &'a [Site],
    sides: Sides,
}

impl Search<'_> {
    /// Tests the triangles that have a new corner and no shallow one, and moves the open ones to the other list.
    fn test(&self, triangles: &mut Vec<[u32; 3]>, open: &mut Vec<[u32; 3]>) -> Result<(), Unsound> {
        let point = |v: u32| Point::new(self.sites[v as usize].x(), self.sites[v as usize].y());
        let mut place = 0;
        while let Some(&corners) = triangles.get(place) {
            let [a, b, c] = corners.map(|v| self.states.get(v as usize));
            let (Some(a), Some(b), Some(c)) = (a, b, c) else {
                return Err(Unsound);
            };
            if a | b | c == NEW && Point::reach(&self.sides, corners.map(point)) != Reach::Within {
                open.push(corners);
                triangles.swap_remove(place);
            } else {
                place += 1;
            }
        }
        Ok(())
    }

    /// The deep corners of triangles that have two of them.
    fn deep_corners(&self, open: &[[u32; 3]]) -> Vec<u32> {
        let is_deep = |v: &u32| self.states[*v as usize] == DEEP;
        let deep = |corners: &[u32; 3]| corners.iter().filter(|v| is_deep(v)).count();
        open.iter().filter(|corners| deep(corners) > 1).flatten().copied().filter(is_deep).collect()
    }

    /// Begins a round in which these vertices, or all deep ones, are new.
    fn next_round(&mut self, grown: &[u32], all: bool) {
        let deep = if all { NEW } else { DEEP };
        self.states.iter_mut().for_each(|state| *state = if *state == DEEP { deep } else { SHALLOW });
        grown.iter().for_each(|&v| self.states[v as usize] = NEW);
    }
}
