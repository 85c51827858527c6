//! Wavefront OBJ: rows `v x y z` and `f a b c`, with indices from 1.
//!
//! Points are the x and y of the vertices, and their z is kept; all other statements are ignored. Rows that do not
//! start with a word of the format are refused, because a file of another kind must not pass for one without points.
//! A first row with the mark of doubles says that the decimals stand for the nearest doubles.
//! Meshes hold every input point as a vertex, at height 0 if the input has no z, so indices stay those of the input.

use std::io::{self, Write};

use crate::failure::{counted, quoted, Failure};
use crate::formats::mesh_view::MeshView;
use crate::memory::Memory;
use crate::points::{Place, PointTable, DOUBLES};
use crate::text;

/// The words that a statement can start with, including those of older versions. Source: Wavefront, Advanced
/// Visualizer Manual, appendix B1.
const KEYWORDS: [&str; 42] = [
    "v",
    "vt",
    "vn",
    "vp",
    "f",
    "fo",
    "l",
    "p",
    "o",
    "g",
    "s",
    "mg",
    "mtllib",
    "maplib",
    "usemtl",
    "usemap",
    "cstype",
    "deg",
    "bmat",
    "step",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "call",
    "csh",
    "bsp",
    "bzp",
];

/// Reads the vertices of a file as points.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    let mut table = PointTable::of_rows([2, 3, 4]).within(memory);
    if text::rows(bytes).next().is_some_and(|(_, row)| row == format!("# {DOUBLES}").as_bytes()) {
        table.take_doubles();
    }
    for (row, mut values) in statements(bytes, b"v")? {
        let point = [values.next().unwrap_or_default(), values.next().unwrap_or_default()];
        table.push(point, row)?;
        table.push_height(values.next(), row)?;
    }
    table.complete()
}

/// Reads the faces, which must be triangles.
pub fn read_mesh(bytes: &[u8], memory: Memory) -> Result<Vec<[u32; 3]>, Failure> {
    let mut triangles = Vec::new();
    for (row, values) in statements(bytes, b"f")? {
        let mut triangle = [0; 3];
        let mut count = 0;
        for value in values {
            if let Some(corner) = triangle.get_mut(count) {
                *corner = read_corner(value, row, count + 2)?;
            }
            count += 1;
        }
        if count != 3 {
            let corners = counted(count, "corner");
            return Err(Failure::input(format!("row {row}: the face has {corners}, not 3")));
        }
        memory.push(&mut triangles, triangle)?;
    }
    Ok(triangles)
}

/// The statements that start with `word`: the row of each and the values after the word.
fn statements<'a>(
    bytes: &'a [u8],
    keyword: &'static [u8],
) -> Result<impl Iterator<Item = (usize, impl Iterator<Item = &'a [u8]>)>, Failure> {
    let bytes = text::without_mark(bytes)?;
    refuse_foreign_rows(bytes)?;
    Ok(text::rows(bytes).filter_map(move |(row, content)| {
        let mut words = text::words(text::without_comment(content));
        (words.next() == Some(keyword)).then_some((row, words))
    }))
}

/// Refuses rows that are not text or do not start with a word of the format. A row after a
/// backslash continues a statement.
fn refuse_foreign_rows(bytes: &[u8]) -> Result<(), Failure> {
    let mut goes_on = false;
    for (row, content) in text::rows(bytes) {
        if std::str::from_utf8(content).is_err() || content.contains(&0) {
            return Err(Failure::input(format!("row {row} is not UTF-8 text: an OBJ file is text")));
        }
        let first = text::words(text::without_comment(content)).next();
        let foreign = first.filter(|&word| !goes_on && !KEYWORDS.iter().any(|known| known.as_bytes() == word));
        if let Some(word) = foreign {
            let shown = quoted(word);
            return Err(Failure::input(format!(
                "row {row}: {shown} does not start a statement of OBJ, such as 'v' or 'f'"
            )));
        }
        goes_on = content.trim_ascii_end().ends_with(b"\\");
    }
    Ok(())
}

/// Parses a corner `vertex[/texture[/normal]]`; vertices are counted from 1 in the file and from 0 in the result.
fn read_corner(value: &[u8], row: usize, column: usize) -> Result<u32, Failure> {
    let vertex = value.split(|&byte| byte == b'/').next().unwrap_or_default();
    let place = Place::Cell { row, column };
    let number = std::str::from_utf8(vertex).ok().and_then(|text| text.parse::<u32>().ok());
    number.and_then(|number| number.checked_sub(1)).ok_or_else(|| {
        let shown = quoted(value);
        Failure::input(format!("{place}: {shown} is not a vertex: vertices are counted from 1"))
    })
}

/// Writes all input points and the triangles.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    if mesh.points.needs_mark() {
        writeln!(out, "# {DOUBLES}")?;
    }
    for ([x, y], z) in mesh.positions() {
        writeln!(out, "v {x} {y} {z}")?;
    }
    for triangle in mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| u64::from(vertex) + 1);
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}
