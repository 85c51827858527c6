//! XYZ: one point per row, two or more numbers separated by spaces or tabs.
//!
//! The first three numbers are x, y and z. Further numbers, such as a colour, are not read, but every row must have as
//! many as the first. A first row without numbers is a header. `#` starts a comment; empty rows are ignored.

use std::fmt::Display;
use std::io::{self, Write};

use crate::failure::{counted, quoted, Failure};
use crate::formats::blocks::{Blocks, RowEnd};
use crate::formats::pieces::{no_byte, Take};
use crate::input::Input;
use crate::memory::Memory;
use crate::points::PointTable;
use crate::text;

/// Reads the points of a file.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    let mut reader = PointReader::new(memory);
    reader.read(text::without_mark(bytes)?)?;
    reader.table.complete()
}

/// Calls `take` with the coordinates of the points, in pieces of up to about 256 KiB of text, or one row if that is
/// longer.
///
/// # Errors
/// The text is empty, a row or a number is wrong, a whole number is beyond 64 bits, or `take` fails.
pub fn read_pieces(input: Input, take: Take<'_>) -> Result<(), Failure> {
    let (mut blocks, mut reader) = (Blocks::new(input, RowEnd::Feed), PointReader::new(Memory::ENDLESS));
    let mut is_first = true;
    while let Some(block) = blocks.next()? {
        let block = if std::mem::take(&mut is_first) { text::without_mark(block)? } else { block };
        reader.read(block)?;
        take(&reader.table.take_exact()?)?;
    }
    if is_first {
        Err(no_byte())
    } else {
        Ok(())
    }
}

/// The points read so far.
struct PointReader {
    /// The number of values of a row; zero before the first one.
    width: usize,
    /// The number of rows of the file that were read.
    rows: usize,
    table: PointTable,
}

impl PointReader {
    fn new(memory: Memory) -> Self {
        Self { width: 0, rows: 0, table: PointTable::of_rows([1, 2, 3]).within(memory) }
    }

    /// Reads the next rows of the file.
    fn read(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let before = self.rows;
        for (number, content) in text::rows(bytes) {
            self.rows = before + number;
            self.take_row(text::without_comment(content))?;
        }
        Ok(())
    }

    fn take_row(&mut self, content: &[u8]) -> Result<(), Failure> {
        let (row, count) = (self.rows, text::words(content).count());
        if count == 0 {
            return Ok(());
        }
        if self.width == 0 {
            self.width = count;
            if !text::words(content).any(text::looks_like_number) {
                return Ok(());
            }
        }
        if count < 2 {
            let shown = quoted(content.trim_ascii());
            return Err(Failure::input(format!("row {row} has 1 value, {shown}: a point is a row 'x y'")));
        }
        if count != self.width {
            return Err(Failure::input(format!(
                "row {row} has {}, the first row has {}: all rows need the same",
                counted(count, "value"),
                self.width
            )));
        }
        let mut words = text::words(content);
        self.table.push([words.next().unwrap_or_default(), words.next().unwrap_or_default()], row)?;
        self.table.push_height(words.next(), row)
    }
}

/// Writes points, one per row.
pub fn write_points<N: Display>(points: impl Iterator<Item = [N; 2]>, out: &mut dyn Write) -> io::Result<()> {
    for [x, y] in points {
        writeln!(out, "{x} {y}")?;
    }
    Ok(())
}
