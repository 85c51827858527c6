//! Divide and conquer on several threads: each thread takes segments of the curve.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::thread::Builder;

use super::conquer::{conquer, GoOn, Waiting};
use super::edges::{Edges, Half, HALVES};
use super::kernel::Kernel;
use super::merge::Part;
use super::parallel::lock;
use super::short::{self, ShortHalves};
use super::subtrees::{divide, join, Own};

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
    if threads < 2 && sites.len() <= short::MOST {
        return conquer(&mut Edges::<K, _> { sites, halves, unused: 0 }, places, &mut Waiting::new(), go_on);
    }
    let most = if threads < 2 { short::MOST } else { (sites.len() / (SEGMENTS * threads)).clamp(LEAST, short::MOST) };
    let mut segments = Vec::new();
    divide::<K>(places, 0..sites.len(), most, &mut segments);
    let parts = conquer_all::<K>(sites, places, halves, &segments, threads, go_on);
    let mut edges = Edges::<K, _> { sites, halves, unused: 0 };
    join(&mut edges, places, &segments, &parts, &mut Waiting::new())
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
) -> Vec<Option<Own>> {
    let mut tasks: Vec<Task<'_>> = Vec::with_capacity(segments.len());
    for (place, segment) in segments.iter().enumerate() {
        let (own, rest) = std::mem::take(&mut halves).split_at_mut(HALVES * segment.len());
        tasks.push((place, segment.clone(), own));
        halves = rest;
    }
    let (tasks, parts) = (Mutex::new(tasks), Mutex::new(vec![None; segments.len()]));
    let work = |go_on: GoOn<'_>| {
        let (mut short, mut waiting) = (ShortHalves::new(), Waiting::new());
        loop {
            let task = lock(&tasks).pop();
            let Some((place, segment, halves)) = task else {
                return;
            };
            let own = short.conquer_range::<K>(segment, (sites, places), halves, &mut waiting, go_on);
            if own.is_none() {
                // An empty list of tasks makes the other threads end as well.
                return lock(&tasks).clear();
            }
            lock(&parts)[place] = own;
        }
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
