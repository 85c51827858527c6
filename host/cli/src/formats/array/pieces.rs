//! An array in pieces of rows, so that a file may be larger than the memory.

use std::io::SeekFrom;

use super::cells::Cells;
use super::header::{Layout, Wanted};
use super::stream::check_length;
use crate::failure::Failure;
use crate::input::{unreadable, Input, ReadSeek};

/// An array whose rows are read piece by piece. An array in Fortran order is read from several places in turn.
pub struct Pieces {
    source: Box<dyn ReadSeek>,
    layout: Layout,
    /// The number of bytes before the rows.
    head: u64,
    /// The place in the source.
    at: u64,
}

impl Pieces {
    /// Reads the header of an array. A packed array is unpacked into the memory as a whole.
    pub fn open(input: Input, wanted: &Wanted) -> Result<Self, Failure> {
        let size = input.size();
        let mut source = input.into_seekable()?;
        let (layout, head) = Layout::read(&mut source, wanted)?;
        if size > 0 {
            check_length(&layout, size.saturating_sub(head))?;
        }
        Ok(Self { source, layout, head, at: head })
    }

    /// The places of the numbers of the array.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Calls `take` with each column of the rows from `first` on, of which there are `rows`.
    pub fn read(
        &mut self,
        first: usize,
        rows: usize,
        mut take: impl FnMut(&Cells<'_>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let mut begin = self.head;
        for pass in &self.layout.passes {
            let place = begin + first as u64 * pass.stride as u64;
            if place != self.at {
                self.source.seek(SeekFrom::Start(place)).map_err(|error| unreadable(&error))?;
            }
            let mut bytes = vec![0; rows * pass.stride];
            self.source.read_exact(&mut bytes).map_err(|error| unreadable(&error))?;
            self.at = place + bytes.len() as u64;
            for column in &pass.columns {
                let (axis, offset, item) = (column.axis, column.offset, column.item);
                take(&Cells { bytes: &bytes, stride: pass.stride, offset, item, axis, first, list: first })?;
            }
            begin += self.layout.rows as u64 * pass.stride as u64;
        }
        Ok(())
    }
}
