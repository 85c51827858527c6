//! From the subdivision to the canonical mesh.
//!
//! The list is sorted by smallest corner, then by the second one. So each vertex, in the order of the curve, finds the triangles whose
//! smallest corner it is by going round itself, and sorts those few; then they are copied to their places.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::edges::Half;
use crate::pages;

/// Marks the end of the half-edge after which, counter-clockwise, its vertex sees the outside.
const GAP: u32 = 1 << 31;

/// The hull, counter-clockwise from its lowest id on; marks its half-edges.
pub(super) fn hull(halves: &mut [Half], ids: &[u32], start: u32) -> Vec<u32> {
    let mut hull = Vec::new();
    let mut e = start;
    loop {
        // The outside lies to the right of `e`, and so clockwise of it at its origin.
        let Half { previous, end, .. } = halves[e as usize];
        halves[previous as usize].end |= GAP;
        hull.push(ids[(end & !GAP) as usize]);
        e = halves[(e ^ 1) as usize].next;
        if e == start {
            break;
        }
    }
    let lowest = (0..hull.len()).min_by_key(|&place| hull[place]).unwrap_or(0);
    hull.rotate_left(lowest);
    hull
}

/// All `count` triangles of the mesh of `points` input points, smallest id first in each, sorted.
pub(super) fn triangles(halves: &[Half], ids: &[u32], points: usize, count: usize, threads: usize) -> Vec<[u32; 3]> {
    let first = zeros(ids.len());
    let starts = zeros(points);
    let chunk = ids.len().div_ceil(threads).max(1);
    in_parallel(halves.chunks(6 * chunk).enumerate(), |(place, halves)| {
        note_first(halves, (6 * chunk * place) as u32, &first);
    });
    let stars = in_parallel(ids.chunks(chunk).zip(first.chunks(chunk)), |(own, first)| {
        let stars = Stars::of(halves, ids, own, first);
        stars.count_at(&starts);
        stars
    });
    drop(first);
    let mut starts: Vec<u32> = starts.into_iter().map(AtomicU32::into_inner).collect();
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    let mut triangles = pages::zeros(count);
    in_parallel(split(&mut triangles, &starts, threads).into_iter(), |(own, first)| {
        stars.iter().for_each(|stars| stars.write(&starts, own, first));
    });
    triangles
}

fn zeros(count: usize) -> Vec<AtomicU32> {
    let mut list = pages::with_room(count);
    list.resize_with(count, || AtomicU32::new(0));
    list
}

/// The results of all items, in their order, each worked out on a thread of its own; a single one on this.
fn in_parallel<T: Send, R: Send>(items: impl ExactSizeIterator<Item = T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    if items.len() < 2 {
        return items.map(work).collect();
    }
    std::thread::scope(|scope| {
        let workers: Vec<_> = items.map(|item| scope.spawn(|| work(item))).collect();
        workers
            .into_iter()
            .map(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    })
}

/// Notes a half-edge that leaves each vertex: any will do. The half-edges are a stretch that begins with number `start`.
fn note_first(halves: &[Half], start: u32, first: &[AtomicU32]) {
    for (e, pair) in (start..).step_by(2).zip(halves.chunks_exact(2)) {
        if pair[0].is_used() {
            first[(pair[1].end & !GAP) as usize].store(e, Relaxed);
            first[(pair[0].end & !GAP) as usize].store(e + 1, Relaxed);
        }
    }
}

/// The triangles of a stretch of vertices.
struct Stars<'a> {
    /// Input indices of the vertices.
    ids: &'a [u32],
    /// The two larger ids of each triangle, in one word, vertex by vertex.
    pairs: Vec<u64>,
    /// Where each vertex's triangles end.
    ends: Vec<u32>,
}

impl<'a> Stars<'a> {
    fn of(halves: &[Half], all: &[u32], ids: &'a [u32], first: &[AtomicU32]) -> Self {
        let mut stars = Self { ids, pairs: pages::zeros(2 * ids.len() + 64), ends: pages::with_room(ids.len()) };
        let mut end = 0;
        for (&id, first) in ids.iter().zip(first) {
            end = stars.go_round(halves, all, id, first.load(Relaxed), end);
            stars.ends.push(end as u32);
        }
        stars
    }

    /// Writes the triangles around vertex `id` whose smallest id is its own from place `end` on; returns where they end.
    #[inline(always)]
    fn go_round(&mut self, halves: &[Half], all: &[u32], id: u32, start: u32, end: usize) -> usize {
        let mut at = end;
        let Half { next: mut e, end: mut seen, .. } = halves[start as usize];
        let mut before = all[(seen & !GAP) as usize];
        loop {
            let half = halves[e as usize];
            let after = all[(half.end & !GAP) as usize];
            if at == self.pairs.len() {
                self.pairs.resize(2 * at, 0);
            }
            // Written in any case and kept in some: no processor predicts which.
            self.pairs[at] = u64::from(before) << 32 | u64::from(after);
            at += usize::from((seen < GAP) & (id < before) & (id < after));
            (seen, before) = (half.end, after);
            if e == start {
                break;
            }
            e = half.next;
        }
        sort_few(&mut self.pairs[end..at]);
        at
    }

    /// Each vertex's id with its triangles.
    fn stretches(&self) -> impl Iterator<Item = (usize, &[u64])> {
        let ends = self.ids.iter().zip(&self.ends);
        ends.scan(0, |start, (&id, &end)| {
            let start = std::mem::replace(start, end as usize);
            Some((id as usize, &self.pairs[start..end as usize]))
        })
    }

    fn count_at(&self, counts: &[AtomicU32]) {
        for (id, pairs) in self.stretches() {
            counts[id].store(pairs.len() as u32, Relaxed);
        }
    }

    /// Writes those triangles that belong into `own`, a stretch of the list that begins with place `first`.
    fn write(&self, starts: &[u32], own: &mut [[u32; 3]], first: usize) {
        for (id, pairs) in self.stretches() {
            let place = (starts[id] as usize).wrapping_sub(first);
            if let Some(slots) = own.get_mut(place..place.wrapping_add(pairs.len())) {
                for (slot, &pair) in slots.iter_mut().zip(pairs) {
                    *slot = [id as u32, (pair >> 32) as u32, pair as u32];
                }
            }
        }
    }
}

/// Sorts a few words. Up to four without branches on them.
#[inline(always)]
fn sort_few(words: &mut [u64]) {
    let order = |a: &mut u64, b: &mut u64| (*a, *b) = ((*a).min(*b), (*a).max(*b));
    match words {
        [] | [_] => {}
        [a, b] => order(a, b),
        [a, b, c] => {
            order(a, b);
            order(b, c);
            order(a, b);
        }
        [a, b, c, d] => {
            order(a, b);
            order(c, d);
            order(a, c);
            order(b, d);
            order(b, c);
        }
        more => more.sort_unstable(),
    }
}

/// The list in stretches, each with its first place; a vertex's triangles are all in one.
fn split<'a>(triangles: &'a mut [[u32; 3]], starts: &[u32], count: usize) -> Vec<(&'a mut [[u32; 3]], usize)> {
    let mut stretches = Vec::with_capacity(count);
    let (mut rest, mut first) = (triangles, 0);
    for k in 1..count {
        let place = starts.get(k * starts.len() / count).map_or(first, |&start| start as usize);
        let (own, after) = rest.split_at_mut(place - first);
        stretches.push((own, first));
        (rest, first) = (after, place);
    }
    stretches.push((rest, first));
    stretches
}
