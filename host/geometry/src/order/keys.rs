//! Keys of points, and the sort by a key.

use alloc::vec::Vec;

use crate::point::Point;
use crate::sort::{sort_by_key, Entry, Wide};

/// The indices of the points, sorted by a key of each point. Points of equal keys stay in input order. O(n).
pub fn by_key(points: &[Point], key: impl Fn(Point) -> u64) -> Vec<u32> {
    let mut entries: Vec<Wide> =
        points.iter().zip(0..=u32::MAX).map(|(&point, index)| Wide::new(key(point), index)).collect();
    sort_by_key(&mut entries);
    entries.iter().map(Entry::value).collect()
}

/// A fixed hash of a number, for random decisions that follow from the input alone: the output function of the
/// SplitMix64 generator (Steele, Lea, Flood 2014) at the state `key` steps from 0.
pub fn mix(key: u64) -> u64 {
    let z = key.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}
