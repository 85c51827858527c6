//! From the triangles and the hull of a part to half-edges in rings around their vertices.

use alloc::vec;
use alloc::vec::Vec;

use super::super::edges::{Half, HALVES};
use super::super::merge::Part;
use super::super::view::Site;
use super::Unsound;

/// A half-edge, or a link, that is not known yet.
const NONE: u32 = u32::MAX;
/// The `next` of a half-edge that has the outside to its left, until its ring is closed.
const OUTSIDE: u32 = u32::MAX - 1;

/// The half-edges of a part.
#[derive(Debug)]
pub(super) struct Rings {
    /// The half-edges in pairs, without the unused pairs behind them.
    pub(super) halves: Vec<Half>,
    /// The half-edges that have final triangles to their left.
    pub(super) holes: Vec<u32>,
    pub(super) part: Part,
}

impl Rings {
    /// The half-edges of triangles that stand counter-clockwise, and of a counter-clockwise hull.
    pub(super) fn of(sites: &[Site], triangles: &[[u32; 3]], hull: &[u32]) -> Result<Self, Unsound> {
        let mut links = Links::of(3 * triangles.len() + hull.len())?;
        triangles.iter().try_for_each(|&corners| links.add_triangle(corners))?;
        let after = hull.iter().cycle().skip(1);
        let outer =
            hull.iter().zip(after).map(|(&from, &to)| links.add_outside(to, from)).collect::<Result<Vec<_>, _>>()?;
        // A plane graph on so many vertices has fewer edges.
        if links.halves.len() >= HALVES * sites.len() {
            return Err(Unsound);
        }
        let holes = links.close(sites);
        let halves = links.halves;
        // The outer half of a hull edge leads back to the vertex that the inner half leaves.
        let leaving = |best: Option<usize>| best.and_then(|place| outer.get(place)).map_or(0, |outer| outer ^ 1);
        let places = || 0..hull.len();
        let by_x = |place: &usize| sites[hull[*place] as usize];
        let by_y = |place: &usize| swapped(by_x(place));
        let part = Part {
            left: leaving(places().min_by_key(by_x)),
            right: leaving(places().max_by_key(by_x)),
            bottom: leaving(places().min_by_key(by_y)),
            top: leaving(places().max_by_key(by_y)),
            is_vertex: false,
        };
        Ok(Self { halves, holes, part })
    }

    /// The half-edges of all vertices if they lie on one line, given in lexicographic order. There is at least one.
    pub(super) fn of_line(sites: &[Site], line: &[u32]) -> Self {
        let [first, .., last] = *line else {
            let alone = |e| Half { next: e, previous: e, end: 0 };
            let part = Part { left: 0, right: 0, bottom: 0, top: 0, is_vertex: true };
            return Self { halves: vec![alone(0), alone(1)], holes: Vec::new(), part };
        };
        let edges = line.len() as u32 - 1;
        let mut halves = Vec::with_capacity(2 * line.len());
        for (edge, ends) in (0..).zip(line.windows(2)) {
            // Between the ends of the line each vertex has two half-edges, which follow each other.
            let before = if edge == 0 { 0 } else { 2 * edge - 1 };
            let after = if edge + 1 == edges { 2 * edge + 1 } else { 2 * edge + 2 };
            halves.push(Half { next: before, previous: before, end: ends[1] });
            halves.push(Half { next: after, previous: after, end: ends[0] });
        }
        let (left, right) = (0, 2 * edges - 1);
        let rises = swapped(sites[first as usize]) < swapped(sites[last as usize]);
        let (bottom, top) = if rises { (left, right) } else { (right, left) };
        Self { halves, holes: Vec::new(), part: Part { left, right, bottom, top, is_vertex: false } }
    }
}

/// The site with its axes swapped, so that sites compare by y, then x.
fn swapped(site: Site) -> Site {
    Site::at(site.y(), site.x())
}

/// Half-edges whose links around the vertices are being made.
struct Links {
    halves: Vec<Half>,
    /// A hash table with open addressing: for each edge its pair, plus [`TAKEN`]. It is at most half full.
    pairs: Vec<u32>,
    /// The bits of a hash below those that are a place in the table.
    shift: u32,
}

/// The difference between a pair and its entry in the table, whose empty places are zero.
const TAKEN: u32 = 2;

impl Links {
    /// Empty lists with room for the edges of so many sides of triangles and of the outside.
    fn of(sides: usize) -> Result<Self, Unsound> {
        if sides >= OUTSIDE as usize / 4 {
            return Err(Unsound);
        }
        let places = (2 * sides).next_power_of_two().max(2);
        let shift = u64::BITS - places.ilog2();
        Ok(Self { halves: Vec::with_capacity(sides + 2), pairs: vec![0; places], shift })
    }

    /// The half-edge between two vertices. If it is not there yet, this function makes its pair.
    #[inline(always)]
    fn half_between(&mut self, from: u32, to: u32) -> u32 {
        // The golden ratio, as a fraction of 2^64, spreads edges that have an end in common.
        const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
        let (smaller, larger) = (from.min(to), from.max(to));
        let hash = (u64::from(smaller) << u32::BITS | u64::from(larger)).wrapping_mul(GOLDEN);
        let mut place = (hash >> self.shift) as usize;
        while let Some(pair) = self.pairs[place].checked_sub(TAKEN) {
            let [leading, back] = [pair, pair + 1].map(|e| self.halves[e as usize].end);
            if (leading == larger) & (back == smaller) {
                return pair + u32::from(to < from);
            }
            place = (place + 1) & (self.pairs.len() - 1);
        }
        let pair = self.halves.len() as u32;
        self.pairs[place] = pair + TAKEN;
        self.halves.extend([larger, smaller].map(|end| Half { next: NONE, previous: NONE, end }));
        pair + u32::from(to < from)
    }

    /// Links the half-edges around the corners of a triangle. Fails if it names a vertex twice, or if another triangle
    /// has one of its sides.
    #[inline(always)]
    fn add_triangle(&mut self, [a, b, c]: [u32; 3]) -> Result<(), Unsound> {
        if (a == b) | (b == c) | (c == a) {
            return Err(Unsound);
        }
        let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[from, to]| self.half_between(from, to));
        let next = |e: u32| self.halves[e as usize].next;
        if next(ab) & next(bc) & next(ca) != NONE {
            return Err(Unsound);
        }
        self.link(ab, ca ^ 1);
        self.link(bc, ab ^ 1);
        self.link(ca, bc ^ 1);
        Ok(())
    }

    /// Marks the half-edge between two vertices, which has the outside to its left. Fails if it has a triangle there.
    fn add_outside(&mut self, from: u32, to: u32) -> Result<u32, Unsound> {
        if from == to {
            return Err(Unsound);
        }
        let e = self.half_between(from, to);
        let known = core::mem::replace(&mut self.halves[e as usize].next, OUTSIDE);
        if known == NONE {
            Ok(e)
        } else {
            Err(Unsound)
        }
    }

    /// Makes `after` the half-edge that follows `e` counter-clockwise around their origin.
    #[inline(always)]
    fn link(&mut self, e: u32, after: u32) {
        self.halves[e as usize].next = after;
        self.halves[after as usize].previous = e;
    }

    /// Closes the rings. The triangles around a vertex leave one or more arcs of half-edges, with the outside or holes
    /// between them. No half-edge has two followers, so an arc that has a first half-edge has a last one. Returns the
    /// half-edges that have neither a triangle nor the outside to their left, but a hole.
    fn close(&mut self, sites: &[Site]) -> Vec<u32> {
        let mut holes = Vec::with_capacity(sites.len());
        // The first half-edges of the arcs at a vertex form a list, which begins in `newest`.
        let (mut newest, mut before) = (vec![NONE; sites.len()], vec![NONE; self.halves.len()]);
        for e in 0..self.halves.len() as u32 {
            let Half { next, previous, .. } = self.halves[e as usize];
            if next == NONE {
                holes.push(e);
            }
            if previous == NONE {
                let origin = self.halves[(e ^ 1) as usize].end as usize;
                before[e as usize] = core::mem::replace(&mut newest[origin], e);
            }
        }
        let mut arcs = Vec::new();
        for (&origin, &newest) in sites.iter().zip(&newest) {
            arcs.clear();
            let known = |e: u32| (e != NONE).then_some(e);
            arcs.extend(core::iter::successors(known(newest), |&e| known(before[e as usize])));
            if arcs.len() > 1 {
                arcs.sort_by(|&one, &other| {
                    let end = |e: u32| sites[self.halves[e as usize].end as usize];
                    by_angle(origin, end(one), end(other))
                });
            }
            for (place, &first) in arcs.iter().enumerate() {
                let mut last = first;
                while self.halves[last as usize].next < OUTSIDE {
                    last = self.halves[last as usize].next;
                }
                self.link(last, arcs[(place + 1) % arcs.len()]);
            }
        }
        holes
    }
}

/// Compares the directions from `origin` to two sites, counter-clockwise from that of growing x.
fn by_angle(origin: Site, one: Site, other: Site) -> core::cmp::Ordering {
    let seen = |site: Site| {
        let minus = |a: u32, b: u32| i64::from(a) - i64::from(b);
        [minus(site.x(), origin.x()), minus(site.y(), origin.y())]
    };
    let is_second_half = |[x, y]: [i64; 2]| y < 0 || (y == 0 && x < 0);
    let (one, other) = (seen(one), seen(other));
    let product = |a: i64, b: i64| i128::from(a) * i128::from(b);
    let cross = product(one[0], other[1]) - product(one[1], other[0]);
    is_second_half(one).cmp(&is_second_half(other)).then(0.cmp(&cross))
}
