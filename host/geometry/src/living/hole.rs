//! Removing a vertex: gift wrapping fills the hole that its star leaves.
//!
//! The triangle on an edge of the hole is the one whose circle holds no other vertex of the hole, with the tie rule.
//! The triangle cuts the hole in two smaller ones. On even sets that takes six tests a vertex, where cutting ears takes
//! twice as many, and flips take half as many again and write twice as much.

use alloc::vec::Vec;

use super::level::{Border, Level};
use super::plane::{Side, INFINITE};
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// Holes with more edges are filled by the CPU triangulator. On circles of 64, 128 and 256 points of doubles, gift
/// wrapping took 6.5, 26 and 84 µs, and the CPU triangulator 12, 23 and 42 µs. In tests small holes are large already.
const LARGE: usize = if cfg!(test) { 6 } else { 128 };

impl<P: PlanePoint> Level<P> {
    /// Removes a vertex.
    pub(super) fn remove(&mut self, vertex: u32) {
        if self.is_plane() {
            self.remove_from_plane(vertex);
        } else {
            self.line.remove(&self.site(vertex));
        }
        self.release(vertex);
    }

    fn remove_from_plane(&mut self, vertex: u32) {
        self.collect_star(vertex);
        let border = core::mem::take(&mut self.border);
        let is_on_hull = border.iter().any(|edge| edge.from == INFINITE);
        // All points can only lie on one line if all others are around this one.
        if is_on_hull && border.len() == self.count {
            let left: Vec<u32> = border.iter().map(|edge| edge.from).filter(|&from| from != INFINITE).collect();
            if self.fold(&left) {
                self.border = border;
                return;
            }
        }
        self.border = if border.len() > LARGE {
            self.fill_large(&border);
            border
        } else {
            self.fill(border)
        };
        while let Some(triangle) = self.dead.pop() {
            self.plane.release(triangle);
        }
    }

    /// A triangle to be set, which takes the number of a dead one.
    pub(super) fn next_made(&mut self) -> u32 {
        let triangle = self.dead.pop().unwrap_or_else(|| self.plane.allocate());
        self.made.push(triangle);
        triangle
    }

    /// Collects the triangles around a vertex, and the border around them, counter-clockwise.
    pub(super) fn collect_star(&mut self, vertex: u32) {
        self.dead.clear();
        self.border.clear();
        let start = self.side_opposite(vertex);
        let mut side = start;
        loop {
            self.dead.push(side.triangle());
            self.border.push(Border { from: self.plane.ends(side)[0], outside: self.plane.across(side) });
            side = self.plane.across(side.next()).next();
            if side == start {
                return;
            }
        }
    }

    /// Fills holes with triangles, which take the numbers of dead ones. A hole is its border, counter-clockwise.
    fn fill(&mut self, mut border: Vec<Border>) -> Vec<Border> {
        // Holes lie one behind the other in `border`; the list has the start of each.
        let mut starts: Vec<usize> = alloc::vec![0];
        self.made.clear();
        while let Some(start) = starts.pop() {
            let hole = &mut border[start..];
            // The base edge needs two ends with coordinates.
            while hole[0].from == INFINITE || hole[1].from == INFINITE {
                hole.rotate_left(1);
            }
            let apex = self.apex_of(hole);
            let triangle = self.next_made();
            let corners = [hole[0].from, hole[1].from, hole[apex].from];
            self.plane.set(triangle, corners, [Side::new(0, 0); 3]);
            corners.into_iter().for_each(|corner| self.note(corner, triangle));
            self.plane.link(Side::new(triangle, 2), hole[0].outside);
            let (first, last, length) = (hole[0], hole[apex], hole.len());
            // Behind the edge from corner 1 to the apex, and behind the one from the apex to corner 0.
            let cut = [Side::new(triangle, 0), Side::new(triangle, 1)];
            if apex == 2 {
                self.plane.link(cut[0], hole[1].outside);
            }
            if apex == length - 1 {
                self.plane.link(cut[1], last.outside);
            }
            // The hole becomes [1 .. apex] and [apex .. end, 0], each if it has three corners or more.
            border.push(Border { from: first.from, outside: cut[1] });
            let right = (apex > 2).then_some(start + 1);
            let left = (apex < length - 1).then_some(start + apex);
            match (right, left) {
                (None, None) => border.truncate(start),
                (Some(_), None) => {
                    border.truncate(start + length);
                    border[start + apex].outside = cut[0];
                    border.remove(start);
                    starts.push(start);
                }
                (None, Some(_)) => {
                    border.drain(start..start + apex);
                    starts.push(start);
                }
                (Some(_), Some(_)) => {
                    border.insert(start + apex, Border { from: last.from, outside: cut[0] });
                    border.remove(start);
                    starts.extend([start, start + apex]);
                }
            }
        }
        border
    }

    /// The place in a hole of the apex of the triangle on its first edge.
    fn apex_of(&self, hole: &[Border]) -> usize {
        let [a, b] = [0, 1].map(|place| self.site(hole[place].from));
        if hole.len() == 3 {
            return 2;
        }
        let mut best: Option<(usize, P::Site)> = None;
        let mut infinite = 2;
        for (place, edge) in hole.iter().enumerate().skip(2) {
            if edge.from == INFINITE {
                infinite = place;
                continue;
            }
            let d = self.site(edge.from);
            let is_left = P::Site::orient2d(a, b, d).is_gt();
            if is_left && best.is_none_or(|(_, c)| P::Site::conflicts([a, b, c], d)) {
                best = Some((place, d));
            }
        }
        // If no vertex lies to the left, the base edge becomes a hull edge.
        best.map_or(infinite, |(place, _)| place)
    }
}
