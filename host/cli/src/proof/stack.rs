//! A stack of points that may be larger than the memory: one side of the hull while it is made.

use std::path::{Path, PathBuf};

use super::spill::Spill;
use crate::failure::Failure;

/// The number of rows of a block. The memory holds at most two.
const BLOCK: usize = 1 << 13;
/// The number of bytes of a block in the file.
const BLOCK_BYTES: u64 = (BLOCK * 12) as u64;

/// Rows of which the last one comes first.
pub struct Stack {
    folder: PathBuf,
    /// The rows on top. At least two, if the stack has two.
    rows: Vec<[u32; 3]>,
    spill: Option<Spill>,
    /// The number of blocks in the file.
    blocks: u64,
}

impl Stack {
    /// Makes an empty stack, which puts what does not fit the memory into a file of this folder.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), rows: Vec::new(), spill: None, blocks: 0 }
    }

    /// The number of rows.
    pub fn len(&self) -> u64 {
        self.blocks * BLOCK as u64 + self.rows.len() as u64
    }

    /// The last two rows, the last one behind the other; `None` if there are fewer.
    pub fn last_two(&self) -> Option<[[u32; 3]; 2]> {
        self.rows.last_chunk().copied()
    }

    /// Puts a row on top.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn push(&mut self, row: [u32; 3]) -> Result<(), Failure> {
        if self.rows.len() == 2 * BLOCK {
            let spill = match &mut self.spill {
                Some(spill) => spill,
                none => none.insert(Spill::create(&self.folder)?),
            };
            spill.write(self.blocks * BLOCK_BYTES, &self.rows[..BLOCK])?;
            self.rows.drain(..BLOCK);
            self.blocks += 1;
        }
        self.rows.push(row);
        Ok(())
    }

    /// Takes the row on top.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn pop(&mut self) -> Result<Option<[u32; 3]>, Failure> {
        let row = self.rows.pop();
        if let (Some(spill), true) = (&self.spill, self.blocks > 0 && self.rows.len() < 2) {
            self.blocks -= 1;
            let mut rows = Vec::with_capacity(2 * BLOCK);
            spill.read(self.blocks * BLOCK_BYTES, BLOCK, &mut rows)?;
            rows.append(&mut self.rows);
            self.rows = rows;
        }
        Ok(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    #[test]
    fn a_stack_in_a_file_is_a_stack() {
        let (mut stack, mut right) = (Stack::new(&std::env::temp_dir()), Vec::new());
        let mut random = SplitMix64::new(3);
        for round in 0..400u32 {
            for number in 0..random.below(2000) as u32 {
                stack.push([round, number, 0]).expect("the folder can be written");
                right.push([round, number, 0]);
            }
            for _ in 0..random.below(if round < 200 { 1000 } else { 3000 }) {
                assert_eq!(stack.pop().expect("the file can be read"), right.pop());
                assert_eq!((stack.len(), stack.last_two()), (right.len() as u64, right.last_chunk().copied()));
            }
        }
        assert!(stack.spill.is_some());
    }
}
