//! From the triangles and the hull of a part to half-edges in rings around their vertices.

use alloc::vec;
use alloc::vec::Vec;

use super::super::edges::{Half, HALVES};
use super::super::merge::Part;
use super::super::view::Site;
use super::Unsound;

/// A half-edge, or a link, that is not known yet.
const NONE: u32 = u32::MAX;

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
        let mut links = Links::pair(sites.len(), triangles, hull)?;
        links.turn_around(triangles);
        links.close(sites);
        let Links { halves, holes, numbers, .. } = links;
        // The outer half of a hull edge leads back to the vertex that the inner half leaves.
        let inner = &numbers[3 * triangles.len()..];
        let leaving = |best: Option<usize>| best.and_then(|place| inner.get(place)).map_or(0, |outer| outer ^ 1);
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
    holes: Vec<u32>,
    /// The number of the half-edge `3 t + k` from corner `k` of triangle `t` to the next one, then that of the outer
    /// half of each hull edge.
    numbers: Vec<u32>,
}

/// A side of a triangle or of the outside. The upper 32 bits are the larger of its ends. The lower ones are its number
/// in the list of all sides, doubled, plus 1 if the side leads to the smaller end. One word is quicker to sort than
/// two.
type Side = u64;

/// The larger end of a side.
fn larger_end(side: Side) -> u32 {
    (side >> u32::BITS) as u32
}

impl Links {
    /// Gives a pair of half-edges to each edge. An edge that has a side with no triangle lies at a hole.
    fn pair(vertices: usize, triangles: &[[u32; 3]], hull: &[u32]) -> Result<Self, Unsound> {
        let sides = Sides::of(vertices, triangles, hull)?;
        let mut links = Self { halves: Vec::new(), holes: Vec::new(), numbers: vec![NONE; sides.list.len()] };
        links.halves.reserve(sides.list.len() + 2);
        for smaller in 0..vertices {
            for own in sides.at(smaller).chunk_by(|&one, &other| larger_end(one) == larger_end(other)) {
                links.add_edge(smaller as u32, own)?;
            }
        }
        // A plane graph on so many vertices has fewer edges.
        if links.halves.len() >= HALVES * vertices {
            return Err(Unsound);
        }
        Ok(links)
    }

    /// Makes the pair of an edge from its sides, of which there are one or two.
    fn add_edge(&mut self, smaller: u32, sides: &[Side]) -> Result<(), Unsound> {
        let pair = self.halves.len() as u32;
        let larger = larger_end(sides[0]);
        let half = |end| Half { next: NONE, previous: NONE, end };
        self.halves.extend([half(larger), half(smaller)]);
        let number = |side: Side| pair + (side as u32 & 1);
        match sides {
            [only] => self.holes.push(number(*only) ^ 1),
            [one, other] if number(*one) != number(*other) => {}
            _ => return Err(Unsound),
        }
        for &side in sides {
            self.numbers[side as u32 as usize / 2] = number(side);
        }
        Ok(())
    }

    /// Links the half-edges around the corners of each triangle.
    fn turn_around(&mut self, triangles: &[[u32; 3]]) {
        for first in (0..3 * triangles.len()).step_by(3) {
            let [ab, bc, ca] = [0, 1, 2].map(|k| self.numbers[first + k]);
            self.link(ab, ca ^ 1);
            self.link(bc, ab ^ 1);
            self.link(ca, bc ^ 1);
        }
    }

    /// Makes `after` the half-edge that follows `e` counter-clockwise around their origin.
    fn link(&mut self, e: u32, after: u32) {
        self.halves[e as usize].next = after;
        self.halves[after as usize].previous = e;
    }

    /// Closes the rings. The triangles around a vertex leave one or more arcs of half-edges, with the outside or holes
    /// between them. No half-edge has two followers, so an arc that has a first half-edge has a last one.
    fn close(&mut self, sites: &[Site]) {
        // The first half-edges of the arcs at a vertex form a list, which begins in `newest`.
        let (mut newest, mut before) = (vec![NONE; sites.len()], vec![NONE; self.halves.len()]);
        for e in 0..self.halves.len() as u32 {
            if self.halves[e as usize].previous == NONE {
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
                while self.halves[last as usize].next != NONE {
                    last = self.halves[last as usize].next;
                }
                self.link(last, arcs[(place + 1) % arcs.len()]);
            }
        }
    }
}

/// All sides of triangles and of the outside, by the smaller of their ends.
struct Sides {
    list: Vec<Side>,
    /// For each vertex, the end of its sides in the list.
    ends: Vec<u32>,
}

impl Sides {
    /// Lists the sides, sorted. Fails if a side names a vertex that does not exist, or one vertex twice.
    fn of(vertices: usize, triangles: &[[u32; 3]], hull: &[u32]) -> Result<Self, Unsound> {
        let inner = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let after = hull.iter().cycle().skip(1);
        let outer = hull.iter().zip(after).map(|(&from, &to)| [to, from]);
        let sides = || inner.clone().chain(outer.clone());
        let mut ends = vec![0u32; vertices];
        let mut count = 0;
        for [from, to] in sides() {
            let smaller = from.min(to) as usize;
            if from == to || from.max(to) as usize >= vertices {
                return Err(Unsound);
            }
            ends[smaller] += 1;
            count += 1;
        }
        if count >= NONE as usize / 2 {
            return Err(Unsound);
        }
        let mut start = 0;
        for end in &mut ends {
            start += core::mem::replace(end, start);
        }
        let mut list = vec![0; count];
        for ([from, to], number) in sides().zip(0u32..) {
            let end = &mut ends[from.min(to) as usize];
            list[*end as usize] = Side::from(from.max(to)) << u32::BITS | Side::from(2 * number + u32::from(to < from));
            *end += 1;
        }
        let mut all = Self { list, ends };
        for v in 0..vertices {
            let own = all.range(v);
            all.list[own].sort_unstable();
        }
        Ok(all)
    }

    fn range(&self, smaller: usize) -> core::ops::Range<usize> {
        let start = smaller.checked_sub(1).map_or(0, |before| self.ends[before]);
        start as usize..self.ends[smaller] as usize
    }

    fn at(&self, smaller: usize) -> &[Side] {
        &self.list[self.range(smaller)]
    }
}

/// Compares the directions from `origin` to two sites, counter-clockwise from that of growing x.
fn by_angle(origin: Site, one: Site, other: Site) -> core::cmp::Ordering {
    let seen = |site: Site| {
        let minus = |a: u32, b: u32| i128::from(a) - i128::from(b);
        [minus(site.x(), origin.x()), minus(site.y(), origin.y())]
    };
    let is_second_half = |[x, y]: [i128; 2]| y < 0 || (y == 0 && x < 0);
    let (one, other) = (seen(one), seen(other));
    let cross = one[0] * other[1] - one[1] * other[0];
    is_second_half(one).cmp(&is_second_half(other)).then(0.cmp(&cross))
}
