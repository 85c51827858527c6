//! Divide and conquer on several threads.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::thread::Builder;

use super::conquer::{conquer, level, level_after, GoOn, Waiting};
use super::edges::{Edges, Half, HALVES};
use super::merge::Part;
use super::parallel::lock;
use super::view::{Site, Width};

/// Stretches for each thread: enough that all are done at about the same time.
const STRETCHES: usize = 8;
/// Least vertices of a subtree that is cut further. Fewer are not worth it, and a single vertex must never meet
/// another: two are an edge from the start.
const LEAST: usize = 64;

/// Triangulates distinct sites, which stand along the curve, on so many threads. `None` if there are none, or if it
/// shall not go on.
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
            // If the system will not start a thread, the threads that did start share its work.
            if Builder::new().spawn_scoped(scope, || work(&mut |_| true)).is_err() {
                break;
            }
        }
        work(go_on);
    });
    parts.into_inner().unwrap_or_else(PoisonError::into_inner)
}
