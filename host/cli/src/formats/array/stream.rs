//! Reading an array piece by piece, so that the bytes of a file are never in memory as a whole.

use std::io::Read;

use super::cells::Cells;
use super::header::{Layout, Wanted, LONGEST_ROW};
use crate::failure::{counted, Failure};
use crate::input::{unreadable, Input};
use crate::memory::Memory;

/// The bytes of an array, with its header.
pub struct Source<'a> {
    bytes: &'a mut dyn Read,
    /// The number of bytes, if that is known before they are read.
    size: Option<u64>,
    /// The memory that the numbers, and what is made of them, may take.
    memory: Memory,
}

impl<'a> Source<'a> {
    /// An array in a file.
    pub fn of_input(input: &'a mut Input) -> Self {
        let (size, memory) = (input.size(), input.memory());
        Self { bytes: input, size: (size > 0).then_some(size), memory }
    }

    /// An array in an archive. The archive says how large it is, but only the bytes that are read prove it.
    pub fn of_entry(bytes: &'a mut dyn Read, memory: Memory) -> Self {
        Self { bytes, size: None, memory }
    }

    /// Reads the header. An array is refused if it has more rows than `check` lets pass, or if the file has another
    /// length than its header promises.
    pub fn open(&mut self, wanted: &Wanted, check: fn(Memory, u64) -> Result<(), Failure>) -> Result<Layout, Failure> {
        let (layout, header_bytes) = Layout::read(self.bytes, wanted)?;
        if let Some(size) = self.size {
            check_length(&layout, size.saturating_sub(header_bytes))?;
        }
        check(self.memory, layout.rows as u64)?;
        Ok(layout)
    }

    /// The number of rows for which memory is taken before they are read: all rows if the length of the file proves
    /// that they are there, else none.
    pub fn certain_rows(&self, layout: &Layout) -> usize {
        if self.size.is_some() {
            layout.rows
        } else {
            0
        }
    }

    /// Calls `take` with each column of each piece of the array.
    pub fn read(
        &mut self,
        layout: &Layout,
        mut take: impl FnMut(&Cells<'_>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        // No row is longer than this, so a piece has at least one row.
        let mut piece = vec![0; LONGEST_ROW];
        let mut done = 0;
        for pass in &layout.passes {
            let rows_of_piece = piece.len() / pass.stride.max(1);
            for first in (0..layout.rows).step_by(rows_of_piece.max(1)) {
                let rows = rows_of_piece.min(layout.rows - first);
                let bytes = &mut piece[..rows * pass.stride];
                let count = self.fill(bytes)?;
                done += count as u64;
                if count < bytes.len() {
                    return Err(cut(layout, done));
                }
                for column in &pass.columns {
                    let (axis, offset, item) = (column.axis, column.offset, column.item);
                    take(&Cells { bytes, stride: pass.stride, offset, item, axis, first, list: 0 })?;
                }
            }
        }
        // An archive compares its check sum when the entry is read to its end.
        if self.fill(&mut [0])? > 0 {
            return Err(too_long(layout, "bytes"));
        }
        Ok(())
    }

    /// Fills `bytes`, or its beginning if the file ends first. Returns the number of bytes read.
    fn fill(&mut self, bytes: &mut [u8]) -> Result<usize, Failure> {
        let mut count = 0;
        while count < bytes.len() {
            match self.bytes.read(&mut bytes[count..]) {
                Ok(0) => break,
                Ok(more) => count += more,
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                Err(error) => return Err(unreadable(&error)),
            }
        }
        Ok(count)
    }
}

/// Refuses an array whose rows have fewer or more bytes in the file than the header promises.
pub fn check_length(layout: &Layout, found: u64) -> Result<(), Failure> {
    if found < layout.bytes {
        return Err(cut(layout, found));
    }
    if found > layout.bytes {
        let left = counted(usize::try_from(found - layout.bytes).unwrap_or(usize::MAX), "byte");
        return Err(too_long(layout, &left));
    }
    Ok(())
}

fn cut(layout: &Layout, found: u64) -> Failure {
    let Layout { bytes, shape, .. } = layout;
    Failure::input(format!(
        "the header promises an array of shape {shape} in {bytes} bytes, but the file ends after {found} of them"
    ))
}

fn too_long(layout: &Layout, left: &str) -> Failure {
    let shape = &layout.shape;
    Failure::input(format!("the file holds more than its header promises: {left} after the array of shape {shape}"))
}
