//! The lines that a sweep from left to right has met and not left yet, from the lowest to the highest.

use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

use super::exact::ExactPoint;
use super::sites::Sites;

/// The most strands of a block. A search takes the logarithm of their number, and a change moves one block.
const BLOCK: usize = 256;

/// Constraints that lie on one line and overlap, or follow one another, at the place that the sweep has reached.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strand {
    /// Two points of the line, the lexicographically smaller one first: the place where the strand began, and an end of
    /// one of its constraints.
    pub line: [u32; 2],
    /// The number of lines that overlap here.
    pub lines: usize,
    /// The number of constraints of the boundary, and the same with those that run back counted down.
    pub count: i64,
    pub turns: i64,
    /// The number of the piece that is open.
    pub piece: usize,
}

impl Strand {
    /// Where a point lies: `Greater` above the strand, `Equal` on its line.
    pub(super) fn side<P: ExactPoint>(&self, sites: &Sites<'_, P>, q: P) -> Ordering {
        let [a, b] = self.line.map(|index| sites.at(index));
        P::orient2d(a, b, q)
    }
}

/// A place between strands: a block, and a place in it.
pub(super) type Gap = [usize; 2];

/// Strands in rising order, in blocks that are never empty.
#[derive(Debug, Default)]
pub(super) struct Strands(Vec<Vec<Strand>>);

impl Strands {
    /// The gap above all strands that are below something. O(log n).
    pub(super) fn find(&self, is_below: impl Fn(&Strand) -> bool) -> Gap {
        let block = self.0.partition_point(|block| block.last().is_some_and(&is_below));
        [block, self.0.get(block).map_or(0, |block| block.partition_point(&is_below))]
    }

    /// The strand directly above a gap.
    pub(super) fn above(&self, [block, place]: Gap) -> Option<&Strand> {
        let own = self.0.get(block)?;
        own.get(place).or_else(|| self.0.get(block + 1)?.first())
    }

    /// The strand directly below a gap.
    pub(super) fn below(&self, [block, place]: Gap) -> Option<&Strand> {
        match place.checked_sub(1) {
            Some(before) => self.0.get(block)?.get(before),
            None => self.0.get(block.checked_sub(1)?)?.last(),
        }
    }

    /// Takes the strand directly above a gap away, and returns the gap where it was.
    pub(super) fn remove(&mut self, [mut block, mut place]: Gap) -> Gap {
        if self.0.get(block).is_some_and(|own| place == own.len()) {
            [block, place] = [block + 1, 0];
        }
        if let Some(own) = self.0.get_mut(block).filter(|own| place < own.len()) {
            own.remove(place);
            if own.is_empty() {
                self.0.remove(block);
                place = 0;
            }
        }
        [block, place]
    }

    /// Puts a strand into a gap, and returns the gap above it.
    pub(super) fn insert(&mut self, [mut block, mut place]: Gap, strand: Strand) -> Gap {
        if block == self.0.len() {
            match block.checked_sub(1) {
                Some(before) => [block, place] = [before, self.0[before].len()],
                None => self.0.push(vec![]),
            }
        }
        let own = &mut self.0[block];
        own.insert(place, strand);
        place += 1;
        if own.len() > BLOCK {
            let upper = own.split_off(BLOCK / 2);
            self.0.insert(block + 1, upper);
            if place > BLOCK / 2 {
                [block, place] = [block + 1, place - BLOCK / 2];
            }
        }
        [block, place]
    }
}
