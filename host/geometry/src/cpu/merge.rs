//! The merge of two triangulations on both sides of a line (Guibas and Stolfi 1985).

use super::edges::{Edges, Halves};
use super::kernel::{Ends, Kernel};

/// The triangulation of a subset of the points, known by its outermost vertices. Each of those is given as the
/// half-edge that leaves it counter-clockwise along the hull.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// At the vertex of smallest x, and of smallest y among those.
    pub(super) left: u32,
    /// At the vertex of largest x, and of largest y among those.
    pub(super) right: u32,
    /// At the vertex of smallest y, and of smallest x among those.
    pub(super) bottom: u32,
    /// At the vertex of largest y, and of largest x among those.
    pub(super) top: u32,
    /// Whether the part is a single vertex, whose half-edge leads back to it.
    pub(super) is_vertex: bool,
}

impl Part {
    /// The part after `by` was added to the numbers of all half-edges.
    pub(super) fn moved(self, by: u32) -> Self {
        let Self { left, right, bottom, top, is_vertex } = self;
        Self { left: left + by, right: right + by, bottom: bottom + by, top: top + by, is_vertex }
    }

    /// The half-edge that leaves the leftmost vertex counter-clockwise along the hull.
    pub(super) fn leftmost(&self) -> u32 {
        self.left
    }
}

/// The cut between two parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// The first part lies to the left of the second: all its x are smaller.
    Vertical,
    /// The first part lies below the second: all its y are smaller.
    Horizontal,
}

/// A vertex of one part that may become the third corner of the next triangle, and the next vertex around `a` or `b`,
/// away from the base edge.
///
/// A base edge leads from `a` in the first part to `b` in the second, and is given as its half that begins at `a`. The
/// gap that is still to be filled lies to the left of the base edge. Numbers of vertices are read again where they are
/// needed: registers are scarcer in this loop than reads from the cache.
#[derive(Clone, Copy)]
struct Candidate<K: Kernel> {
    /// The half-edge from `a` or `b` to the vertex.
    edge: u32,
    /// The site of the vertex.
    site: K::Site,
    /// The half-edge after `edge`.
    after: u32,
    /// The site to which `after` leads.
    behind: K::Site,
}

impl<K: Kernel, H: Halves + ?Sized> Edges<'_, K, H> {
    /// Joins two parts, at least one of which has an edge.
    pub(super) fn merge(&mut self, one: Part, other: Part, cut: Cut) -> Part {
        debug_assert!(!(one.is_vertex && other.is_vertex), "the pair of one would be lost");
        let bounds = K::bounds(|| self.outermost(&one, &other, cut).map(|e| self.from(e)));
        let first = self.lower_tangent(&one, &other, cut, bounds);
        // `zip` may remove the half-edges of vertices that are ends of the first or the last base edge. The vertices
        // stay, so both are remembered, and such a half-edge is replaced by that of the base edge.
        let outermost = self.outermost(&one, &other, cut).map(|e| (e, self.origin(e)));
        let a = self.origin(first);
        let last = self.zip(first, bounds);
        let b = self.end(last);
        let [left, right, bottom, top] = outermost.map(|(e, vertex)| {
            let e = if vertex == a { first } else { e };
            if vertex == b {
                last ^ 1
            } else {
                e
            }
        });
        Part { left, right, bottom, top, is_vertex: false }
    }

    /// Makes the first base edge and returns its half at `a`. All points of both parts lie on its line or to its left.
    #[inline(always)]
    fn lower_tangent(&mut self, one: &Part, other: &Part, cut: Cut, bounds: K::Bounds) -> u32 {
        let (facing, mut rdi) = match cut {
            Cut::Vertical => (one.right, other.left),
            Cut::Horizontal => (one.top, other.bottom),
        };
        // `ldi` runs clockwise along the hull of the first part, `rdi` counter-clockwise along that of the other one.
        // The half-edge of a single vertex ends where it begins, so its predicate is zero and it never moves.
        let mut ldi = self.previous(facing);
        let (mut a, mut b) = (self.from(ldi), self.from(rdi));
        let turn = |a, b, c| K::turn(Ends { a, b, bounds }, c);
        while self.halves.may_go_on() {
            if turn(a, self.to(ldi), b).is_gt() {
                ldi = self.previous(ldi ^ 1);
                a = self.from(ldi);
            } else if turn(b, self.to(rdi), a).is_lt() {
                rdi = self.next(rdi ^ 1);
                b = self.from(rdi);
            } else {
                break;
            }
        }
        self.first_edge((ldi, one.is_vertex), (rdi, other.is_vertex))
    }

    /// Makes the edge between the origins of two half-edges along the hulls, and returns its half at the first origin.
    /// A single vertex already has a pair for the edge.
    #[inline(always)]
    fn first_edge(&mut self, (ldi, a_is_vertex): (u32, bool), (rdi, b_is_vertex): (u32, bool)) -> u32 {
        let (a, b) = (self.origin(ldi), self.origin(rdi));
        let at_a = match (a_is_vertex, b_is_vertex) {
            (true, _) => ldi,
            (false, true) => rdi ^ 1,
            (false, false) => self.take(),
        };
        let at_b = at_a ^ 1;
        if a_is_vertex {
            self.alone(at_a, b);
        } else {
            self.insert(at_a, b, ldi, self.next(ldi));
        }
        if b_is_vertex {
            self.alone(at_b, a);
        } else {
            self.insert(at_b, a, self.previous(rdi), rdi);
        }
        at_a
    }

    /// Fills the gap with triangles from the first base edge on; returns the last base edge.
    #[inline(always)]
    fn zip(&mut self, mut base: u32, bounds: K::Bounds) -> u32 {
        let mut ends = Ends { a: self.from(base), b: self.to(base), bounds };
        let mut one = self.candidate::<true>(self.next(base));
        let mut other = self.candidate::<false>(self.previous(base ^ 1));
        loop {
            let from_one = self.advance::<true>(&mut one, ends);
            let from_other = self.advance::<false>(&mut other, ends);
            let (one_is_valid, other_is_valid) = (K::is_left(ends, from_one), K::is_left(ends, from_other));
            if !((one_is_valid | other_is_valid) & self.halves.may_go_on()) {
                return base;
            }
            let pair = self.take();
            // The new base edge leads from the corner of the triangle to the vertex that stays. `back` leads from the
            // corner to the other one. The candidate of the vertex that stays is still the next one around it.
            if other_is_valid & (!one_is_valid | K::is_left_and_inside(ends, from_one, from_other)) {
                let back = other.edge ^ 1;
                let previous = self.previous(back);
                self.insert(pair, self.end(other.edge), base, one.edge);
                self.insert(pair ^ 1, self.end(base ^ 1), previous, back);
                ends.b = other.site;
                other = self.candidate::<false>(previous);
            } else {
                let back = one.edge ^ 1;
                let next = self.next(back);
                self.insert(pair ^ 1, self.end(one.edge), other.edge, base ^ 1);
                self.insert(pair, self.end(base), back, next);
                ends.a = one.site;
                one = self.candidate::<true>(next);
            }
            base = pair;
        }
    }

    /// The end of a half-edge at `a` if `OF_A`, else at `b`, as a candidate.
    #[inline(always)]
    fn candidate<const OF_A: bool>(&self, edge: u32) -> Candidate<K> {
        let (after, end) = self.beside::<OF_A>(edge);
        Candidate { edge, site: self.site(end), after, behind: self.to(after) }
    }

    /// Finds the first vertex of one part that a circle through `a` and `b` meets as it grows to the left, from the
    /// given candidate on, and removes the edges at `a` or `b` that cross the new triangle. Returns the vertex's view.
    #[inline(always)]
    fn advance<const OF_A: bool>(&mut self, candidate: &mut Candidate<K>, ends: Ends<K>) -> K::Seen {
        let mut seen = K::see(ends, candidate.site);
        loop {
            let behind = K::see(ends, candidate.behind);
            if !(K::is_left_and_inside(ends, seen, behind) && self.halves.may_go_on()) {
                return seen;
            }
            self.remove(candidate.edge);
            let Candidate { after, behind: site, .. } = *candidate;
            let (after_that, _) = self.beside::<OF_A>(after);
            *candidate = Candidate { edge: after, site, after: after_that, behind: self.to(after_that) };
            seen = behind;
        }
    }

    /// The next half-edge around the same vertex, away from the base edge, and the end of the given half-edge.
    #[inline(always)]
    fn beside<const OF_A: bool>(&self, edge: u32) -> (u32, u32) {
        if OF_A {
            self.next_and_end(edge)
        } else {
            self.previous_and_end(edge)
        }
    }

    /// The half-edges of the outermost vertices of both parts together: left, right, bottom, top.
    #[inline(always)]
    fn outermost(&self, one: &Part, other: &Part, cut: Cut) -> [u32; 4] {
        let by_x = |e: u32| self.from(e);
        let by_y = |e: u32| K::swapped(self.from(e));
        match cut {
            Cut::Vertical => {
                let bottom = if by_y(other.bottom) < by_y(one.bottom) { other.bottom } else { one.bottom };
                let top = if by_y(other.top) > by_y(one.top) { other.top } else { one.top };
                [one.left, other.right, bottom, top]
            }
            Cut::Horizontal => {
                let left = if by_x(other.left) < by_x(one.left) { other.left } else { one.left };
                let right = if by_x(other.right) > by_x(one.right) { other.right } else { one.right };
                [left, right, one.bottom, other.top]
            }
        }
    }
}
