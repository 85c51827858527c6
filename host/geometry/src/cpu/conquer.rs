//! Divide and conquer along the Z-curve.
//!
//! The points stand in the order of the curve, so every square and half square of the quadtree is a stretch of them. Where two neighbours
//! first differ, in which bit of which coordinate, says which cut separates them: the tree of cuts need not be built, a stack of parts
//! that wait for their other half is enough. Cuts alternate between vertical and horizontal ones, so parts stay compact and the
//! work of all merges is O(n) on even sets; there are at most `2 w` cuts above a point, so it is O(n w) on any.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::thread::Builder;

use super::edges::{Edges, Half, HALVES};
use super::merge::{Cut, Part};
use super::parallel::lock;
use super::view::{Site, Width};

/// Most parts that wait at a time: one for each bit of both coordinates, and the one that comes.
const DEPTH: usize = 64;
/// Above all cuts.
const TOP: u32 = u32::MAX;
/// Stretches for each thread: enough that all are done at about the same time.
const STRETCHES: usize = 8;
/// Least vertices of a subtree that is cut further. Fewer are not worth it, and a single vertex must never meet another: two are an edge from the start.
const LEAST: usize = 64;
/// Vertices between two looks at the clock.
const SLICE: usize = 1 << 15;

/// How far up the tree the cut between two neighbours is: each bit of x, then of y, from the lowest on; odd for x.
#[inline(always)]
fn level(one: Site, other: Site) -> u32 {
    let bits = |one: i32, other: i32| u32::BITS - ((one ^ other) as u32).leading_zeros();
    (2 * bits(one.x, other.x) + 1).max(2 * bits(one.y, other.y))
}

/// The level of the cut after vertex `v`.
#[inline(always)]
fn level_after(sites: &[Site], v: usize) -> u32 {
    sites.get(v..v + 2).map_or(TOP, |pair| level(pair[0], pair[1]))
}

/// Whether the work goes on, asked from time to time with the number of vertices done since the last time.
pub(super) type GoOn<'a> = &'a mut dyn FnMut(usize) -> bool;

/// Parts that wait for their other halves, each with the level of the cut after it. Levels fall towards the end.
struct Waiting(Vec<(Part, u32)>);

impl Waiting {
    fn new() -> Self {
        Self(Vec::with_capacity(DEPTH))
    }

    /// Takes the next part, and joins what is below the cut after it.
    #[inline(always)]
    fn take<W: Width>(&mut self, edges: &mut Edges<'_>, mut part: Part, above: u32) {
        while let Some((one, between)) = self.0.pop_if(|(_, between)| *between < above) {
            let cut = if between & 1 == 1 { Cut::Vertical } else { Cut::Horizontal };
            part = edges.merge::<W>(one, part, cut);
        }
        self.0.push((part, above));
    }

    /// The part of all, after the last one.
    fn whole(mut self) -> Option<Part> {
        self.0.pop().map(|(part, _)| part)
    }
}

/// Triangulates distinct sites, which stand along the curve, on so many threads. `None` if there are none, or if it shall not go on.
///
/// Threads work on stretches of the curve, which are subtrees; joining those is little work, since borders are short.
pub(super) fn triangulate<W: Width>(
    sites: &[Site],
    halves: &mut [Half],
    threads: usize,
    go_on: GoOn<'_>,
) -> Option<Part> {
    if threads < 2 {
        return conquer::<W>(sites, halves, go_on);
    }
    let mut stretches = Vec::new();
    divide(sites, 0..sites.len(), (sites.len() / (STRETCHES * threads)).max(LEAST), &mut stretches);
    let parts = conquer_all::<W>(sites, halves, &stretches, threads, go_on);
    let mut edges = Edges { sites, halves };
    let mut waiting = Waiting::new();
    for (stretch, part) in stretches.iter().zip(parts) {
        waiting.take::<W>(&mut edges, part?, level_after(sites, stretch.end - 1));
    }
    waiting.whole()
}

/// Cuts a subtree into subtrees of up to `most` vertices.
fn divide(sites: &[Site], subtree: Range<usize>, most: usize, stretches: &mut Vec<Range<usize>>) {
    let within = &sites[subtree.clone()];
    let [first, .., last] = *within else {
        return stretches.push(subtree);
    };
    if within.len() <= most {
        return stretches.push(subtree);
    }
    let topmost = level(first, last);
    let place = subtree.start + within.partition_point(|&site| level(first, site) < topmost);
    divide(sites, subtree.start..place, most, stretches);
    divide(sites, place..subtree.end, most, stretches);
}

/// A stretch to be done: its place among all, its first vertex, its sites and half-edges.
type Task<'a> = (usize, usize, &'a [Site], &'a mut [Half]);

/// Triangulates all stretches, each for itself. This thread works too, and is the one that asks whether to go on.
fn conquer_all<W: Width>(
    sites: &[Site],
    mut halves: &mut [Half],
    stretches: &[Range<usize>],
    threads: usize,
    go_on: GoOn<'_>,
) -> Vec<Option<Part>> {
    let mut tasks: Vec<Task<'_>> = Vec::with_capacity(stretches.len());
    for (place, stretch) in stretches.iter().enumerate() {
        let (own, rest) = std::mem::take(&mut halves).split_at_mut(HALVES * stretch.len());
        tasks.push((place, stretch.start, &sites[stretch.clone()], own));
        halves = rest;
    }
    let (tasks, parts) = (Mutex::new(tasks), Mutex::new(vec![None; stretches.len()]));
    let work = |go_on: GoOn<'_>| loop {
        let task = lock(&tasks).pop();
        let Some((place, first, sites, halves)) = task else {
            return;
        };
        let Some(part) = conquer::<W>(sites, halves, go_on) else {
            // The others find nothing more to do.
            return lock(&tasks).clear();
        };
        lock(&parts)[place] = Some(part.moved(halves, first as u32));
    };
    std::thread::scope(|scope| {
        for _ in 1..threads {
            // What threads cannot be had for the others do.
            if Builder::new().spawn_scoped(scope, || work(&mut |_| true)).is_err() {
                break;
            }
        }
        work(go_on);
    });
    parts.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// Triangulates a subtree on this thread.
fn conquer<W: Width>(sites: &[Site], halves: &mut [Half], go_on: GoOn<'_>) -> Option<Part> {
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
    /// The largest square or half square that begins with vertex `v` and has up to three vertices, and how many: given the cuts around
    /// them. Three on a line are left to merges.
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
