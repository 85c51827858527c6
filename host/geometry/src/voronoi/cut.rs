//! Cutting a ring by the border between two cells.
//!
//! A ring is a simple polygon, counter-clockwise, whose edges lie on edges of the clip or on borders. The part nearer
//! to `p` is kept: chains of corners strictly on that side. Each chain begins and ends on the border. Just beside the
//! border on the side of `p`, the inside of the ring begins where a chain ends, for the inside is on the left of a
//! chain, and stops where a chain begins. So in the order of positions ends and beginnings alternate, and each end is
//! joined with the beginning behind it. Where a chain ends and another begins at the same corner of the ring, the
//! inside is between the two if the ring turns left there, and on both sides if it turns right: the ring then falls
//! into two.

use alloc::vec::Vec;
use core::cmp::Ordering;

use super::corner::{cross, vector};
use super::place::Place;
use crate::point::Point;

/// What an edge of a clipped cell lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The border with the cell of the point of this index.
    Neighbor(u32),
    /// The edge of the clip with this number.
    Clip(u32),
}

/// A corner of a ring, with the edge that begins there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    pub(super) place: Place,
    pub(super) side: Side,
}

/// A point that sees a ring: all that questions need.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) p: Point,
    pub(super) points: &'a [Point],
    /// The corners of the clip. Edge `k` leads from corner `k` to the next one.
    pub(super) clip: &'a [Point],
}

impl View<'_> {
    fn clip_edge(&self, edge: u32) -> [Point; 2] {
        let next = edge as usize + 1;
        [self.clip[edge as usize], self.clip[if next == self.clip.len() { 0 } else { next }]]
    }

    /// The place where an edge of a ring meets the border with `q`.
    fn meet(&self, side: Side, q: Point) -> Place {
        match side {
            Side::Clip(edge) => {
                let [a, b] = self.clip_edge(edge);
                Place::Crossing([a, b, q])
            }
            Side::Neighbor(neighbor) => Place::center(self.p, [self.points[neighbor as usize], q]),
        }
    }

    /// The direction of an edge of a ring.
    fn direction(&self, side: Side) -> [i64; 2] {
        match side {
            Side::Clip(edge) => {
                let [a, b] = self.clip_edge(edge);
                vector(a, b)
            }
            Side::Neighbor(neighbor) => {
                let [x, y] = vector(self.p, self.points[neighbor as usize]);
                [-y, x]
            }
        }
    }

    /// Whether a ring turns left between two of its edges.
    fn turns_left(&self, from: Side, to: Side) -> bool {
        cross(self.direction(from), self.direction(to)) > 0
    }
}

/// The first or last place of a chain, on the border.
#[derive(Clone, Copy)]
struct Tip {
    place: Place,
    chain: usize,
    is_end: bool,
    /// Order at one place: 0 comes before 1.
    rank: u8,
    /// The corner of the ring, if the place is one.
    corner: Option<usize>,
}

/// The lists that cuts reuse.
#[derive(Default)]
pub(super) struct Cutter {
    signs: Vec<Ordering>,
    /// The first and the last corner of each chain, and the beginning and the end on the border.
    chains: Vec<[usize; 2]>,
    tips: Vec<Tip>,
    /// The chain that follows each chain, and the side of the edge between them.
    next: Vec<(usize, Side)>,
    begins: Vec<Bend>,
    ends: Vec<Place>,
    done: Vec<bool>,
}

impl Cutter {
    /// Appends to `out` and `counts` what is left of a ring: corners, and how many each new ring has.
    pub(super) fn cut(&mut self, ring: &[Bend], view: View<'_>, q: u32, out: &mut Vec<Bend>, counts: &mut Vec<usize>) {
        let at = view.points[q as usize];
        self.signs.clear();
        self.signs.extend(ring.iter().map(|bend| bend.place.side(view.p, at)));
        if !self.signs.contains(&Ordering::Less) {
            out.extend_from_slice(ring);
            counts.push(ring.len());
            return;
        }
        self.find_chains(ring.len());
        if self.chains.is_empty() {
            return;
        }
        self.find_tips(ring, view, at);
        self.join(ring, q);
        self.collect(ring, out, counts);
    }

    /// Finds the runs of corners that are strictly nearer to `p`.
    fn find_chains(&mut self, count: usize) {
        self.chains.clear();
        let before = |k: usize| if k == 0 { count - 1 } else { k - 1 };
        let is_near = |k: usize| self.signs[k] == Ordering::Greater;
        for first in (0..count).filter(|&k| is_near(k) && !is_near(before(k))) {
            let mut last = first;
            loop {
                let next = if last + 1 == count { 0 } else { last + 1 };
                if !is_near(next) {
                    break;
                }
                last = next;
            }
            self.chains.push([first, last]);
        }
    }

    /// Finds where each chain leaves and reaches the border.
    fn find_tips(&mut self, ring: &[Bend], view: View<'_>, q: Point) {
        let count = ring.len();
        let (before, after) = (|k: usize| (k + count - 1) % count, |k: usize| (k + 1) % count);
        self.tips.clear();
        self.begins.clear();
        self.ends.clear();
        for (chain, &[first, last]) in self.chains.iter().enumerate() {
            let (outer, beyond) = (before(first), after(last));
            let side = ring[outer].side;
            let is_on = |k: usize| self.signs[k] == Ordering::Equal;
            let begin = if is_on(outer) { ring[outer].place } else { view.meet(side, q) };
            let end = if is_on(beyond) { ring[beyond].place } else { view.meet(ring[last].side, q) };
            // Both tips at one corner of the ring: a left turn has its end first.
            let shared = |k: usize| is_on(k) && self.signs[before(k)].is_gt() && self.signs[after(k)].is_gt();
            let left = |k: usize| view.turns_left(ring[before(k)].side, ring[k].side);
            let begin_rank = u8::from(shared(outer) && left(outer));
            let end_rank = u8::from(shared(beyond) && !left(beyond));
            let corner = |k: usize| is_on(k).then_some(k);
            self.begins.push(Bend { place: begin, side });
            self.ends.push(end);
            self.tips.push(Tip { place: begin, chain, is_end: false, rank: begin_rank, corner: corner(outer) });
            self.tips.push(Tip { place: end, chain, is_end: true, rank: end_rank, corner: corner(beyond) });
        }
        if self.chains.len() > 1 {
            self.tips.sort_unstable_by(|one, other| {
                one.place.compare_positions(other.place, view.p, q).then(one.rank.cmp(&other.rank))
            });
        }
    }

    /// Joins each end with the beginning behind it.
    fn join(&mut self, ring: &[Bend], q: u32) {
        self.next.clear();
        self.next.resize(self.chains.len(), (0, Side::Neighbor(q)));
        if self.chains.len() == 1 {
            self.tips.sort_unstable_by_key(|tip| !tip.is_end);
        }
        for pair in self.tips.windows(2) {
            if pair[0].is_end && !pair[1].is_end {
                self.next[pair[0].chain] = (pair[1].chain, self.side_between(ring, pair[0], pair[1], q));
            }
        }
    }

    /// What the edge between two tips lies on. Where the ring itself runs along the border and has its inside on the
    /// side of `p`, the edge stays that of the ring: the inside does not reach the other cell.
    fn side_between(&self, ring: &[Bend], end: Tip, begin: Tip, q: u32) -> Side {
        let (Some(mut k), Some(last)) = (end.corner, begin.corner) else { return Side::Neighbor(q) };
        let side = ring[k].side;
        while k != last {
            k = if k + 1 == ring.len() { 0 } else { k + 1 };
            if self.signs[k] != Ordering::Equal {
                return Side::Neighbor(q);
            }
        }
        side
    }

    /// Collects the new rings.
    fn collect(&mut self, ring: &[Bend], out: &mut Vec<Bend>, counts: &mut Vec<usize>) {
        self.done.clear();
        self.done.resize(self.chains.len(), false);
        for first in 0..self.chains.len() {
            let (mut chain, begin) = (first, out.len());
            while !self.done[chain] {
                self.done[chain] = true;
                let [from, to] = self.chains[chain];
                out.push(self.begins[chain]);
                let mut k = from;
                loop {
                    out.push(ring[k]);
                    if k == to {
                        break;
                    }
                    k = if k + 1 == ring.len() { 0 } else { k + 1 };
                }
                let (next, side) = self.next[chain];
                // An end at the corner at which the next chain begins would make an edge of length zero.
                if self.ends[chain] != self.begins[next].place {
                    out.push(Bend { place: self.ends[chain], side });
                }
                chain = next;
            }
            if out.len() > begin {
                counts.push(out.len() - begin);
            }
        }
    }
}
