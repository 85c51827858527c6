//! `.node`, the points of Shewchuk's Triangle: `N 2 attributes markers`, then `id x y …`.
//!
//! Ids begin with 0 or 1 and must rise by one. Attributes and markers are not read. `#` starts a comment. The file must
//! hold exactly as many points as its first row promises.
//!
//! Source: <https://www.cs.cmu.edu/~quake/triangle.node.html>.

use std::fmt::Display;
use std::io::{self, Write};

use crate::failure::{counted, Failure};
use crate::formats::triangle;
use crate::memory::Memory;
use crate::points::{Place, PointTable};
use crate::text;

const HEADER: triangle::Header =
    triangle::Header { name: ".node", row: "N 2 attributes markers", items: "points", second: ("dimension", "2") };

/// The number of values of a row before its attributes: the id and two coordinates.
const FIXED: usize = 3;

/// Reads the points of a file.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    let (promised, rows) = triangle::open(bytes, &HEADER)?;
    let mut table = PointTable::of_rows([2, 3, 4]).within(memory);
    let mut ids = Ids::default();
    for (row, content) in rows {
        let count = table.len();
        if count as u64 == u64::from(promised) {
            return Err(Failure::input(format!(
                "row {row} is one point more than the {promised} that the first row promises"
            )));
        }
        let (id, point) = read_point(content, row)?;
        ids.check(id, count, row)?;
        table.push(point, row)?;
    }
    let found = table.len();
    if found as u64 != u64::from(promised) {
        let promised = counted(promised as usize, "point");
        return Err(Failure::input(format!("the first row promises {promised}, but the file holds {found}")));
    }
    table.complete()
}

/// The id of the first point of a file, 0 if there is none.
pub fn first_id(bytes: &[u8]) -> Result<u32, Failure> {
    let (_, mut rows) = triangle::open(bytes, &HEADER)?;
    rows.next().map_or(Ok(0), |(row, content)| read_point(content, row).map(|(id, _)| id))
}

/// The ids of points, which start at 0 or 1 and rise by one.
#[derive(Default)]
pub(super) struct Ids {
    /// The first id.
    pub base: u32,
}

impl Ids {
    /// Checks the id of a point before which there are `count`.
    pub fn check(&mut self, id: u32, count: usize, row: usize) -> Result<(), Failure> {
        if count == 0 {
            self.base = id;
        }
        let expected = u64::from(self.base) + count as u64;
        if self.base <= 1 && u64::from(id) == expected {
            return Ok(());
        }
        let wanted = if count == 0 { "0 or 1".to_owned() } else { expected.to_string() };
        Err(Failure::input(format!(
            "row {row}, column 1: the id is {id}, not {wanted}: ids count from 0 or 1 and rise by one"
        )))
    }
}

/// Reads a row `id x y …`.
pub(super) fn read_point(content: &[u8], row: usize) -> Result<(u32, [&[u8]; 2]), Failure> {
    let mut values = [&[][..]; FIXED];
    let mut count = 0;
    for (slot, value) in values.iter_mut().zip(text::words(content)) {
        *slot = value;
        count += 1;
    }
    if count < FIXED {
        return Err(Failure::input(format!("row {row} has {}: a point is a row 'id x y'", counted(count, "value"))));
    }
    let id = text::whole(values[0], "an id", Place::Cell { row, column: 1 })?;
    Ok((id, [values[1], values[2]]))
}

/// Writes points with ids from 0.
pub fn write_points<N: Display>(points: impl ExactSizeIterator<Item = [N; 2]>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{} 2 0 0", points.len())?;
    for (id, [x, y]) in points.enumerate() {
        writeln!(out, "{id} {x} {y}")?;
    }
    Ok(())
}
