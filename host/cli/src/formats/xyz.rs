//! XYZ: one point per row, two or more numbers separated by spaces or tabs.
//!
//! The first three numbers are x, y and z. Further numbers, such as a colour, are not read, but every row must have as
//! many as the first. A first row without numbers is a header. `#` starts a comment; empty rows are ignored.

use std::fmt::Display;
use std::io::{self, Write};

use crate::failure::{counted, quoted, Failure};
use crate::memory::Memory;
use crate::points::PointTable;
use crate::text;

/// Reads the points of a file.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    let bytes = text::without_mark(bytes)?;
    let mut table = PointTable::of_rows([1, 2, 3]).within(memory);
    let mut width = 0;
    for (row, content) in text::rows(bytes) {
        let content = text::without_comment(content);
        let count = text::words(content).count();
        if count == 0 {
            continue;
        }
        if width == 0 {
            width = count;
            if !text::words(content).any(text::looks_like_number) {
                continue;
            }
        }
        if count < 2 {
            let shown = quoted(content.trim_ascii());
            return Err(Failure::input(format!("row {row} has 1 value, {shown}: a point is a row 'x y'")));
        }
        if count != width {
            return Err(Failure::input(format!(
                "row {row} has {}, the first row has {width}: all rows need the same",
                counted(count, "value")
            )));
        }
        let mut words = text::words(content);
        table.push([words.next().unwrap_or_default(), words.next().unwrap_or_default()], row)?;
        table.push_height(words.next(), row)?;
    }
    table.complete()
}

/// Writes points, one per row.
pub fn write_points<N: Display>(points: impl Iterator<Item = [N; 2]>, out: &mut dyn Write) -> io::Result<()> {
    for [x, y] in points {
        writeln!(out, "{x} {y}")?;
    }
    Ok(())
}
