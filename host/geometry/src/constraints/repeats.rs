//! Constraints with the same ends, of which only the first is forced.

use alloc::vec;
use alloc::vec::Vec;

use crate::sort::{sort_by_key, Entry, Keyed, Wide};

/// The constraints in the order of their ends, so that those with the same ends, in either direction, stand together in
/// rising order. The key is the smaller end above the larger one.
pub(crate) fn by_ends(ends: &[[u32; 2]]) -> Vec<Wide> {
    let entry = |(constraint, &[a, b]): (u32, &[u32; 2])| {
        Wide::new(u64::from(a.min(b)) << 32 | u64::from(a.max(b)), constraint)
    };
    let mut order: Vec<Wide> = (0..).zip(ends).map(entry).collect();
    sort_by_key(&mut order);
    order
}

/// The constraints that repeat an earlier one: both have the same ends, in either direction. Only the first of them is
/// forced, so many equal constraints along many points are counted before their pieces are listed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Repeats {
    /// The first constraint with the same ends, and the number of the repeat, in rising order.
    pairs: Vec<[u32; 2]>,
}

impl Repeats {
    /// Finds the repeats among constraints in the order of [`by_ends`].
    pub(crate) fn in_order(order: &[Wide]) -> Self {
        let mut pairs = Vec::new();
        for equal in order.chunk_by(|one, other| one.key() == other.key()) {
            pairs.extend(equal[1..].iter().map(|repeat| [equal[0].value(), repeat.value()]));
        }
        pairs.sort_unstable();
        Self { pairs }
    }

    /// The repeats of a constraint, each behind the number of the constraint.
    pub(crate) fn of(&self, constraint: u32) -> &[[u32; 2]] {
        let begin = self.pairs.partition_point(|&[first, _]| first < constraint);
        let count = self.pairs[begin..].partition_point(|&[first, _]| first == constraint);
        &self.pairs[begin..begin + count]
    }

    /// For each of `count` constraints, whether it repeats another.
    pub(crate) fn flags(&self, count: usize) -> Vec<bool> {
        let mut flags = vec![false; count];
        self.pairs.iter().for_each(|&[_, repeat]| flags[repeat as usize] = true);
        flags
    }
}
