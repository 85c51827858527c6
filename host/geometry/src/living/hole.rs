//! Removing a vertex: gift wrapping fills the hole that its star leaves.
//!
//! The triangle on an edge of the hole is the one whose circle holds no other vertex of the hole, with the tie rule.
//! That triangle cuts the hole in two smaller ones. All candidates are tested against the same edge, so what the tests
//! of a candidate share is computed once. On even sets this takes 45 multiplications for each vertex that is removed,
//! where cutting ears or flips take 76, and an insertion of the neighbours 53 (`docs/living.md`).

use alloc::vec::Vec;

use super::level::{Border, Level, Part};
use super::plane::{Side, INFINITE};
use crate::plane_point::PlanePoint;
use crate::site::{Seen, Site};

/// Holes with more edges are filled by the CPU triangulator. On circles of 64 and 128 grid points gift wrapping takes 6
/// and 21 µs, and the CPU triangulator 26 µs for 129 (`examples/living.rs`). In tests small holes are large already.
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
        let mut border = core::mem::take(&mut self.border);
        if self.folds(&border) {
            self.border = border;
            return;
        }
        if border.len() > LARGE {
            self.fill_large(&border);
        } else {
            self.fill(&mut border);
        }
        self.border = border;
        while let Some(triangle) = self.dead.pop() {
            self.plane.release(triangle);
        }
    }

    /// Puts all vertices but one, whose border is given, onto a line, if they lie on one; says whether they do.
    pub(super) fn folds(&mut self, border: &[Border]) -> bool {
        // All points can only lie on one line if all others are around this one.
        if border.len() != self.count || border.iter().all(|edge| edge.from != INFINITE) {
            return false;
        }
        let left: Vec<u32> = border.iter().map(|edge| edge.from).filter(|&from| from != INFINITE).collect();
        self.fold(&left)
    }

    /// A triangle to be set, which takes the number of a dead one.
    #[inline(always)]
    pub(super) fn next_made(&mut self) -> u32 {
        let triangle = self.dead.pop().unwrap_or_else(|| self.plane.allocate());
        self.made.push(triangle);
        triangle
    }

    /// Collects the triangles around a vertex, and the border around them, counter-clockwise. In the ring the infinite
    /// vertex has the coordinates of the vertex itself.
    pub(super) fn collect_star(&mut self, vertex: u32) {
        let (mut sides, mut behind) = (core::mem::take(&mut self.stack), core::mem::take(&mut self.behind));
        sides.clear();
        self.star_both_ways(self.side_opposite(vertex), |side, is_ahead| {
            if is_ahead { &mut sides } else { &mut behind }.push(side);
        });
        sides.extend(behind.drain(..).rev());
        self.dead.clear();
        self.border.clear();
        self.ring.clear();
        for &side in &sides {
            let from = self.plane.ends(side)[0];
            self.dead.push(side.triangle());
            self.border.push(Border { from, outside: self.plane.across(side) });
            self.ring.push(self.site(if from == INFINITE { vertex } else { from }));
        }
        (self.stack, self.behind) = (sides, behind);
    }

    /// Fills a hole with triangles, which take the numbers of dead ones.
    fn fill(&mut self, border: &mut [Border]) {
        self.made.clear();
        let mut ring = core::mem::take(&mut self.ring);
        let last = border.len() - 1;
        if let Some(place) = border.iter().position(|edge| edge.from == INFINITE) {
            border.rotate_left(place);
            ring.rotate_left(place);
            self.fill_at_hull(border, &mut ring);
        } else {
            self.fill_part(border, &ring, Part { first: 0, last, chord: border[last].outside });
        }
        // All other vertices of the border have got a triangle with the edge that begins there.
        self.note(border[last].from, self.plane.across(border[last].outside).triangle());
        self.ring = ring;
    }

    /// Fills a part of a hole. All its vertices have coordinates.
    fn fill_part(&mut self, border: &[Border], ring: &[P::Site], part: Part) {
        let mut parts = core::mem::take(&mut self.parts);
        parts.push(part);
        while let Some(Part { first, last, chord }) = parts.pop() {
            let others = &ring[first + 1..last];
            let apex = match others {
                [_] => first + 1,
                others => first + 1 + Self::apex_of([ring[last], ring[first]], others).unwrap_or(0),
            };
            let corners = [last, first, apex].map(|place| border[place].from);
            let triangle = self.make(corners, chord);
            for (slot, first, last) in [(0, first, apex), (1, apex, last)] {
                let chord = Side::new(triangle, slot);
                if last - first > 1 {
                    parts.push(Part { first, last, chord });
                } else {
                    self.plane.link(chord, border[first].outside);
                    self.note(border[first].from, triangle);
                }
            }
        }
        self.parts = parts;
    }

    /// Fills a hole that reaches the hull. The border begins with the infinite vertex, and is changed.
    fn fill_at_hull(&mut self, border: &mut [Border], ring: &mut [P::Site]) {
        let last = border.len() - 1;
        // What is left of the hole: the infinite vertex, and the border from `first` on. `behind` is the side outside
        // the edge from the one to the other.
        let (mut first, mut behind) = (1, border[0].outside);
        while first < last {
            let Border { from, outside } = border[first];
            let to = border[first + 1].from;
            // If no vertex lies to the left, the edge becomes a hull edge.
            let Some(apex) = Self::apex_of([ring[first], ring[first + 1]], &ring[first + 2..]) else {
                let ghost = self.make([from, to, INFINITE], outside);
                self.plane.link(Side::new(ghost, 1), behind);
                self.note(from, ghost);
                self.note(INFINITE, ghost);
                (first, behind) = (first + 1, Side::new(ghost, 0));
                continue;
            };
            let apex = first + 2 + apex;
            let triangle = self.make([from, to, border[apex].from], outside);
            let chord = Side::new(triangle, 0);
            if apex == first + 2 {
                self.plane.link(chord, border[first + 1].outside);
                self.note(to, triangle);
            } else {
                self.fill_part(border, ring, Part { first: first + 1, last: apex, chord });
            }
            // The edge from the first vertex to the apex takes the place of all edges in between.
            (border[apex - 1], ring[apex - 1]) = (Border { from, outside: Side::new(triangle, 1) }, ring[first]);
            first = apex - 1;
        }
        self.plane.link(behind, border[last].outside);
    }

    /// Makes a triangle, given the other side of the edge between its first two corners.
    #[inline(always)]
    pub(super) fn make(&mut self, corners: [u32; 3], outside: Side) -> u32 {
        let triangle = self.next_made();
        self.plane.set(triangle, corners, [Side::new(0, 0); 3]);
        self.plane.link(Side::new(triangle, 2), outside);
        triangle
    }

    /// The place in a list of vertices of the apex of the triangle on an edge; `None` if none of them lies to the left.
    fn apex_of(edge: [P::Site; 2], sites: &[P::Site]) -> Option<usize> {
        let mut best: Option<(usize, Seen<P::Site>)> = None;
        for (place, &site) in sites.iter().enumerate() {
            let seen = Seen::of(edge, site);
            let is_left = P::Site::side(edge, seen).is_gt();
            if is_left && best.is_none_or(|(_, c)| P::Site::conflicts_seen(edge, c, seen)) {
                best = Some((place, seen));
            }
        }
        best.map(|(place, _)| place)
    }
}
