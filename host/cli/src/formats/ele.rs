//! `.ele`, the triangles of Shewchuk's Triangle: `N 3 attributes`, then `id a b c …`.
//!
//! Files are written with everything counted from 0. Ids of a file that is read begin with 0 or 1; vertices are counted
//! from 1 if the first id is 1 and no vertex is 0.
//!
//! Source: <https://www.cs.cmu.edu/~quake/triangle.ele.html>.

use std::io::{self, Write};

use crate::failure::{counted, Exit, Failure};
use crate::formats::blocks::{Blocks, RowEnd};
use crate::formats::mesh_view::MeshView;
use crate::formats::pieces::TakeTriangle;
use crate::formats::triangle;
use crate::input::Input;
use crate::memory::Memory;
use crate::points::Place;
use crate::text;

const HEADER: triangle::Header =
    triangle::Header { name: ".ele", row: "N 3 0", items: "triangles", second: ("number of corners", "3") };

/// Reads the triangles of a mesh. A list that is longer or shorter than its first row promises fails
/// verification, whatever it holds.
pub fn read_mesh(bytes: &[u8], memory: Memory) -> Result<Vec<[u32; 3]>, Failure> {
    let (promised, rows) = triangle::open(bytes, &HEADER)?;
    let mut triangles = Vec::new();
    let mut first_id = 0;
    for (row, content) in rows {
        let [id, a, b, c] = read_row(content, row)?;
        if triangles.is_empty() {
            first_id = id;
        }
        memory.push(&mut triangles, [a, b, c])?;
    }
    check_promise(promised, triangles.len() as u64)?;
    if first_id == 1 && triangles.iter().flatten().all(|&vertex| vertex > 0) {
        triangles.iter_mut().flatten().for_each(|vertex| *vertex -= 1);
    }
    Ok(triangles)
}

/// The number from which the vertices of a mesh are counted, 0 or 1. The mesh is read in pieces of about 256 KiB.
///
/// # Errors
/// As for [`read_mesh`].
pub fn base(input: Input) -> Result<u32, Failure> {
    let (mut first_id, mut least) = (None, u32::MAX);
    each_row(input, &mut |[id, corners @ ..]| {
        first_id.get_or_insert(id);
        least = corners.into_iter().fold(least, u32::min);
        Ok(())
    })?;
    Ok(u32::from(first_id == Some(1) && least > 0))
}

/// Calls `take` with the triangles of a mesh, which is read in pieces of about 256 KiB. `base` is the one of [`base`].
///
/// # Errors
/// As for [`read_mesh`], or `take` fails.
pub fn each_triangle(input: Input, base: u32, take: TakeTriangle<'_>) -> Result<(), Failure> {
    each_row(input, &mut |[_, a, b, c]| take([a, b, c].map(|vertex| vertex.wrapping_sub(base))))
}

/// Calls `take` with the values of all rows behind the first one.
fn each_row(input: Input, take: &mut dyn FnMut([u32; 4]) -> Result<(), Failure>) -> Result<(), Failure> {
    let mut blocks = Blocks::new(input.without_end(), RowEnd::Feed);
    let (mut promised, mut found, mut passed) = (None, 0, 0);
    while let Some(block) = blocks.next()? {
        let block = if passed == 0 { text::without_mark(block)? } else { block };
        for (row, content) in triangle::contents(block) {
            if promised.is_some() {
                take(read_row(content, passed + row)?)?;
                found += 1;
            } else {
                promised = Some(HEADER.promised(passed + row, content)?);
            }
        }
        passed += text::rows(block).count();
    }
    check_promise(promised.ok_or_else(|| HEADER.missing())?, found)
}

/// Refuses a list that is longer or shorter than its first row promises.
fn check_promise(promised: u32, found: u64) -> Result<(), Failure> {
    if found == u64::from(promised) {
        return Ok(());
    }
    let promised = counted(promised as usize, "triangle");
    Err(Failure::new(Exit::Rejected, format!("the first row promises {promised}, but the file holds {found}")))
}

fn read_row(content: &[u8], row: usize) -> Result<[u32; 4], Failure> {
    let mut values = [0; 4];
    let mut words = text::words(content);
    for (index, value) in values.iter_mut().enumerate() {
        let Some(word) = words.next() else {
            return Err(Failure::input(format!(
                "row {row} has {}: a triangle is a row 'id a b c'",
                counted(index, "value")
            )));
        };
        let what = if index == 0 { "an id" } else { "a point index" };
        let place = Place::Cell { row, column: index + 1 };
        *value = text::whole(word, what, place)?;
    }
    Ok(values)
}

/// Writes the triangles in their order, each with the attribute of its region if there are regions.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    let attributes = u8::from(mesh.attribute(0).is_some());
    writeln!(out, "{} 3 {attributes}", mesh.triangles.len())?;
    for (id, [a, b, c]) in mesh.triangles.iter().enumerate() {
        match mesh.attribute(id) {
            Some(attribute) => writeln!(out, "{id} {a} {b} {c} {attribute}")?,
            None => writeln!(out, "{id} {a} {b} {c}")?,
        }
    }
    Ok(())
}
