//! Divide and conquer along the Z-curve.
//!
//! The points stand in the order of the curve, so every square and half square of the quadtree is a range of them. The
//! highest bit in which two neighbours differ, of x or of y, says which cut separates them. So the tree of cuts need
//! not be built: a stack of parts that wait for their other half is enough. Cuts alternate between vertical and
//! horizontal ones, so parts stay compact and the work of all merges is O(n) on even sets. With coordinates of `w` bits
//! there are at most `2 w` cuts above a point, so the work is O(n w) on any set.

use alloc::vec::Vec;

use super::edges::{Edges, Half};
use super::kernel::Kernel;
use super::merge::{Cut, Part};

/// Most parts that wait at a time: one for each bit of both coordinates, and the new one.
const DEPTH: usize = 64;
/// A level above all cuts, for both ends of the curve.
const TOP: u32 = u32::MAX;
/// Vertices between two questions whether the work goes on.
const SLICE: usize = 1 << 15;

/// The level of the cut after vertex `v`.
#[inline(always)]
pub(super) fn level_after<K: Kernel>(places: &[K::Place], v: usize) -> u32 {
    places.get(v..v + 2).map_or(TOP, |pair| K::level(pair[0], pair[1]))
}

/// A function that says whether the work goes on. Called from time to time with the number of vertices done
/// since the previous call.
pub(super) type GoOn<'a> = &'a mut dyn FnMut(usize) -> bool;

/// The stack of parts that wait for their other halves, each with the level of the cut after it. Levels fall towards
/// the top of the stack.
pub(super) struct Waiting(Vec<(Part, u32)>);

impl Waiting {
    pub(super) fn new() -> Self {
        Self(Vec::with_capacity(DEPTH))
    }

    /// Pushes the next part, after joining it with all waiting parts that lie below the cut `above`, which follows it.
    #[inline(always)]
    pub(super) fn take<K: Kernel>(&mut self, edges: &mut Edges<'_, K>, mut part: Part, above: u32) {
        while let Some((one, between)) = self.0.pop_if(|(_, between)| *between < above) {
            let cut = if between & 1 == 1 { Cut::Vertical } else { Cut::Horizontal };
            part = edges.merge(one, part, cut);
        }
        self.0.push((part, above));
    }

    /// The part of all vertices, once the last part has been pushed.
    pub(super) fn whole(mut self) -> Option<Part> {
        self.0.pop().map(|(part, _)| part)
    }
}

/// Triangulates the distinct sites of a subtree, which stand along the curve, on this thread, given the place of each
/// in the tree of cuts. Returns `None` if there are no sites, or if `go_on` ends the work.
pub(super) fn conquer<K: Kernel>(
    sites: &[K::Site],
    places: &[K::Place],
    halves: &mut [Half],
    go_on: GoOn<'_>,
) -> Option<Part> {
    let mut edges = Edges::<K> { sites, halves };
    let mut waiting = Waiting::new();
    let (mut v, mut asked) = (0, 0);
    // `before` is the level of the cut before vertex `v`; `after` has the levels of the cuts after `v`, `v + 1`
    // and `v + 2`.
    let mut before = TOP;
    let mut after = [0, 1, 2].map(|ahead| level_after::<K>(places, ahead));
    while v < sites.len() {
        let (part, count) = edges.leaf(v as u32, before, after);
        before = after[count - 1];
        for _ in 0..count {
            v += 1;
            after = [after[1], after[2], level_after::<K>(places, v + 2)];
        }
        waiting.take(&mut edges, part, before);
        if v - asked >= SLICE {
            if !go_on(v - asked) {
                return None;
            }
            asked = v;
        }
    }
    (go_on(v - asked)).then(|| waiting.whole()).flatten()
}

impl<K: Kernel> Edges<'_, K> {
    /// Triangulates the largest square or half square that begins with vertex `v` and has up to three vertices, and
    /// counts these, given the levels of the cuts around them. Three vertices on a line are left to merges.
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
