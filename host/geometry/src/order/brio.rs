//! BRIO, the biased randomized insertion order: rounds of growing random samples, each along the Hilbert curve.
//!
//! Sources: Amenta, Choi, Rote, *Incremental constructions con BRIO*, 2003; Buchin, *Constructing Delaunay
//! triangulations along space-filling curves*, 2009.

use alloc::vec;
use alloc::vec::Vec;

use super::hilbert::{along_curve, Hilbert};
use super::keys::mix;
use crate::point::Point;
use crate::predicate::orient2d;
use crate::sort::Entry;

/// Approximate least number of points of the first round. The contexts of a device share the work only from the
/// protocol's own first round on, which is another constant.
const LEAST_ROUND: usize = 16;
/// The share α = 1/4 as a power of two: a quarter of the points come before the last round.
const SHARE: u32 = 2;

/// The biased randomized insertion order of α = 1/4 along a Hilbert curve, as a permutation of `0..points.len()`.
///
/// The last round takes three quarters of the points, the round before it three quarters of the rest, down to about 16
/// points. Each round runs along the Hilbert curve of the grid. The round of a point follows from a hash of its
/// coordinates: the same set always gives the same order, however the input was arranged. Equal points stay together,
/// in input order. O(n), about 20 ns per point; twice that where a coordinate has more than 16 bits.
pub fn brio_hilbert(points: &[Point]) -> Vec<u32> {
    rounds(&along_curve(points)).order
}

/// The points of a set, divided into the rounds of BRIO.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rounds {
    /// The indices of the points, first round first.
    pub order: Vec<u32>,
    /// The place in `order` at which each round begins; the first begins at 0.
    pub starts: Vec<usize>,
}

impl Rounds {
    /// Makes one round of all points in this order.
    pub fn single(order: Vec<u32>) -> Self {
        Self { order, starts: vec![0] }
    }

    /// Moves the first point that is not on one line with the first two to the third place, so that the first three
    /// span a triangle; all others keep their order and their round. Returns the place that the point came from, or
    /// `None` if there is no such point. O(n) at worst.
    pub fn start_with_a_triangle(&mut self, points: &[Point]) -> Option<usize> {
        let at = |index: u32| points[index as usize];
        let [first, second, rest @ ..] = &self.order[..] else {
            return None;
        };
        let (a, b) = (at(*first), at(*second));
        let found = 2 + rest.iter().position(|&index| orient2d(a, b, at(index)) != 0)?;
        self.order[2..=found].rotate_right(1);
        // The points that stood before the found one moved up by a place, and so did the rounds that began there.
        for start in self.starts.iter_mut().filter(|start| (2..=found).contains(*start)) {
            *start += 1;
        }
        Some(found)
    }
}

/// Sorts points that stand along the curve into the rounds of α = 2^-`shift`: each point reaches the rounds before the
/// last with probability α, by a hash of its coordinates. `shift` must be at least 1. O(n).
pub fn rounds_of_share(curve: &Hilbert, shift: u32) -> Rounds {
    match curve {
        Hilbert::Narrow(entries) => sort_into_rounds(entries, shift.max(1)),
        Hilbert::Wide(entries) => sort_into_rounds(entries, shift.max(1)),
    }
}

/// Sorts points that stand along the curve into the rounds of α = 1/4. O(n).
pub fn rounds(curve: &Hilbert) -> Rounds {
    rounds_of_share(curve, SHARE)
}

/// Sorts entries by their round, first round first, by counting; the order of the curve stays inside a round.
fn sort_into_rounds<E: Entry>(entries: &[E], shift: u32) -> Rounds {
    let level = |key: u64, last: usize| level(key, last, shift);
    let last = last_level(entries.len(), shift);
    let mut starts = [0usize; LEVELS];
    for entry in entries {
        starts[level(entry.key(), last)] += 1;
    }
    let mut sum = 0;
    for start in starts.iter_mut().rev() {
        sum += core::mem::replace(start, sum);
    }
    let mut order = vec![0; entries.len()];
    for entry in entries {
        let slot = &mut starts[level(entry.key(), last)];
        order[*slot] = entry.value();
        *slot += 1;
    }
    // After the loop each slot holds the end of its level, where the next round begins.
    let mut rounds = vec![0];
    rounds.extend((1..=last).rev().map(|level| starts[level]));
    Rounds { order, starts: rounds }
}

/// The most levels there can be: 0 to 64 trailing zeros of a 64-bit hash.
const LEVELS: usize = u64::BITS as usize + 1;

/// The number of rounds of `points` points, less one.
fn last_level(points: usize, shift: u32) -> usize {
    let mut level = 0;
    let mut sample = points >> shift;
    while sample >= LEAST_ROUND {
        level += 1;
        sample >>= shift;
    }
    level
}

/// The level of a point: 0 is the last round, and one point in 2^`shift` reaches the next level.
fn level(key: u64, last: usize, shift: u32) -> usize {
    ((mix(key).trailing_zeros() / shift) as usize).min(last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::order::hilbert;
    use proptest::prelude::*;

    fn lattice(side: u32, step: u32) -> Vec<Point> {
        (0..side * side).map(|k| Point::new(k / side * step, k % side * step)).collect()
    }

    #[test]
    fn a_quarter_of_a_lattice_comes_before_the_last_round() {
        let points = lattice(64, 1000);
        let curve = along_curve(&points);
        let Hilbert::Narrow(entries) = &curve else {
            panic!("16-bit points take the narrow form");
        };
        let last = last_level(points.len(), 2);
        assert_eq!(last, 4);
        let early = entries.iter().filter(|e| level(crate::sort::Keyed::key(*e), last, 2) > 0).count();
        assert!((900..1150).contains(&early), "{early} of 4096 before the last round");
    }

    #[test]
    fn the_order_follows_from_the_set_alone() {
        let points = lattice(40, 7);
        let mut reversed = points.clone();
        reversed.reverse();
        let in_order =
            |points: &[Point]| -> Vec<Point> { brio_hilbert(points).iter().map(|&i| points[i as usize]).collect() };
        assert_eq!(in_order(&points), in_order(&reversed));
    }

    #[test]
    fn rounds_keep_their_points_when_the_third_is_found() {
        // Points 0 to 4 lie on a line; the rounds begin at points 0, 2, 4, 6.
        let line = [(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (5, 0), (6, 6), (7, 7)].map(Point::from);
        let mut rounds = Rounds { order: (0..8).collect(), starts: vec![0, 2, 4, 6] };
        assert_eq!(rounds.start_with_a_triangle(&line), Some(5));
        assert_eq!(rounds.order, [0, 1, 5, 2, 3, 4, 6, 7]);
        assert_eq!(rounds.starts, [0, 3, 5, 6]);
        let mut rounds = Rounds { order: vec![0, 1, 2, 5], starts: vec![0, 1, 3] };
        assert_eq!(rounds.start_with_a_triangle(&line), Some(3));
        assert_eq!((rounds.order, rounds.starts), (vec![0, 1, 5, 2], vec![0, 1, 4]));
        for order in [vec![], vec![1], vec![1, 2], vec![4, 0, 2, 1]] {
            let mut rounds = Rounds::single(order.clone());
            assert_eq!(rounds.start_with_a_triangle(&line), None);
            assert_eq!(rounds, Rounds::single(order));
        }
    }

    proptest! {
        #[test]
        fn both_orders_are_permutations(
            raw in prop::collection::vec((any::<u32>(), any::<u32>()), 0..1500),
            bits in 1u32..32,
        ) {
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(x >> (32 - bits), y >> (32 - bits))).collect();
            for order in [brio_hilbert(&points), hilbert(&points)] {
                let mut sorted = order;
                sorted.sort_unstable();
                prop_assert!(sorted.iter().copied().eq(0..points.len() as u32));
            }
        }

        #[test]
        fn neighbours_in_the_last_round_are_near(seed in any::<u64>()) {
            let points: Vec<Point> = (0..4096u64)
                .map(|k| mix(seed ^ k << 40))
                .map(|h| Point::new(h as u32 & 0xffff, (h >> 32) as u32 & 0xffff))
                .collect();
            let order = brio_hilbert(&points);
            let step = |pair: &[u32]| {
                let (a, b) = (points[pair[0] as usize], points[pair[1] as usize]);
                u64::from(a.x.abs_diff(b.x) + a.y.abs_diff(b.y))
            };
            let sum: u64 = order[2048..].windows(2).map(step).sum();
            prop_assert!(sum / 2047 < 3000, "mean step {}", sum / 2047);
        }
    }
}
