//! The merge of two triangulations on both sides of a line (Guibas and Stolfi 1985).

#[cfg(feature = "std")]
use super::edges::{moved, Half, HALVES};
use super::edges::{Edges, Free};
use super::kernel::{is_inside, Kernel};

/// The triangulation of a subset of the points, known by its outermost vertices. Each of those is given as the
/// half-edge that leaves it counter-clockwise along the hull.
#[derive(Clone, Copy)]
pub(super) struct Part {
    /// At the vertex of smallest x, and of smallest y among those.
    left: u32,
    /// At the vertex of largest x, and of largest y among those.
    right: u32,
    /// At the vertex of smallest y, and of smallest x among those.
    bottom: u32,
    /// At the vertex of largest y, and of largest x among those.
    top: u32,
    /// Unused half-edges for more edges.
    free: Free,
    /// Whether the part is a single vertex, whose half-edge leads back to it.
    is_vertex: bool,
}

impl Part {
    /// Renumbers the half-edges of a segment, which begins with vertex `first`, from the start of all; returns the part
    /// with the new numbers.
    #[cfg(feature = "std")]
    pub(super) fn moved(self, halves: &mut [Half], first: u32) -> Self {
        let by = HALVES as u32 * first;
        for half in halves.iter_mut() {
            half.move_by(by, first);
        }
        let Self { left, right, bottom, top, free, is_vertex } = self;
        let free = Free { first: moved(free.first, by), last: moved(free.last, by) };
        Self { left: left + by, right: right + by, bottom: bottom + by, top: top + by, free, is_vertex }
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

/// The base edge, from `a` in the first part to `b` in the second. The gap that is still to be filled lies to the left
/// of the base edge.
#[derive(Clone, Copy)]
struct Base {
    /// The half of the base edge that begins at `a`.
    at_a: u32,
    /// The half of the base edge that begins at `b`.
    at_b: u32,
    a: u32,
    b: u32,
}

/// A vertex of one part that may become the third corner of the next triangle: the end of `edge`, which begins
/// at `a` or `b`.
#[derive(Clone, Copy)]
struct Candidate<K: Kernel> {
    edge: u32,
    end: u32,
    seen: K::Seen,
}

impl<K: Kernel> Candidate<K> {
    /// Whether the vertex lies to the left of the base edge.
    #[inline(always)]
    fn is_valid(&self) -> bool {
        K::is_left(self.seen)
    }
}

impl<K: Kernel> Edges<'_, K> {
    /// Makes the part of one vertex.
    #[inline(always)]
    pub(super) fn vertex(&mut self, v: u32) -> Part {
        let (own, free) = self.start_vertex(v);
        Part { left: own, right: own, bottom: own, top: own, free, is_vertex: true }
    }

    /// Makes the part of two vertices, `v` and the next one.
    #[inline(always)]
    pub(super) fn edge(&mut self, v: u32) -> Part {
        let (own, free) = self.start_edge(v);
        let (a, b) = (self.site(v), self.site(v + 1));
        let lower = |is_first: bool| own + u32::from(!is_first);
        let (by_x, by_y) = (lower(a < b), lower(K::swapped(a) < K::swapped(b)));
        Part { left: by_x, right: by_x ^ 1, bottom: by_y, top: by_y ^ 1, free, is_vertex: false }
    }

    /// Makes the part of three vertices, `v` and the next two; `None` if they lie on one line.
    #[inline(always)]
    pub(super) fn triangle(&mut self, v: u32) -> Option<Part> {
        let at = |k: u32| self.site(v + k);
        let turn = K::orient2d(at(0), at(1), at(2));
        if turn.is_eq() {
            return None;
        }
        let (second, third) = if turn.is_gt() { (1, 2) } else { (2, 1) };
        let corners = [at(0), at(second), at(third)];
        let (own, free) = self.start_triangle(v, [v, v + second, v + third]);
        // The half-edge of each corner along the hull is the first one of a pair: 0, 2 and 4 from `own` on.
        let least = |keys: [K::Site; 3]| {
            let (key, place) = if keys[1] < keys[0] { (keys[1], 2) } else { (keys[0], 0) };
            own + if keys[2] < key { 4 } else { place }
        };
        let most = |keys: [K::Site; 3]| {
            let (key, place) = if keys[1] > keys[0] { (keys[1], 2) } else { (keys[0], 0) };
            own + if keys[2] > key { 4 } else { place }
        };
        let swapped = corners.map(K::swapped);
        let (left, right, bottom, top) = (least(corners), most(corners), least(swapped), most(swapped));
        Some(Part { left, right, bottom, top, free, is_vertex: false })
    }

    /// Joins two parts, at least one of which has an edge.
    pub(super) fn merge(&mut self, one: Part, other: Part, cut: Cut) -> Part {
        debug_assert!(!(one.is_vertex && other.is_vertex), "the pair of one would be lost");
        let mut free = self.join(one.free, other.free);
        let first = self.lower_tangent(&one, &other, cut, &mut free);
        // `zip` may remove the half-edges of vertices that are ends of the first or the last base edge. The vertices
        // stay, so both are remembered, and such a half-edge is replaced by that of the base edge.
        let outermost = self.outermost(&one, &other, cut).map(|e| (e, self.origin(e)));
        let last = self.zip(first, &mut free);
        let [left, right, bottom, top] = outermost.map(|(e, vertex)| {
            let e = if vertex == first.a { first.at_a } else { e };
            if vertex == last.b {
                last.at_b
            } else {
                e
            }
        });
        Part { left, right, bottom, top, free, is_vertex: false }
    }

    /// Makes the first base edge. All points of both parts lie on its line or to its left.
    #[inline(always)]
    fn lower_tangent(&mut self, one: &Part, other: &Part, cut: Cut, free: &mut Free) -> Base {
        let (facing, mut rdi) = match cut {
            Cut::Vertical => (one.right, other.left),
            Cut::Horizontal => (one.top, other.bottom),
        };
        // `ldi` runs clockwise along the hull of the first part, `rdi` counter-clockwise along that of the other one.
        // The half-edge of a single vertex ends where it begins, so its predicate is zero and it never moves.
        let mut ldi = self.previous(facing);
        let (mut a, mut b) = (self.from(ldi), self.from(rdi));
        loop {
            if K::orient2d(a, self.to(ldi), b).is_gt() {
                ldi = self.previous(ldi ^ 1);
                a = self.from(ldi);
            } else if K::orient2d(b, self.to(rdi), a).is_lt() {
                rdi = self.next(rdi ^ 1);
                b = self.from(rdi);
            } else {
                break;
            }
        }
        self.first_edge((ldi, one.is_vertex), (rdi, other.is_vertex), free)
    }

    /// Makes the edge between the origins of two half-edges along the hulls. A single vertex already has a
    /// pair for the edge.
    #[inline(always)]
    fn first_edge(
        &mut self,
        (ldi, a_is_vertex): (u32, bool),
        (rdi, b_is_vertex): (u32, bool),
        free: &mut Free,
    ) -> Base {
        let (a, b) = (self.origin(ldi), self.origin(rdi));
        let at_a = match (a_is_vertex, b_is_vertex) {
            (true, _) => ldi,
            (false, true) => rdi ^ 1,
            (false, false) => self.take(free),
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
        Base { at_a, at_b, a, b }
    }

    /// Fills the gap with triangles from the first base edge on; returns the last base edge.
    #[inline(always)]
    fn zip(&mut self, mut base: Base, free: &mut Free) -> Base {
        loop {
            let (a, b) = (self.site(base.a), self.site(base.b));
            let one = self.candidate::<true>(base, a, b, free);
            let other = self.candidate::<false>(base, a, b, free);
            let other_is_next = match (one.is_valid(), other.is_valid()) {
                (false, false) => return base,
                (true, true) => is_inside::<K>(a, b, one.seen, other.seen),
                (_, other_is_valid) => other_is_valid,
            };
            base = self.connect(base, one, other, other_is_next, free);
        }
    }

    /// Finds the first vertex of one part that a circle through `a` and `b` meets as it grows to the left, and removes
    /// the edges at `a` or `b` that cross the new triangle. The part is the first one if `OF_A`, else the second.
    #[inline(always)]
    fn candidate<const OF_A: bool>(&mut self, base: Base, a: K::Site, b: K::Site, free: &mut Free) -> Candidate<K> {
        let mut edge = if OF_A { self.next(base.at_a) } else { self.previous(base.at_b) };
        let (mut after, mut end) = self.beside::<OF_A>(edge);
        let mut seen = K::see(a, b, self.site(end));
        while K::is_left(seen) {
            let (after_next, end_of_next) = self.beside::<OF_A>(after);
            let behind = K::see(a, b, self.site(end_of_next));
            if !is_inside::<K>(a, b, seen, behind) {
                break;
            }
            self.remove(edge, free);
            (edge, after, end, seen) = (after, after_next, end_of_next, behind);
        }
        Candidate { edge, end, seen }
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

    /// Makes the next base edge: from `a` to the end of `other`, or from the end of `one` to `b`. The code selects
    /// instead of branching, because no processor predicts which of the two it is.
    #[inline(always)]
    fn connect(
        &mut self,
        base: Base,
        one: Candidate<K>,
        other: Candidate<K>,
        other_is_next: bool,
        free: &mut Free,
    ) -> Base {
        let select = |if_other: u32, if_one: u32| if other_is_next { if_other } else { if_one };
        let pair = self.take(free);
        let (at_kept, at_corner) = (pair, pair ^ 1);
        // `back` leads from the new corner to `a` or `b`. The new half-edge stands beside `back`, on the
        // side of the base.
        let back = select(other.edge, one.edge) ^ 1;
        let (corner, kept) = (select(other.end, one.end), select(base.a, base.b));
        let (next, previous) = (self.next(back), self.previous(back));
        self.insert(at_corner, kept, select(previous, back), select(back, next));
        self.insert(at_kept, corner, select(base.at_a, other.edge), select(one.edge, base.at_b));
        Base {
            at_a: select(at_kept, at_corner),
            at_b: select(at_corner, at_kept),
            a: select(base.a, corner),
            b: select(corner, base.b),
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
