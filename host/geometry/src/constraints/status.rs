//! The lines that a sweep from left to right has met and not left yet, from the lowest to the highest.

use alloc::vec;
use alloc::vec::Vec;

/// The most lines of a block. A search takes the logarithm of the number of lines, and a change moves one block.
const BLOCK: usize = 128;

/// Lines by their numbers in rising order, in blocks.
pub(super) struct Status {
    /// The lines of each block.
    blocks: Vec<Vec<u32>>,
    /// The blocks from the lowest to the highest, and the rank of each block in that order. Only the last block that is
    /// left may be empty.
    order: Vec<u32>,
    ranks: Vec<u32>,
    /// Blocks that are in use no more.
    free: Vec<u32>,
    /// The block of each line.
    block_of: Vec<u32>,
}

impl Status {
    /// An empty list for lines with numbers below `lines`.
    pub fn new(lines: usize) -> Self {
        Self { blocks: vec![vec![]], order: vec![0], ranks: vec![0], free: Vec::new(), block_of: vec![0; lines] }
    }

    /// The block of a line that is in the list, and the place in the block.
    fn find(&self, line: u32) -> (usize, usize) {
        let block = self.block_of[line as usize] as usize;
        (block, self.blocks[block].iter().position(|&own| own == line).unwrap_or(0))
    }

    /// The line directly below one that is in the list.
    pub fn below(&self, line: u32) -> Option<u32> {
        let (block, place) = self.find(line);
        if let Some(before) = place.checked_sub(1) {
            return Some(self.blocks[block][before]);
        }
        let rank = self.ranks[block].checked_sub(1)?;
        self.blocks[self.order[rank as usize] as usize].last().copied()
    }

    /// The line directly above one that is in the list.
    pub fn above(&self, line: u32) -> Option<u32> {
        let (block, place) = self.find(line);
        if let Some(&next) = self.blocks[block].get(place + 1) {
            return Some(next);
        }
        let next = self.order.get(self.ranks[block] as usize + 1)?;
        self.blocks[*next as usize].first().copied()
    }

    /// Whether both lines are in the list, the second one directly above the first.
    pub fn is_above(&self, lower: u32, upper: u32) -> bool {
        self.has(lower) && self.above(lower) == Some(upper)
    }

    fn has(&self, line: u32) -> bool {
        self.blocks[self.block_of[line as usize] as usize].contains(&line)
    }

    /// Exchanges a line with the one directly above it.
    pub fn swap(&mut self, lower: u32, upper: u32) {
        let ((block, place), (other, above)) = (self.find(lower), self.find(upper));
        self.blocks[block][place] = upper;
        self.blocks[other][above] = lower;
        self.block_of.swap(lower as usize, upper as usize);
    }

    /// The rank of the block, and the place in it, of the first line for which `is_below` is false.
    fn search(&self, is_below: impl Fn(u32) -> bool) -> (usize, usize) {
        let is_whole = |&block: &u32| self.blocks[block as usize].last().is_some_and(|&line| is_below(line));
        let rank = self.order.partition_point(is_whole).min(self.order.len() - 1);
        (rank, self.blocks[self.order[rank] as usize].partition_point(|&line| is_below(line)))
    }

    /// The lines from the first line for which `is_below` is false.
    pub fn not_below(&self, is_below: impl Fn(u32) -> bool) -> impl Iterator<Item = u32> + '_ {
        let (rank, place) = self.search(is_below);
        let lines = self.order[rank..].iter().flat_map(|&block| self.blocks[block as usize].iter().copied());
        lines.skip(place)
    }

    /// Inserts a line directly above the lines for which `is_below` is true; these must be the lowest ones.
    pub fn insert(&mut self, line: u32, is_below: impl Fn(u32) -> bool) {
        let (rank, place) = self.search(is_below);
        let block = self.order[rank];
        self.block_of[line as usize] = block;
        let own = &mut self.blocks[block as usize];
        own.insert(place, line);
        if own.len() <= BLOCK {
            return;
        }
        let upper = own.split_off(BLOCK / 2);
        let new = self.free.pop().unwrap_or_else(|| {
            self.blocks.push(vec![]);
            self.ranks.push(0);
            self.blocks.len() as u32 - 1
        });
        upper.iter().for_each(|&line| self.block_of[line as usize] = new);
        self.blocks[new as usize] = upper;
        self.order.insert(rank + 1, new);
        self.rank_from(rank + 1);
    }

    /// Takes a line out.
    pub fn remove(&mut self, line: u32) {
        let (block, place) = self.find(line);
        self.blocks[block].remove(place);
        if self.blocks[block].is_empty() && self.order.len() > 1 {
            let rank = self.ranks[block] as usize;
            self.order.remove(rank);
            self.free.push(block as u32);
            self.rank_from(rank);
        }
    }

    fn rank_from(&mut self, first: usize) {
        for (rank, &block) in self.order.iter().enumerate().skip(first) {
            self.ranks[block as usize] = rank as u32;
        }
    }
}
