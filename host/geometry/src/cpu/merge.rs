//! Two triangulations on both sides of a line become one (Guibas and Stolfi 1985).

#[cfg(feature = "std")]
use super::edges::{moved, Half, HALVES};
use super::edges::{Edges, Free};
use super::view::{incircle, orient2d, Seen, Site, Width};

/// The triangulation of some points: its outermost vertices, each as the half-edge that leaves it counter-clockwise
/// along the hull.
#[derive(Clone, Copy)]
pub(super) struct Part {
    /// Smallest x, then y.
    left: u32,
    /// Largest x, then y.
    right: u32,
    /// Smallest y, then x.
    bottom: u32,
    /// Largest y, then x.
    top: u32,
    /// Half-edges for more edges.
    free: Free,
    /// The part is a single vertex, and its half-edge leads nowhere.
    is_vertex: bool,
}

impl Part {
    /// The part after its half-edges, numbered from the start of a stretch, are numbered from the start of all, where
    /// the stretch begins with vertex `first`.
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

    /// The half-edge that leaves the leftmost vertex along the hull.
    pub(super) fn leftmost(&self) -> u32 {
        self.left
    }
}

/// The cut between two parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// The first lies to the left of the second: all its x are smaller.
    Vertical,
    /// The first lies below the second: all its y are smaller.
    Horizontal,
}

/// The base edge: it runs from `a` in the first part to `b` in the second one, and all that is left to do lies to its
/// left.
#[derive(Clone, Copy)]
struct Base {
    /// The half of the base edge that begins at `a`.
    at_a: u32,
    /// The half of the base edge that begins at `b`.
    at_b: u32,
    a: u32,
    b: u32,
}

/// The end of an edge that may become a corner of the next triangle.
#[derive(Clone, Copy)]
struct Candidate {
    edge: u32,
    end: u32,
    seen: Seen,
}

impl Candidate {
    /// Whether the point lies to the left of the base edge.
    #[inline(always)]
    fn is_valid(&self) -> bool {
        self.seen.view.cross > 0
    }
}

impl Edges<'_> {
    /// The part of one vertex.
    #[inline(always)]
    pub(super) fn vertex(&mut self, v: u32) -> Part {
        let (own, free) = self.start_vertex(v);
        Part { left: own, right: own, bottom: own, top: own, free, is_vertex: true }
    }

    /// The part of two vertices, `v` and the next one.
    #[inline(always)]
    pub(super) fn edge(&mut self, v: u32) -> Part {
        let (own, free) = self.start_edge(v);
        let (a, b) = (self.site(v), self.site(v + 1));
        let lower = |is_first: bool| own + u32::from(!is_first);
        let (by_x, by_y) = (lower(a < b), lower(a.swapped() < b.swapped()));
        Part { left: by_x, right: by_x ^ 1, bottom: by_y, top: by_y ^ 1, free, is_vertex: false }
    }

    /// The part of three vertices, `v` and the next two; `None` if they lie on one line.
    #[inline(always)]
    pub(super) fn triangle(&mut self, v: u32) -> Option<Part> {
        let at = |k: u32| self.site(v + k);
        let area = orient2d(at(0), at(1), at(2));
        if area == 0 {
            return None;
        }
        let (second, third) = if area > 0 { (1, 2) } else { (2, 1) };
        let corners = [at(0), at(second), at(third)];
        let (own, free) = self.start_triangle(v, [v, v + second, v + third]);
        // Each corner's half-edge along the hull is the first one of a pair.
        let least = |keys: [Site; 3]| {
            let (key, place) = if keys[1] < keys[0] { (keys[1], 2) } else { (keys[0], 0) };
            own + if keys[2] < key { 4 } else { place }
        };
        let most = |keys: [Site; 3]| {
            let (key, place) = if keys[1] > keys[0] { (keys[1], 2) } else { (keys[0], 0) };
            own + if keys[2] > key { 4 } else { place }
        };
        let swapped = corners.map(Site::swapped);
        let (left, right, bottom, top) = (least(corners), most(corners), least(swapped), most(swapped));
        Some(Part { left, right, bottom, top, free, is_vertex: false })
    }

    /// Joins two parts, of which one at least has an edge.
    pub(super) fn merge<W: Width>(&mut self, one: Part, other: Part, cut: Cut) -> Part {
        debug_assert!(!(one.is_vertex && other.is_vertex), "the pair of one would be lost");
        let mut free = self.join(one.free, other.free);
        let first = self.lower_tangent(&one, &other, cut, &mut free);
        // Their half-edges may be gone after the next line, where they are the ends of the first or the last base edge.
        let outermost = self.outermost(&one, &other, cut).map(|e| (e, self.origin(e)));
        let last = self.zip::<W>(first, &mut free);
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

    /// The first base edge: all points of both parts lie on its line or to its left.
    #[inline(always)]
    fn lower_tangent(&mut self, one: &Part, other: &Part, cut: Cut, free: &mut Free) -> Base {
        let (facing, mut rdi) = match cut {
            Cut::Vertical => (one.right, other.left),
            Cut::Horizontal => (one.top, other.bottom),
        };
        // Half-edges along the hulls: of the first part clockwise, of the other one counter-clockwise. That of a single
        // vertex ends where it begins, and nothing turns around it.
        let mut ldi = self.previous(facing);
        let (mut a, mut b) = (self.from(ldi), self.from(rdi));
        loop {
            if orient2d(a, self.to(ldi), b) > 0 {
                ldi = self.previous(ldi ^ 1);
                a = self.from(ldi);
            } else if orient2d(b, self.to(rdi), a) < 0 {
                rdi = self.next(rdi ^ 1);
                b = self.from(rdi);
            } else {
                break;
            }
        }
        self.first_edge((ldi, one.is_vertex), (rdi, other.is_vertex), free)
    }

    /// The edge between the origins of two half-edges along the hulls. A single vertex has a pair for it already.
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

    /// Fills the gap from the first base edge on; returns the last one.
    #[inline(always)]
    fn zip<W: Width>(&mut self, mut base: Base, free: &mut Free) -> Base {
        loop {
            let (a, b) = (self.site(base.a), self.site(base.b));
            let one = self.candidate::<W, true>(base, a, b, free);
            let other = self.candidate::<W, false>(base, a, b, free);
            let other_is_next = match (one.is_valid(), other.is_valid()) {
                (false, false) => return base,
                (true, true) => incircle::<W>(a, b, one.seen, other.seen),
                (_, other_is_valid) => other_is_valid,
            };
            base = self.connect(base, one, other, other_is_next, free);
        }
    }

    /// The first point of one part, the first one if `OF_A`, that a circle through `a` and `b` meets as it grows to the
    /// left; edges of that part's end of the base that are in the way are removed.
    #[inline(always)]
    fn candidate<W: Width, const OF_A: bool>(&mut self, base: Base, a: Site, b: Site, free: &mut Free) -> Candidate {
        let mut edge = if OF_A { self.next(base.at_a) } else { self.previous(base.at_b) };
        let (mut after, mut end) = self.beside::<OF_A>(edge);
        let mut seen = Seen::new(a, b, self.site(end));
        while seen.view.cross > 0 {
            let (after_next, end_of_next) = self.beside::<OF_A>(after);
            let behind = Seen::new(a, b, self.site(end_of_next));
            if !incircle::<W>(a, b, seen, behind) {
                break;
            }
            self.remove(edge, free);
            (edge, after, end, seen) = (after, after_next, end_of_next, behind);
        }
        Candidate { edge, end, seen }
    }

    /// The half-edge further from the base around the same vertex, and the end of this one.
    #[inline(always)]
    fn beside<const OF_A: bool>(&self, edge: u32) -> (u32, u32) {
        if OF_A {
            self.next_and_end(edge)
        } else {
            self.previous_and_end(edge)
        }
    }

    /// The next base edge: from `a` to the end of `other`, or from the end of `one` to `b`. Selections instead of
    /// branches: no processor predicts which one it is.
    #[inline(always)]
    fn connect(&mut self, base: Base, one: Candidate, other: Candidate, other_is_next: bool, free: &mut Free) -> Base {
        let select = |if_other: u32, if_one: u32| if other_is_next { if_other } else { if_one };
        let pair = self.take(free);
        let (at_kept, at_corner) = (pair, pair ^ 1);
        // The half-edge from the new corner back to `a` or `b`; the new one stands beside it, on the side of the base.
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

    /// The outermost vertices of both parts together: left, right, bottom, top.
    #[inline(always)]
    fn outermost(&self, one: &Part, other: &Part, cut: Cut) -> [u32; 4] {
        let by_x = |e: u32| self.from(e);
        let by_y = |e: u32| self.from(e).swapped();
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
