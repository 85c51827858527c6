//! Divide and conquer on several threads: each thread takes segments of the curve.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::thread::Builder;

use super::conquer::{conquer, level_after, GoOn, Waiting};
use super::edges::{Edges, Half, HALVES};
use super::kernel::Kernel;
use super::merge::Part;
use super::parallel::lock;

/// Segments for each thread: enough for all threads to end at about the same time.
const SEGMENTS: usize = 8;
/// Subtrees of up to this many vertices are not cut further. Smaller segments are not worth a task, and a merge of two
/// single vertices is not allowed: two vertices are an edge from the start.
const LEAST: usize = 64;

/// Triangulates distinct sites, which stand along the curve, on up to `threads` threads. Returns `None` if there are no
/// sites, or if `go_on` ends the work.
///
/// Each segment of the curve is a subtree of the cuts. The calling thread joins the segments, which is little work
/// because their borders are short.
pub(super) fn triangulate<K: Kernel>(
    sites: &[K::Site],
    places: &[K::Place],
    halves: &mut [Half],
    threads: usize,
    go_on: GoOn<'_>,
) -> Option<Part> {
    if threads < 2 {
        return conquer::<K>(sites, places, halves, go_on);
    }
    let mut segments = Vec::new();
    divide::<K>(places, 0..sites.len(), (sites.len() / (SEGMENTS * threads)).max(LEAST), &mut segments);
    let parts = conquer_all::<K>(sites, places, halves, &segments, threads, go_on);
    let mut edges = Edges::<K> { sites, halves };
    let mut waiting = Waiting::new();
    for (segment, part) in segments.iter().zip(parts) {
        waiting.take(&mut edges, part?, level_after::<K>(places, segment.end - 1));
    }
    waiting.whole()
}

/// Cuts a subtree into segments, which are subtrees of up to `most` vertices.
fn divide<K: Kernel>(places: &[K::Place], subtree: Range<usize>, most: usize, segments: &mut Vec<Range<usize>>) {
    let within = &places[subtree.clone()];
    let [first, .., last] = *within else {
        return segments.push(subtree);
    };
    if within.len() <= most {
        return segments.push(subtree);
    }
    let topmost = K::level(first, last);
    let place = subtree.start + within.partition_point(|&place| K::level(first, place) < topmost);
    divide::<K>(places, subtree.start..place, most, segments);
    divide::<K>(places, place..subtree.end, most, segments);
}

/// A segment to be triangulated: its place among all, its vertices and half-edges.
type Task<'a> = (usize, Range<usize>, &'a mut [Half]);

/// Triangulates all segments, each by itself. The calling thread works too, and it alone asks whether to go on.
fn conquer_all<K: Kernel>(
    sites: &[K::Site],
    places: &[K::Place],
    mut halves: &mut [Half],
    segments: &[Range<usize>],
    threads: usize,
    go_on: GoOn<'_>,
) -> Vec<Option<Part>> {
    let mut tasks: Vec<Task<'_>> = Vec::with_capacity(segments.len());
    for (place, segment) in segments.iter().enumerate() {
        let (own, rest) = std::mem::take(&mut halves).split_at_mut(HALVES * segment.len());
        tasks.push((place, segment.clone(), own));
        halves = rest;
    }
    let (tasks, parts) = (Mutex::new(tasks), Mutex::new(vec![None; segments.len()]));
    let work = |go_on: GoOn<'_>| loop {
        let task = lock(&tasks).pop();
        let Some((place, segment, halves)) = task else {
            return;
        };
        let Some(part) = conquer::<K>(&sites[segment.clone()], &places[segment.clone()], halves, go_on) else {
            // An empty list of tasks makes the other threads end as well.
            return lock(&tasks).clear();
        };
        lock(&parts)[place] = Some(part.moved(halves, segment.start as u32));
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
