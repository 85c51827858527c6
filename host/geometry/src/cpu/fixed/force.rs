//! Forcing a constraint into the mesh: the edges that it crosses are replaced by others on either side of it.
//!
//! The way goes straight from one end through the triangles, until it meets a vertex on the constraint. The edges that
//! it crosses are taken out, which leaves a room with one chain of edges on either side. The constraint is put between
//! both ends of the room. A scan with a stack then cuts off every vertex at which a chain turns towards the constraint,
//! which fills a chain in linear time (Toussaint and Avis, *On a convex hull algorithm for polygons and its application
//! to triangulation problems*, 1982). As many edges are put in as were taken out, and they take the same numbers.
//!
//! An edge may hang into the room, with both of its sides in one chain. New half-edges are put beside those of the
//! chain, so this case needs no care.

use alloc::vec::Vec;
use core::cmp::Ordering;

use super::mesh::{Fixed, Part, FIXED, INNER};
use super::turn::{is_between, Way};
use crate::cpu::kernel::Kernel;
use crate::cpu::triangulator::Error;
use crate::sort::{Entry, Keyed, Wide};

/// The reason why not all constraints were forced in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// A constraint crosses a fixed edge.
    Crossing,
    /// There is no room for the list of all parts.
    TooManyParts,
    /// The watch ended the work.
    Ended(Error),
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Self::Ended(error)
    }
}

/// The number of pieces after which the watch is asked whether the work goes on. A long constraint takes a tenth of a
/// millisecond, so on usual sets the watch is asked every few milliseconds, which costs nothing beside the pieces.
const PIECES_PER_LOOK: usize = 64;

/// Vertices whose half-edges are fetched at once. They stay in a second-level cache while the constraints that begin at
/// them are forced.
const BLOCK: usize = 4096;
/// The least number of constraints that begin in a block whose half-edges are fetched. Fewer would not make up for it.
const MANY: usize = 32;

impl<K: Kernel> Fixed<'_, K> {
    /// Forces all constraints in, given by the vertices at their ends, in the order of `by_ends`, as far as there is
    /// room for `most` parts. Those of repeats are counted but not listed. `go_on` is called from time to time.
    ///
    /// # Errors
    /// Two constraints cross at a place that is not a vertex, there are too many parts, or `go_on` ends the work. The
    /// mesh has some of the constraints then.
    pub(super) fn force_all(
        &mut self,
        ends: &[[u32; 2]],
        order: &[Wide],
        most: usize,
        go_on: &mut dyn FnMut() -> Result<(), Error>,
    ) -> Result<Vec<Part>, Stop> {
        let mut parts = Vec::with_capacity(ends.len());
        let (mut room, mut place, mut fetched) = (most, 0, 0);
        for equal in order.chunk_by(|one, other| one.key() == other.key()) {
            let constraint = equal[0].value();
            let first = (equal[0].key() >> u32::BITS) as usize;
            if first >= fetched {
                fetched = (first / BLOCK + 1) * BLOCK;
                let own = order[place..].partition_point(|other| other.key() >> u32::BITS < fetched as u64);
                if own >= MANY {
                    self.fetch(fetched - BLOCK..fetched);
                }
            }
            place += equal.len();
            let mut rest = ends[constraint as usize];
            while rest[0] != rest[1] {
                let (edge, left) = self.step(rest)?;
                room = room.checked_sub(equal.len()).ok_or(Stop::TooManyParts)?;
                parts.push(Part { edge, constraint });
                if parts.len().is_multiple_of(PIECES_PER_LOOK) {
                    go_on()?;
                }
                rest = left;
            }
        }
        Ok(parts)
    }

    /// Forces an edge at one end of the line between two vertices, and fixes it. Returns the edge, and the ends of the
    /// rest of the line.
    fn step(&mut self, ends: [u32; 2]) -> Result<(u32, [u32; 2]), Stop> {
        let (side, way) = self.way(ends);
        let [from, to] = [ends[side], ends[1 - side]];
        let edge = match way {
            Way::Along(edge) => {
                self.fix(edge);
                self.at[from as usize] = edge;
                edge
            }
            Way::Through(first) => {
                let end = self.cross(first, from, to)?;
                let edge = self.fill(from, end);
                self.repair_inner();
                for place in 0..self.crossed.len() {
                    self.settle(self.crossed[place]);
                }
                edge
            }
        };
        Ok((edge, [self.end(edge), to]))
    }

    /// Walks to the next vertex on the line, and collects the edges on the way with the chains on both sides: the right
    /// one from `from` to that vertex, the left one back. The room lies to the left of both. `first` leaves `from`, and
    /// the line goes through the triangle to its left.
    fn cross(&mut self, first: u32, from: u32, to: u32) -> Result<u32, Stop> {
        let [a, q] = [from, to].map(|vertex| self.site(vertex));
        self.crossed.clear();
        self.right.clear();
        self.left.clear();
        self.right.push(first);
        self.left.push(self.half(first).next ^ 1);
        // The edge that is crossed, from its right end to its left one.
        let mut edge = self.follower(first);
        loop {
            if self.is_fixed(edge) {
                return Err(Stop::Crossing);
            }
            self.crossed.push(edge);
            let right = self.half(edge).previous;
            let left = self.follower(right);
            let apex = self.end(right);
            let site = self.site(apex);
            match K::orient2d(a, q, site) {
                Ordering::Less => {
                    self.right.push(right);
                    edge = left;
                }
                Ordering::Greater => {
                    self.left.push(left);
                    edge = right;
                }
                Ordering::Equal => {
                    debug_assert!(apex == to || is_between(a, site, q));
                    self.right.push(right);
                    self.left.push(left);
                    self.left.reverse();
                    return Ok(apex);
                }
            }
        }
    }

    /// Replaces the edges that were crossed by the fixed edge between both vertices, and by inner ones that fill both
    /// chains. Returns the fixed edge. The others are left in the list of edges that were crossed.
    fn fill(&mut self, from: u32, end: u32) -> u32 {
        let mut crossed = core::mem::take(&mut self.crossed);
        for &edge in &crossed {
            for half in [edge, edge ^ 1] {
                let origin = self.origin(half);
                self.unlink(half, origin);
            }
        }
        let (right, left) = (core::mem::take(&mut self.right), core::mem::take(&mut self.left));
        // Both chains have at least two edges, and at least one edge was crossed.
        let new = crossed.pop().unwrap_or_default();
        self.insert(new, end | FIXED, right[0], left[left.len() - 1] ^ 1);
        self.insert(new ^ 1, from | FIXED, left[0], right[right.len() - 1] ^ 1);
        self.fixed.push(new & !1);
        let rest = self.fill_chain(&right, &crossed);
        self.fill_chain(&left, rest);
        (self.crossed, self.right, self.left) = (crossed, right, left);
        new
    }

    /// Fills the room between a chain and the fixed edge between its ends. The new edges take the first of these
    /// numbers, and the others are returned.
    fn fill_chain<'n>(&mut self, chain: &[u32], mut numbers: &'n [u32]) -> &'n [u32] {
        let mut open = core::mem::take(&mut self.open);
        open.clear();
        for (place, &edge) in chain.iter().enumerate() {
            let (mut last, to) = (edge, self.end(edge));
            while let Some(&before) = open.last() {
                let (from, corner) = (self.origin(before), self.origin(last));
                let is_corner = K::orient2d(self.site(from), self.site(corner), self.site(to)).is_gt();
                // The last triangle lies at the fixed edge itself, and needs no other.
                let is_last = open.len() == 1 && place == chain.len() - 1;
                if !is_corner || is_last {
                    debug_assert!(is_corner || !is_last);
                    break;
                }
                // There are as many numbers as edges to be made.
                let new = numbers.split_off_first().copied().unwrap_or_default();
                let back = last ^ 1;
                self.insert(new, to | INNER, before, self.half(before).next);
                self.insert(new ^ 1, from | INNER, self.half(back).previous, back);
                self.stack.push(new);
                open.pop();
                last = new;
            }
            open.push(last);
        }
        self.open = open;
        numbers
    }
}
