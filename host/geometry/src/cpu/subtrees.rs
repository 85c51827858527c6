//! Subtrees of the cuts, which are triangulated one by one and then joined.

use alloc::vec::Vec;
use core::ops::Range;

use super::conquer::{level_after, Waiting};
use super::edges::{Edges, Halves, HALVES};
use super::kernel::Kernel;
use super::merge::Part;

/// The part of a subtree, and its first unused pair, both numbered from the start of all half-edges.
pub(super) type Own = (Part, u32);

/// Cuts a subtree into smaller ones of up to `most` vertices.
pub(super) fn divide<K: Kernel>(
    places: &[K::Place],
    subtree: Range<usize>,
    most: usize,
    subtrees: &mut Vec<Range<usize>>,
) {
    let within = &places[subtree.clone()];
    let [first, .., last] = *within else {
        return subtrees.push(subtree);
    };
    if within.len() <= most {
        return subtrees.push(subtree);
    }
    let topmost = K::level(first, last);
    let place = subtree.start + within.partition_point(|&place| K::level(first, place) < topmost);
    divide::<K>(places, subtree.start..place, most, subtrees);
    divide::<K>(places, place..subtree.end, most, subtrees);
}

/// Joins all subtrees, given in order with their parts. Returns `None` if there are none, or if a part is missing.
pub(super) fn join<K: Kernel, H: Halves + ?Sized>(
    edges: &mut Edges<'_, K, H>,
    places: &[K::Place],
    subtrees: &[Range<usize>],
    parts: &[Option<Own>],
    waiting: &mut Waiting,
) -> Option<Part> {
    // The list of the unused pairs of each subtree ends with the last pair of its range, which is never used, because a
    // subtree of n vertices has fewer than 3 n edges. There the list of the next subtree is tied on.
    for (subtree, own) in subtrees.iter().zip(parts).rev() {
        let end = (HALVES * subtree.end) as u32;
        edges.halves.set_next(end - 2, edges.unused.wrapping_sub(end));
        edges.unused = own.map_or(0, |(_, unused)| unused);
    }
    for (subtree, own) in subtrees.iter().zip(parts) {
        waiting.take(edges, (*own)?.0, level_after::<K>(places, subtree.end - 1));
    }
    waiting.whole()
}
