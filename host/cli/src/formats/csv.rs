//! Comma-separated values: points as rows `x,y`, meshes as rows `a,b,c`.
//!
//! A first row without numbers is a header. Names such as `x`, `y` or `lon`, `lat` choose the columns; otherwise the
//! first two columns count. A column named `z` is kept. The separator is a comma, or the semicolon or tab that the
//! first row has instead. Further columns are not read, but every row must have as many as the first one, because a
//! short row is a lost point. Empty rows and rows that start with `#` are ignored. An empty file is an empty list of
//! points.

use std::fmt::Display;
use std::io::{self, Write};

use crate::failure::{counted, quoted, Failure};
use crate::formats::blocks::{Blocks, RowEnd};
use crate::formats::csv_rows::{separator_of, CsvRows, Values};
use crate::formats::mesh_view::MeshView;
use crate::formats::pieces::{no_byte, Take, TakeTriangle};
use crate::input::Input;
use crate::memory::Memory;
use crate::points::{Place, PointTable};
use crate::text;

/// Names of the two columns in a header, in lower case.
const NAMES: [(&str, &str); 6] =
    [("x", "y"), ("lon", "lat"), ("lng", "lat"), ("long", "lat"), ("longitude", "latitude"), ("easting", "northing")];

/// Reads the points of a file.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    read_valued_points(bytes, None, memory)
}

/// Reads the points of a file. If `value` names a column or has its number, counted from 1, that column is taken for z.
pub fn read_valued_points(bytes: &[u8], value: Option<&str>, memory: Memory) -> Result<PointTable, Failure> {
    let mut reader = PointReader::new(value, memory);
    reader.read(text::without_mark(bytes)?)?;
    reader.table.complete()
}

/// Calls `take` with the coordinates of the points, in pieces of up to about 256 KiB of text, or one row if that is
/// longer.
///
/// # Errors
/// The text is empty, a row or a number is wrong, a whole number is beyond 64 bits, or `take` fails.
pub fn read_pieces(input: Input, value: Option<&str>, take: Take<'_>) -> Result<(), Failure> {
    let (mut blocks, mut reader) = (Blocks::new(input, RowEnd::Any), PointReader::new(value, Memory::ENDLESS));
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

/// The columns of a file, and the points read so far.
struct PointReader<'v> {
    value: Option<&'v str>,
    columns: [usize; 2],
    z: Option<usize>,
    /// The number of columns; zero before the first row.
    width: usize,
    /// The byte between two values, once a row is read.
    separator: Option<u8>,
    /// The number of rows of the file that were read.
    rows: usize,
    table: PointTable,
}

impl<'v> PointReader<'v> {
    fn new(value: Option<&'v str>, memory: Memory) -> Self {
        let z = value.and_then(number_of_column);
        let table = PointTable::of_rows([1, 2, z.map_or(3, |column| column + 1)]).within(memory);
        Self { value, columns: [0, 1], z, width: 0, separator: None, rows: 0, table }
    }

    /// Reads the next rows of the file.
    fn read(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let mut rows = match self.separator {
            Some(separator) => CsvRows::after(self.rows, bytes, separator),
            None => CsvRows::after(self.rows, bytes, separator_of(bytes)),
        };
        loop {
            // The quick way reads rows of two columns, x and y. In a file with the header `x,z` one of the two is the
            // z.
            if self.width == 2 && self.columns == [0, 1] && self.z.is_none() {
                while let Some((row, pair)) = rows.next_pair() {
                    self.table.push_decimals(pair, row)?;
                }
            }
            let separator = rows.separator();
            let Some((row, values)) = rows.next()? else { break };
            if self.width == 0 {
                self.separator = Some(separator);
                if self.take_first(&values, row)? {
                    continue;
                }
            }
            refuse_other_width(&values, self.width, row)?;
            self.table.push(self.columns.map(|column| values.get(column)), row)?;
            if let Some(column) = self.z {
                self.table.push_height(Some(values.get(column)), row)?;
            }
        }
        self.rows = rows.row();
        Ok(())
    }

    /// Learns the columns from the first row. Returns whether it is a header.
    fn take_first(&mut self, values: &Values<'_>, row: usize) -> Result<bool, Failure> {
        self.width = values.len();
        refuse_one_column(values, row)?;
        let is_header = !values.iter().any(text::looks_like_number);
        if is_header {
            self.columns = named_columns(values);
            self.z = match self.value {
                None => named_column(values, "z"),
                Some(name) => named_column(values, name).or(self.z),
            };
            let [x, y] = self.columns;
            self.table.set_columns([x, y, self.z.unwrap_or(0)].map(|column| column + 1));
        }
        self.value.map_or(Ok(()), |name| refuse_no_column(name, self.z, self.width))?;
        Ok(is_header)
    }
}

/// Reads the triangles of a mesh.
pub fn read_mesh(bytes: &[u8], memory: Memory) -> Result<Vec<[u32; 3]>, Failure> {
    let mut rows = CsvRows::new(text::without_mark(bytes)?);
    let mut triangles = Vec::new();
    let mut is_first = true;
    while let Some((row, values)) = rows.next()? {
        if let Some(triangle) = triangle_of(&values, row, std::mem::take(&mut is_first))? {
            memory.push(&mut triangles, triangle)?;
        }
    }
    Ok(triangles)
}

/// Calls `take` with the triangles of a mesh, which is read in pieces of about 256 KiB.
///
/// # Errors
/// The file cannot be read or has a wrong row, or `take` fails.
pub fn each_triangle(input: Input, take: TakeTriangle<'_>) -> Result<(), Failure> {
    let mut blocks = Blocks::new(input.without_end(), RowEnd::Any);
    let (mut passed, mut separator, mut is_first) = (0, None, true);
    while let Some(block) = blocks.next()? {
        let block = if separator.is_none() { text::without_mark(block)? } else { block };
        let mut rows = CsvRows::after(passed, block, *separator.get_or_insert_with(|| separator_of(block)));
        while let Some((row, values)) = rows.next()? {
            if let Some(triangle) = triangle_of(&values, row, std::mem::take(&mut is_first))? {
                take(triangle)?;
            }
        }
        passed = rows.row();
    }
    Ok(())
}

/// The triangle of a row; `None` for a first row that is a header.
fn triangle_of(values: &Values<'_>, row: usize, is_first: bool) -> Result<Option<[u32; 3]>, Failure> {
    if is_first && !values.iter().any(text::looks_like_number) {
        return Ok(None);
    }
    if values.len() != 3 {
        let columns = counted(values.len(), "column");
        return Err(Failure::input(format!("row {row} has {columns}: a triangle is a row of three point indices")));
    }
    let mut triangle = [0; 3];
    for (column, corner) in triangle.iter_mut().enumerate() {
        let place = Place::Cell { row, column: column + 1 };
        *corner = text::whole(values.get(column), "a point index", place)?;
    }
    Ok(Some(triangle))
}

/// Writes the triangles, without a header.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    for [a, b, c] in mesh.triangles {
        writeln!(out, "{a},{b},{c}")?;
    }
    Ok(())
}

/// Writes points, without a header.
pub fn write_points<N: Display>(points: impl Iterator<Item = [N; 2]>, out: &mut dyn Write) -> io::Result<()> {
    for [x, y] in points {
        writeln!(out, "{x},{y}")?;
    }
    Ok(())
}

fn named_columns(header: &Values<'_>) -> [usize; 2] {
    let mut pairs = NAMES.iter().filter_map(|(x, y)| Some([named_column(header, x)?, named_column(header, y)?]));
    pairs.next().unwrap_or([0, 1])
}

/// The column with this name, counted from 0.
fn named_column(header: &Values<'_>, name: &str) -> Option<usize> {
    header.iter().position(|field| field.trim_ascii().eq_ignore_ascii_case(name.as_bytes()))
}

/// The column of this number, which is counted from 1, counted from 0.
fn number_of_column(text: &str) -> Option<usize> {
    text.parse::<usize>().ok()?.checked_sub(1)
}

/// Refuses the name or number of a column that the file does not have.
fn refuse_no_column(name: &str, found: Option<usize>, width: usize) -> Result<(), Failure> {
    if found.is_some_and(|column| column < width) {
        return Ok(());
    }
    Err(Failure::input(format!(
        "there is no column {}: give a name of the header, or a number from 1 to {width}",
        quoted(name.as_bytes())
    )))
}

fn refuse_one_column(record: &Values<'_>, row: usize) -> Result<(), Failure> {
    if record.len() >= 2 {
        return Ok(());
    }
    let shown = quoted(record.get(0));
    Err(Failure::input(format!(
        "row {row} has 1 column, {shown}: a point is a row 'x,y' (for values separated by spaces: --from xyz)"
    )))
}

fn refuse_other_width(record: &Values<'_>, width: usize, row: usize) -> Result<(), Failure> {
    if record.len() == width {
        return Ok(());
    }
    Err(Failure::input(format!(
        "row {row} has {}, the first row has {width}: all rows need the same",
        counted(record.len(), "column")
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_z_in_the_second_column_is_kept() {
        let table = read_points(b"x,z\n0,5\n1,6\n2,7.5\n", Memory::ENDLESS).expect("points");
        assert_eq!(table.heights(), [5.0, 6.0, 7.5]);
        assert_eq!(table.doubles()[2], [2.0, 7.5]);
    }
}
