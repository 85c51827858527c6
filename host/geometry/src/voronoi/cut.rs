//! Cutting rings by the border between two cells.
//!
//! The rings bound a region, which lies on their left: outer ones are counter-clockwise, and holes clockwise. Their
//! edges lie on edges of the clip or on borders. The part nearer to `p` is kept: chains of corners strictly on that
//! side. Each chain begins and ends on the border. Just beside the border on the side of `p`, the inside of the region
//! begins where a chain ends, for the inside is on the left of a chain, and stops where a chain begins. So in the order
//! of positions ends and beginnings alternate, and each end is joined with the beginning behind it. Where several
//! chains end and begin at one place, the order just beside the border is that of their directions there.
//!
//! A ring that touches the border with one corner and is on the side of `p` elsewhere stays as it is. One that touches
//! it with more corners may be a hole that cuts off a piece between them, so it is joined with the others.

use alloc::vec::Vec;
use core::cmp::Ordering;

use super::corner::cross;
use super::place::Place;
use super::ring_list::{Item, RingList};
use super::view::{Bend, Side, View};
use crate::point::Point;

/// The first or last place of a chain, on the border.
#[derive(Clone, Copy)]
struct Tip {
    place: Place,
    /// The position of the place on the border, rounded.
    near: f64,
    chain: usize,
    is_end: bool,
    /// From the place into the chain.
    direction: [i64; 2],
    /// The item of the ring, if the place is one.
    item: Option<usize>,
}

impl Tip {
    /// Compares two tips by their order just beside the border between `p` and `q`: by their positions and, at one
    /// place, by their directions, of which the one that points back along the border comes first.
    fn compare(&self, other: &Self, p: Point, q: Point) -> Ordering {
        // A rounded position is off by less than its 2^-51st part.
        const MARGIN: f64 = 1.0 / (1u64 << 49) as f64;
        let (ahead, margin) = (self.near - other.near, (self.near.abs() + other.near.abs()) * MARGIN);
        if ahead > margin {
            return Ordering::Greater;
        }
        if ahead < -margin {
            return Ordering::Less;
        }
        let order = self.place.compare_positions(other.place, p, q);
        order.then_with(|| cross(self.direction, other.direction).cmp(&0))
    }
}

/// Consecutive items of one ring whose corners are strictly nearer to `p`.
#[derive(Clone, Copy)]
struct Chain {
    first: usize,
    last: usize,
    /// The first item of the ring, and the one behind its last.
    ring: [usize; 2],
}

impl Chain {
    fn after(&self, k: usize) -> usize {
        if k + 1 == self.ring[1] {
            self.ring[0]
        } else {
            k + 1
        }
    }

    fn before(&self, k: usize) -> usize {
        if k == self.ring[0] {
            self.ring[1] - 1
        } else {
            k - 1
        }
    }
}

/// The lists that cuts reuse.
#[derive(Default)]
pub(super) struct Cutter {
    /// The rings, with items on one side of the border, and the side of each item.
    rings: RingList,
    signs: Vec<Ordering>,
    chains: Vec<Chain>,
    tips: Vec<Tip>,
    /// The chain that follows each chain, and the side of the edge between them.
    next: Vec<(usize, Side)>,
    begins: Vec<Bend>,
    ends: Vec<Place>,
    done: Vec<bool>,
}

impl Cutter {
    /// Appends to `out` what the border with point `q` leaves of some rings.
    pub(super) fn cut(&mut self, rings: &RingList, view: View<'_>, q: u32, out: &mut RingList) {
        self.rings.fill_by_side(rings, view, q, &mut self.signs);
        if !self.signs.contains(&Ordering::Less) {
            out.items.extend_from_slice(&rings.items);
            out.counts.extend_from_slice(&rings.counts);
            return;
        }
        self.chains.clear();
        let mut begin = 0;
        for number in 0..self.rings.counts.len() {
            let length = self.rings.counts[number];
            let ring = [begin, begin + length];
            if self.stays(ring) {
                out.items.extend_from_slice(&self.rings.items[begin..begin + length]);
                out.counts.push(length);
            } else {
                self.find_chains(ring);
            }
            begin += length;
        }
        if self.chains.is_empty() {
            return;
        }
        self.find_tips(view, view.points[q as usize]);
        self.join(q);
        self.collect(out);
    }

    /// Whether a ring has no corner beyond the border, and at most one on it.
    fn stays(&self, [begin, end]: [usize; 2]) -> bool {
        let signs = &self.signs[begin..end];
        !signs.contains(&Ordering::Less) && signs.iter().filter(|sign| sign.is_eq()).count() < 2
    }

    /// Finds the chains of a ring, which has a corner on the border or beyond.
    fn find_chains(&mut self, ring: [usize; 2]) {
        let is_near = |k: usize| self.signs[k] == Ordering::Greater;
        for first in ring[0]..ring[1] {
            let mut chain = Chain { first, last: first, ring };
            if !is_near(first) || is_near(chain.before(first)) {
                continue;
            }
            while is_near(chain.after(chain.last)) {
                chain.last = chain.after(chain.last);
            }
            self.chains.push(chain);
        }
    }

    /// Finds where each chain leaves and reaches the border.
    fn find_tips(&mut self, view: View<'_>, q: Point) {
        self.tips.clear();
        self.begins.clear();
        self.ends.clear();
        let items = &self.rings.items;
        for (number, chain) in self.chains.iter().enumerate() {
            let (outer, beyond) = (chain.before(chain.first), chain.after(chain.last));
            let (side, last) = (items[outer].last_side(), items[chain.last].last_side());
            let on = |k: usize| (self.signs[k] == Ordering::Equal).then_some(k);
            let place = |k: Option<usize>, side: Side| {
                k.map_or_else(|| view.meet(side, q), |k| items[k].first(view.clip).place)
            };
            let (begin, end) = (place(on(outer), side), place(on(beyond), last));
            let tip = |place, is_end, direction, item| Tip { place, near: 0.0, chain: number, is_end, direction, item };
            self.begins.push(Bend { place: begin, side });
            self.ends.push(end);
            self.tips.push(tip(begin, false, view.direction(side), on(outer)));
            self.tips.push(tip(end, true, view.direction(last).map(|length| -length), on(beyond)));
        }
        if self.chains.len() > 1 {
            for tip in &mut self.tips {
                let [numerator, denominator] = tip.place.position(view.p, q);
                tip.near = numerator as f64 / denominator as f64;
            }
            self.tips.sort_unstable_by(|one, other| one.compare(other, view.p, q));
        }
    }

    /// Joins each end with the beginning behind it.
    fn join(&mut self, q: u32) {
        self.next.clear();
        self.next.resize(self.chains.len(), (0, Side::Neighbor(q)));
        if self.chains.len() == 1 {
            self.tips.sort_unstable_by_key(|tip| !tip.is_end);
        }
        for pair in self.tips.windows(2) {
            if pair[0].is_end && !pair[1].is_end {
                self.next[pair[0].chain] = (pair[1].chain, self.side_between(pair[0], pair[1], q));
            }
        }
    }

    /// The line on which the edge between two tips lies. Where a ring itself runs along the border and has its inside
    /// on the side of `p`, the edge stays that of the ring: the inside does not reach the other cell.
    fn side_between(&self, end: Tip, begin: Tip, q: u32) -> Side {
        let (Some(first), Some(last)) = (end.item, begin.item) else { return Side::Neighbor(q) };
        let chain = self.chains[end.chain];
        if chain.ring != self.chains[begin.chain].ring {
            return Side::Neighbor(q);
        }
        let mut k = first;
        while k != last {
            k = chain.after(k);
            if self.signs[k] != Ordering::Equal {
                return Side::Neighbor(q);
            }
        }
        self.rings.items[first].last_side()
    }

    /// Collects the new rings.
    fn collect(&mut self, out: &mut RingList) {
        self.done.clear();
        self.done.resize(self.chains.len(), false);
        for first in 0..self.chains.len() {
            let (mut number, begin) = (first, out.items.len());
            while !self.done[number] {
                self.done[number] = true;
                let chain = self.chains[number];
                out.items.push(Item::One(self.begins[number]));
                let mut k = chain.first;
                out.items.push(self.rings.items[k]);
                while k != chain.last {
                    k = chain.after(k);
                    out.items.push(self.rings.items[k]);
                }
                let (next, side) = self.next[number];
                // An end at the corner at which the next chain begins would make an edge of length zero.
                if self.ends[number] != self.begins[next].place {
                    out.items.push(Item::One(Bend { place: self.ends[number], side }));
                }
                number = next;
            }
            if out.items.len() > begin {
                out.counts.push(out.items.len() - begin);
            }
        }
    }
}
