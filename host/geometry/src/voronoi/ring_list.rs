//! The rings of a cell while it is cut. Corners of the clip that follow one another are one item, so that a clip of
//! many corners is cut without looking at every corner.

use alloc::vec::Vec;
use core::cmp::Ordering;

use super::border::Bisector;
use super::clip::Clip;
use super::place::Place;
use super::view::{Bend, Side, View};

/// A corner of a ring, or a run of corners of the clip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Item {
    One(Bend),
    /// The corners of the clip from a number to before another. Each begins the edge of its number.
    Run([u32; 2]),
}

/// The corner of the clip with this number.
fn corner(clip: &Clip, number: u32) -> Bend {
    Bend { place: Place::Corner(clip.corners()[number as usize]), side: Side::Clip(number) }
}

impl Item {
    /// The first corner.
    pub(super) fn first(self, clip: &Clip) -> Bend {
        match self {
            Self::One(bend) => bend,
            Self::Run([first, _]) => corner(clip, first),
        }
    }

    /// The line on which the edge behind the last corner lies.
    pub(super) fn last_side(self) -> Side {
        match self {
            Self::One(bend) => bend.side,
            Self::Run([_, end]) => Side::Clip(end - 1),
        }
    }
}

/// Rings, one behind the other. A run that is all there is of a ring may also stand for several whole rings of the
/// clip.
#[derive(Default)]
pub(super) struct RingList {
    pub(super) items: Vec<Item>,
    /// The number of items of each ring.
    pub(super) counts: Vec<usize>,
}

impl RingList {
    pub(super) fn clear(&mut self) {
        self.items.clear();
        self.counts.clear();
    }

    /// Fills in the rings of another list, with items that lie on one side of the border with a point, or are one
    /// corner on it, and the side of each.
    pub(super) fn fill_by_side(&mut self, other: &Self, view: View<'_>, q: u32, sides: &mut Vec<Ordering>) {
        self.clear();
        sides.clear();
        let at = view.points[q as usize];
        let line = Bisector::of(view.p, at);
        let mut rest = &other.items[..];
        for &count in &other.counts {
            let (ring, others) = rest.split_at(count);
            rest = others;
            if let &[Item::Run(run)] = ring {
                self.fill_rings(run, view.clip, line, sides);
                continue;
            }
            let begin = self.items.len();
            for &item in ring {
                match item {
                    Item::Run(run) => view.clip.sides(run, line, |run, side| self.push(begin, run, side, sides)),
                    Item::One(bend) => {
                        self.items.push(item);
                        sides.push(bend.place.side(view.p, at));
                    }
                }
            }
            self.counts.push(self.items.len() - begin);
        }
    }

    /// Fills in whole rings of the clip.
    fn fill_rings(&mut self, rings: [u32; 2], clip: &Clip, line: Bisector, sides: &mut Vec<Ordering>) {
        let mut begin = self.items.len();
        clip.sides(rings, line, |run, side| {
            self.push(begin, run, side, sides);
            // A run ends with its ring, or before.
            if clip.rings.ends_ring(run[1]) {
                self.counts.push(self.items.len() - begin);
                begin = self.items.len();
            }
        });
    }

    /// Adds a run of corners to the ring that begins with an item, and joins it with the run before it if both lie on
    /// one side.
    fn push(&mut self, begin: usize, run: [u32; 2], side: Ordering, sides: &mut Vec<Ordering>) {
        let last = self.items[begin..].last_mut();
        match (last, sides.last()) {
            (Some(Item::Run([_, end])), Some(&same)) if *end == run[0] && same == side && side.is_ne() => *end = run[1],
            _ => {
                self.items.push(Item::Run(run));
                sides.push(side);
            }
        }
    }

    /// Appends all corners to a list, and the number of corners of each ring to another.
    pub(super) fn write_out(&self, clip: &Clip, bends: &mut Vec<Bend>, counts: &mut Vec<usize>) {
        let mut rest = &self.items[..];
        for &count in &self.counts {
            let (ring, others) = rest.split_at(count);
            rest = others;
            let begin = bends.len();
            for &item in ring {
                match item {
                    Item::One(bend) => bends.push(bend),
                    Item::Run([first, end]) => bends.extend((first..end).map(|number| corner(clip, number))),
                }
            }
            match ring {
                &[Item::Run(run)] => {
                    let mut from = run[0] as usize;
                    counts
                        .extend(clip.rings.ring_ends(run).iter().map(|&end| end - core::mem::replace(&mut from, end)));
                }
                _ => counts.push(bends.len() - begin),
            }
        }
    }
}
