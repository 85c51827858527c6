//! Comma-separated values: points as rows `x,y`, meshes as rows `a,b,c`.
//!
//! A first row without numbers is a header. Names such as `x`, `y` or `lon`, `lat` choose the columns; otherwise the
//! first two columns count. A column named `z` is kept. The separator is a comma, or the semicolon or tab that the
//! first row has instead. Further columns are not read, but every row must have as many as the first one, because a
//! short row is a lost point. Empty rows and rows that start with `#` are ignored. An empty file is an empty list of
//! points.

use std::fmt::Display;
use std::io::{self, Write};

use csv::{ByteRecord, Reader, ReaderBuilder};

use crate::failure::{counted, Failure};
use crate::formats::mesh_view::MeshView;
use crate::points::{self, Place, PointTable};
use crate::text;

/// Names of the two columns in a header, in lower case.
const NAMES: [(&str, &str); 6] =
    [("x", "y"), ("lon", "lat"), ("lng", "lat"), ("long", "lat"), ("longitude", "latitude"), ("easting", "northing")];

/// Reads the points of a file.
pub fn read_points(bytes: &[u8]) -> Result<PointTable, Failure> {
    let bytes = text::without_mark(bytes)?;
    let mut reader = reader(bytes);
    let mut record = ByteRecord::new();
    let mut table = PointTable::of_rows([1, 2]);
    let mut columns = [0, 1];
    let mut z = None;
    let mut width = 0;
    while next(&mut reader, &mut record)? {
        let row = row_of(&record, bytes);
        if width == 0 {
            width = record.len();
            refuse_one_column(&record, row)?;
            if !record.iter().any(text::looks_like_number) {
                columns = named_columns(&record);
                z = named_column(&record, "z");
                table = PointTable::of_rows(columns.map(|column| column + 1));
                continue;
            }
        }
        refuse_other_width(&record, width, row)?;
        table.push(columns.map(|column| record.get(column).unwrap_or_default()), row)?;
        table.push_height(z.and_then(|column| record.get(column)).and_then(points::height));
    }
    table.complete()
}

/// Reads the triangles of a mesh.
pub fn read_mesh(bytes: &[u8]) -> Result<Vec<[u32; 3]>, Failure> {
    let bytes = text::without_mark(bytes)?;
    let mut reader = reader(bytes);
    let mut record = ByteRecord::new();
    let mut triangles = Vec::new();
    let mut first = true;
    while next(&mut reader, &mut record)? {
        let row = row_of(&record, bytes);
        let header = first && !record.iter().any(text::looks_like_number);
        first = false;
        if header {
            continue;
        }
        if record.len() != 3 {
            return Err(Failure::input(format!(
                "row {row} has {}: a triangle is a row of three point indices",
                counted(record.len(), "column")
            )));
        }
        let mut triangle = [0; 3];
        for (column, (corner, value)) in triangle.iter_mut().zip(&record).enumerate() {
            let place = Place::Cell { row, column: column + 1 };
            *corner = text::whole(value, "a point index", place)?;
        }
        triangles.push(triangle);
    }
    Ok(triangles)
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

fn reader(bytes: &[u8]) -> Reader<&[u8]> {
    ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .delimiter(delimiter(bytes))
        .from_reader(bytes)
}

/// The separator: a comma, or the semicolon or tab that the first row has instead.
fn delimiter(bytes: &[u8]) -> u8 {
    let mut rows = text::rows(bytes).map(|(_, row)| row);
    let first = rows.find(|row| !row.trim_ascii().is_empty() && !row.starts_with(b"#"));
    let first = first.unwrap_or_default();
    let candidates = [b',', b';', b'\t'];
    candidates.into_iter().find(|byte| first.contains(byte)).unwrap_or(b',')
}

/// Reads the next row that is not blank.
fn next(reader: &mut Reader<&[u8]>, record: &mut ByteRecord) -> Result<bool, Failure> {
    loop {
        match reader.read_byte_record(record) {
            Ok(true) if record.len() == 1 && record[0].trim_ascii().is_empty() => {}
            // An unclosed quote would swallow the following points.
            Ok(true) if record.as_slice().contains(&b'\n') => {
                let row = record.position().map_or(0, csv::Position::line);
                return Err(Failure::input(format!(
                    "row {row} or soon after: a quoted value runs over the end of its row: close the quote"
                )));
            }
            Ok(more) => return Ok(more),
            Err(error) => return Err(Failure::input(error.to_string())),
        }
    }
}

/// The row number of a record. The reader counts from the end of the previous record, so the ignored rows
/// in between are added.
fn row_of(record: &ByteRecord, bytes: &[u8]) -> usize {
    let Some(start) = record.position() else {
        return 0;
    };
    let number = |wide: u64| usize::try_from(wide).unwrap_or(usize::MAX);
    let mut row = number(start.line());
    let mut rest = bytes.get(number(start.byte())..).unwrap_or_default();
    while rest.starts_with(b"\n") || rest.starts_with(b"\r\n") || rest.starts_with(b"#") {
        let end = rest.iter().position(|&byte| byte == b'\n');
        rest = end.and_then(|end| rest.get(end + 1..)).unwrap_or_default();
        row += 1;
    }
    row
}

fn named_columns(header: &ByteRecord) -> [usize; 2] {
    let mut pairs = NAMES.iter().filter_map(|(x, y)| Some([named_column(header, x)?, named_column(header, y)?]));
    pairs.next().unwrap_or([0, 1])
}

/// The column with this name, counted from 0.
fn named_column(header: &ByteRecord, name: &str) -> Option<usize> {
    header.iter().position(|field| field.trim_ascii().eq_ignore_ascii_case(name.as_bytes()))
}

fn refuse_one_column(record: &ByteRecord, row: usize) -> Result<(), Failure> {
    if record.len() >= 2 {
        return Ok(());
    }
    let shown = crate::failure::quoted(record.get(0).unwrap_or_default());
    Err(Failure::input(format!(
        "row {row} has 1 column, {shown}: a point is a row 'x,y' (for values separated by spaces: --from xyz)"
    )))
}

fn refuse_other_width(record: &ByteRecord, width: usize, row: usize) -> Result<(), Failure> {
    if record.len() == width {
        return Ok(());
    }
    Err(Failure::input(format!(
        "row {row} has {}, the first row has {width}: all rows need the same",
        counted(record.len(), "column")
    )))
}
