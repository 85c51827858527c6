//! Rows that come in any order, sorted within a bound on the memory. The validator shares no sort with the back ends, so
//! this one is its own.

use std::cmp::Reverse;
use std::collections::binary_heap::PeekMut;
use std::collections::BinaryHeap;
use std::path::{Path, PathBuf};

use super::spill::Spill;
use crate::failure::Failure;

/// The fewest bytes that are read from a run at once.
const LEAST_BLOCK: u64 = 1 << 10;

/// Rows of `N` numbers, in sorted runs: the last one in memory, the others in one file.
pub struct Sorter<const N: usize> {
    folder: PathBuf,
    /// The most rows in memory.
    room: usize,
    rows: Vec<[u32; N]>,
    runs: Runs,
}

/// The runs in a file.
#[derive(Default)]
struct Runs {
    spill: Option<Spill>,
    /// For each run the place of its first row, and the number of its rows.
    ranges: Vec<(u64, usize)>,
}

impl<const N: usize> Sorter<N> {
    /// Makes an empty list, which has at most `memory` bytes in memory, and the rest in a file of the folder.
    pub fn new(folder: &Path, memory: u64) -> Self {
        let room = usize::try_from(memory / (4 * N as u64)).unwrap_or(usize::MAX).max(1 << 10);
        Self { folder: folder.to_owned(), room, rows: Vec::new(), runs: Runs::default() }
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn push(&mut self, row: [u32; N]) -> Result<(), Failure> {
        if self.rows.len() == self.room {
            self.spill()?;
        }
        if self.rows.len() == self.rows.capacity() {
            // Doubling could take twice the memory.
            let more = self.rows.len().clamp(1 << 10, 1 << 16).min(self.room - self.rows.len());
            self.rows.reserve_exact(more);
        }
        self.rows.push(row);
        Ok(())
    }

    fn spill(&mut self) -> Result<(), Failure> {
        self.rows.sort_unstable();
        let spill = match &mut self.runs.spill {
            Some(spill) => spill,
            none => none.insert(Spill::create(&self.folder)?),
        };
        self.runs.ranges.push((spill.append(&self.rows)?, self.rows.len()));
        self.rows.clear();
        Ok(())
    }

    /// All rows.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(mut self) -> Result<Sorted<N>, Failure> {
        if self.runs.spill.is_some() {
            self.spill()?;
            self.rows = Vec::new();
        }
        self.rows.sort_unstable();
        Ok(Sorted { rows: self.rows, runs: self.runs })
    }
}

/// Sorted rows, which can be read any number of times.
pub struct Sorted<const N: usize> {
    /// All rows, if there is no file.
    rows: Vec<[u32; N]>,
    runs: Runs,
}

impl<const N: usize> Sorted<N> {
    /// The rows from the first one on. Reading takes about `memory` bytes if the rows are in a file.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn stream(&self, memory: u64) -> Result<Stream<'_, N>, Failure> {
        let share = (memory / self.runs.ranges.len().max(1) as u64).max(LEAST_BLOCK);
        let block = usize::try_from(share / (4 * N as u64)).unwrap_or(usize::MAX).max(1);
        let mut stream = Stream {
            rows: self.rows.iter(),
            spill: self.runs.spill.as_ref(),
            block,
            readers: Vec::new(),
            heads: BinaryHeap::new(),
            next: None,
        };
        for (number, &(at, left)) in self.runs.ranges.iter().enumerate() {
            let mut reader = Reader { at, left, rows: Vec::new(), done: 0 };
            if let (Some(spill), true) = (stream.spill, left > 0) {
                let row = reader.next(spill, block)?;
                stream.heads.extend(row.map(|row| Reverse((row, number))));
            }
            stream.readers.push(reader);
        }
        stream.advance()?;
        Ok(stream)
    }
}

/// Sorted rows, one after the other.
pub struct Stream<'a, const N: usize> {
    rows: std::slice::Iter<'a, [u32; N]>,
    spill: Option<&'a Spill>,
    /// The number of rows that are read from a run at once.
    block: usize,
    readers: Vec<Reader<N>>,
    /// The first row that is left of each run, and the number of the run.
    heads: BinaryHeap<Reverse<([u32; N], usize)>>,
    next: Option<[u32; N]>,
}

impl<const N: usize> Stream<'_, N> {
    /// The next row, which stays.
    pub fn peek(&self) -> Option<&[u32; N]> {
        self.next.as_ref()
    }

    /// Takes the next row.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn take(&mut self) -> Result<Option<[u32; N]>, Failure> {
        let row = self.next;
        if row.is_some() {
            self.advance()?;
        }
        Ok(row)
    }

    fn advance(&mut self) -> Result<(), Failure> {
        let Some(spill) = self.spill else {
            self.next = self.rows.next().copied();
            return Ok(());
        };
        let Some(mut head) = self.heads.peek_mut() else {
            self.next = None;
            return Ok(());
        };
        let Reverse((row, number)) = *head;
        self.next = Some(row);
        match self.readers[number].next(spill, self.block)? {
            Some(row) => *head = Reverse((row, number)),
            None => {
                PeekMut::pop(head);
            }
        }
        Ok(())
    }
}

/// A run that is read block by block.
struct Reader<const N: usize> {
    at: u64,
    /// The number of rows that were not read yet.
    left: usize,
    rows: Vec<[u32; N]>,
    done: usize,
}

impl<const N: usize> Reader<N> {
    fn next(&mut self, spill: &Spill, block: usize) -> Result<Option<[u32; N]>, Failure> {
        if self.done == self.rows.len() {
            let count = block.min(self.left);
            self.rows.clear();
            self.rows.reserve_exact(count);
            spill.read(self.at, count, &mut self.rows)?;
            self.at += (count * 4 * N) as u64;
            self.left -= count;
            self.done = 0;
        }
        let row = self.rows.get(self.done).copied();
        self.done += 1;
        Ok(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    #[test]
    fn rows_are_sorted_in_any_memory() {
        let folder = std::env::temp_dir();
        let mut random = SplitMix64::new(8);
        for count in [0usize, 1, 1023, 1024, 1025, 5000, 20_000] {
            let mut rows: Vec<[u32; 3]> = (0..count).map(|_| [0; 3].map(|_: u32| random.below_u32(40))).collect();
            for memory in [0, 100_000, 1 << 20] {
                let mut sorter = Sorter::new(&folder, memory);
                rows.iter().try_for_each(|&row| sorter.push(row)).expect("the folder can be written");
                let sorted = sorter.finish().expect("the folder can be written");
                rows.sort_unstable();
                // Twice, because the rows can be read again.
                for memory in [0, 1 << 16] {
                    let mut stream = sorted.stream(memory).expect("the file can be read");
                    for row in &rows {
                        assert_eq!(stream.peek(), Some(row), "{count} rows");
                        assert_eq!(stream.take().expect("the file can be read"), Some(*row), "{count} rows");
                    }
                    assert_eq!(stream.take().expect("the file can be read"), None);
                }
            }
        }
    }
}
