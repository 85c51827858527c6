//! Divide and conquer along the Z-curve.
//!
//! The points stand in the order of the curve, so every square and half square of the quadtree is a stretch of them.
//! Where two neighbours first differ, in which bit of which coordinate, says which cut separates them: the tree of cuts
//! need not be built, a stack of parts that wait for their other half is enough. Cuts alternate between vertical and
//! horizontal ones, so parts stay compact and the work of all merges is O(n) on even sets; there are at most `2 w` cuts
//! above a point, so it is O(n w) on any.

use alloc::vec::Vec;

use super::edges::{Edges, Half};
use super::merge::{Cut, Part};
use super::view::{Site, Width};

/// Most parts that wait at a time: one for each bit of both coordinates, and the one that comes.
const DEPTH: usize = 64;
/// Above all cuts.
const TOP: u32 = u32::MAX;
/// Vertices between two looks at the clock.
const SLICE: usize = 1 << 15;

/// The height in the tree of the cut between two neighbours: each bit of x, then of y, from the lowest on; odd for x.
#[inline(always)]
pub(super) fn level(one: Site, other: Site) -> u32 {
    let bits = |one: i32, other: i32| u32::BITS - ((one ^ other) as u32).leading_zeros();
    (2 * bits(one.x, other.x) + 1).max(2 * bits(one.y, other.y))
}

/// The level of the cut after vertex `v`.
#[inline(always)]
pub(super) fn level_after(sites: &[Site], v: usize) -> u32 {
    sites.get(v..v + 2).map_or(TOP, |pair| level(pair[0], pair[1]))
}

/// Whether the work goes on, asked from time to time with the number of vertices done since the last time.
pub(super) type GoOn<'a> = &'a mut dyn FnMut(usize) -> bool;

/// Parts that wait for their other halves, each with the level of the cut after it. Levels fall towards the end.
pub(super) struct Waiting(Vec<(Part, u32)>);

impl Waiting {
    pub(super) fn new() -> Self {
        Self(Vec::with_capacity(DEPTH))
    }

    /// Takes the next part, and joins what is below the cut after it.
    #[inline(always)]
    pub(super) fn take<W: Width>(&mut self, edges: &mut Edges<'_>, mut part: Part, above: u32) {
        while let Some((one, between)) = self.0.pop_if(|(_, between)| *between < above) {
            let cut = if between & 1 == 1 { Cut::Vertical } else { Cut::Horizontal };
            part = edges.merge::<W>(one, part, cut);
        }
        self.0.push((part, above));
    }

    /// The part of all, after the last one.
    pub(super) fn whole(mut self) -> Option<Part> {
        self.0.pop().map(|(part, _)| part)
    }
}

/// Triangulates the distinct sites of a subtree, which stand along the curve, on this thread. `None` if there are none,
/// or if the work shall not go on.
pub(super) fn conquer<W: Width>(sites: &[Site], halves: &mut [Half], go_on: GoOn<'_>) -> Option<Part> {
    let mut edges = Edges { sites, halves };
    let mut waiting = Waiting::new();
    let (mut v, mut asked) = (0, 0);
    // The levels of the cut before vertex `v`, and of those after it, after the next and the one after that.
    let mut before = TOP;
    let mut after = [0, 1, 2].map(|ahead| level_after(sites, ahead));
    while v < sites.len() {
        let (part, count) = edges.leaf(v as u32, before, after);
        before = after[count - 1];
        for _ in 0..count {
            v += 1;
            after = [after[1], after[2], level_after(sites, v + 2)];
        }
        waiting.take::<W>(&mut edges, part, before);
        if v - asked >= SLICE {
            if !go_on(v - asked) {
                return None;
            }
            asked = v;
        }
    }
    (go_on(v - asked)).then(|| waiting.whole()).flatten()
}

impl Edges<'_> {
    /// The largest square or half square that begins with vertex `v` and has up to three vertices, and how many: given
    /// the cuts around them. Three on a line are left to merges.
    #[inline(always)]
    fn leaf(&mut self, v: u32, before: u32, after: [u32; 3]) -> (Part, usize) {
        if after[0].max(after[1]) < before.min(after[2]) {
            if let Some(part) = self.triangle(v) {
                return (part, 3);
            }
        }
        if after[0] < before.min(after[1]) {
            return (self.edge(v), 2);
        }
        (self.vertex(v), 1)
    }
}
