//! The smallest parts, of up to four vertices, which are built without a merge.

use core::cmp::Ordering;

use super::edges::{Edges, Half, Halves};
use super::kernel::{Ends, Kernel};
use super::merge::Part;

/// Four vertices of which no three lie on a line, by the turns of their triples, if the first three turn left. The
/// index has a bit for each left turn: 4 for (0, 1, 3), 2 for (0, 2, 3), 1 for (1, 2, 3). Three vertices of the hull
/// come first, counter-clockwise. The last vertex lies inside their triangle, if so marked, or follows on the hull.
const FOUR: [([u32; 4], bool); 8] = [
    ([0, 3, 2, 1], true),
    ([0, 3, 1, 2], false),
    // No four points have these turns.
    ([0, 1, 2, 3], false),
    ([1, 2, 3, 0], true),
    ([0, 1, 3, 2], false),
    ([0, 1, 2, 3], true),
    ([0, 1, 3, 2], true),
    ([0, 1, 2, 3], false),
];

impl<K: Kernel, H: Halves + ?Sized> Edges<'_, K, H> {
    /// Makes the part of one vertex.
    #[inline(always)]
    pub(super) fn vertex(&mut self, v: u32) -> Part {
        let own = self.start_vertex(v);
        Part { left: own, right: own, bottom: own, top: own, is_vertex: true }
    }

    /// Makes the part of two vertices, `v` and the next one.
    #[inline(always)]
    pub(super) fn edge(&mut self, v: u32) -> Part {
        let own = self.start_edge(v);
        let (a, b) = (self.site(v), self.site(v + 1));
        let lower = |is_first: bool| own + u32::from(!is_first);
        let (by_x, by_y) = (lower(a < b), lower(K::swapped(a) < K::swapped(b)));
        Part { left: by_x, right: by_x ^ 1, bottom: by_y, top: by_y ^ 1, is_vertex: false }
    }

    /// Makes the part of three vertices, `v` and the next two; `None` if they lie on one line.
    #[inline(always)]
    pub(super) fn triangle(&mut self, v: u32) -> Option<Part> {
        let at = |k: u32| self.site(v + k);
        let turn = turn::<K>(K::bounds(|| [at(0), at(1), at(2)]), [at(0), at(1), at(2)]);
        if turn.is_eq() {
            return None;
        }
        let (second, third) = if turn.is_gt() { (1, 2) } else { (2, 1) };
        let corners = [at(0), at(second), at(third)];
        let leaving = self.start_triangle([v, v + second, v + third]);
        Some(outermost::<K, 3>(corners, leaving))
    }

    /// Makes the part of four vertices, `v` and the next three; `None` if three of them lie on one line.
    #[inline(always)]
    pub(super) fn four(&mut self, v: u32) -> Option<Part> {
        let [p0, mut p1, mut p2, p3] = [0, 1, 2, 3].map(|k| self.site(v + k));
        let bounds = K::bounds(|| [p0, p1, p2, p3]);
        let turn = turn::<K>(bounds, [p0, p1, p2]);
        // The second and the third vertex change places, so that the first three turn left.
        let swap = u32::from(turn.is_lt()) * 3;
        if turn.is_lt() {
            (p1, p2) = (p2, p1);
        }
        let of = |three| self::turn::<K>(bounds, three);
        let turns = [turn, of([p0, p1, p3]), of([p0, p2, p3]), of([p1, p2, p3])];
        if turns.iter().any(|turn| turn.is_eq()) {
            return None;
        }
        let bit = |k: usize| usize::from(turns[k].is_gt());
        let (order, is_last_inside) = FOUR[bit(1) << 2 | bit(2) << 1 | bit(3)];
        let [a, b, c, d] = order.map(|k| v + (k ^ if k == 1 || k == 2 { swap } else { 0 }));
        let at = [a, b, c, d].map(|v| self.site(v));
        if is_last_inside {
            let leaving = self.start_star([a, b, c, d]);
            return Some(outermost::<K, 3>([at[0], at[1], at[2]], leaving));
        }
        // The diagonal leads from the first vertex of the order to the third.
        let ends = Ends { a: at[0], b: at[1], bounds };
        let other = K::is_left_and_inside(ends, K::see(ends, at[2]), K::see(ends, at[3]));
        let turned = |all: [u32; 4]| if other { [all[1], all[2], all[3], all[0]] } else { all };
        let [e, f, g, h] = self.start_square(turned([a, b, c, d]));
        let leaving = if other { [h, e, f, g] } else { [e, f, g, h] };
        Some(outermost::<K, 4>(at, leaving))
    }

    /// Makes the half-edges of a triangle with a vertex `d` inside; returns those that leave the hull's
    /// corners along it, counter-clockwise.
    #[inline(always)]
    fn start_star(&mut self, [a, b, c, d]: [u32; 4]) -> [u32; 3] {
        let [ab, bc, ca, da, db, dc] = core::array::from_fn(|_| self.take());
        self.ring([(ab, b), (da ^ 1, d), (ca ^ 1, c)]);
        self.ring([(bc, c), (db ^ 1, d), (ab ^ 1, a)]);
        self.ring([(ca, a), (dc ^ 1, d), (bc ^ 1, b)]);
        self.ring([(da, a), (db, b), (dc, c)]);
        [ab, bc, ca]
    }

    /// Makes the half-edges of a counter-clockwise square with the diagonal from `a` to `c`; returns those that leave
    /// the corners along the hull.
    #[inline(always)]
    fn start_square(&mut self, [a, b, c, d]: [u32; 4]) -> [u32; 4] {
        let [ab, bc, cd, da, ac] = core::array::from_fn(|_| self.take());
        self.ring([(ab, b), (ac, c), (da ^ 1, d)]);
        self.ring([(bc, c), (ab ^ 1, a)]);
        self.ring([(cd, d), (ac ^ 1, a), (bc ^ 1, b)]);
        self.ring([(da, a), (cd ^ 1, c)]);
        [ab, bc, cd, da]
    }

    /// Makes the circle of half-edges around a vertex, counter-clockwise, each given with its end.
    #[inline(always)]
    fn ring<const N: usize>(&mut self, ring: [(u32, u32); N]) {
        for (place, (e, end)) in ring.into_iter().enumerate() {
            let (next, previous) = (ring[(place + 1) % N].0, ring[(place + N - 1) % N].0);
            self.halves.put(e, Half { next, previous, end });
        }
    }
}

/// The turn of three points of a set with these bounds.
#[inline(always)]
fn turn<K: Kernel>(bounds: K::Bounds, [a, b, c]: [K::Site; 3]) -> Ordering {
    K::turn(Ends { a, b, bounds }, c)
}

/// The part with these corners, each with the half-edge that leaves the corner along the hull.
#[inline(always)]
fn outermost<K: Kernel, const N: usize>(corners: [K::Site; N], leaving: [u32; N]) -> Part {
    let least = |keys: [K::Site; N]| {
        let mut found = (keys[0], leaving[0]);
        for k in 1..N {
            found = if keys[k] < found.0 { (keys[k], leaving[k]) } else { found };
        }
        found.1
    };
    let most = |keys: [K::Site; N]| {
        let mut found = (keys[0], leaving[0]);
        for k in 1..N {
            found = if keys[k] > found.0 { (keys[k], leaving[k]) } else { found };
        }
        found.1
    };
    let swapped = corners.map(K::swapped);
    Part { left: least(corners), right: most(corners), bottom: least(swapped), top: most(swapped), is_vertex: false }
}

#[cfg(test)]
mod tests {
    use super::super::view::{Integers, Site, Wide};
    use super::*;

    #[test]
    fn four_turns_tell_the_order_of_four_vertices() {
        let at = |k: u32| Site::at(k % 5, k / 5);
        let is_left = |a: Site, b: Site, c: Site| Integers::<Wide>::orient2d(a, b, c).is_gt();
        let mut found = [0; 8];
        for all in (0..25u32.pow(4)).map(|k| [k % 25, k / 25 % 25, k / 625 % 25, k / 15_625].map(at)) {
            let turns = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]].map(|of| of.map(|k: usize| all[k]));
            if turns.iter().any(|&[a, b, c]| Integers::<Wide>::orient2d(a, b, c).is_eq()) {
                continue;
            }
            let [first, rest @ ..] = turns.map(|[a, b, c]| usize::from(is_left(a, b, c)));
            if first == 0 {
                continue;
            }
            let place = rest.into_iter().fold(0, |place, bit| place << 1 | bit);
            let (order, is_last_inside) = FOUR[place];
            let [a, b, c, d] = order.map(|k| all[k as usize]);
            let hull = if is_last_inside { [(a, b), (b, c), (c, a), (a, b)] } else { [(a, b), (b, c), (c, d), (d, a)] };
            for (from, to) in hull {
                assert!([a, b, c, d].into_iter().all(|p| p == from || p == to || is_left(from, to, p)), "{all:?}");
            }
            found[place] += 1;
        }
        assert!(found.iter().enumerate().all(|(place, &count)| (count > 100) == (place != 2)), "{found:?}");
    }
}
