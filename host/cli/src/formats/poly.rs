//! `.poly`, the plans of Shewchuk's Triangle: points, segments between them, places in holes, and places in regions.
//!
//! The points are those of a `.node` file: `N 2 attributes markers`, then `id x y …`. If `N` is 0, they stand in the
//! `.node` file beside. Then follow `N markers` with segments `id a b …`, `N` with holes `id x y`, and perhaps `N` with
//! regions `id x y attribute …`. Ids count from 0 or 1. The attribute of a region is a number, which the mesh gets as
//! it is written. Attributes and markers of points and segments are not read.
//!
//! Source: <https://www.cs.cmu.edu/~quake/triangle.poly.html>.

use crate::failure::{counted, Failure};
use crate::formats::node::{read_point, Ids};
use crate::formats::plan::PlanTable;
use crate::formats::triangle;
use crate::memory::Memory;
use crate::points::{number_at, Place, PointTable};
use crate::text;

const HEADER: triangle::Header =
    triangle::Header { name: ".poly", row: "N 2 attributes markers", items: "points", second: ("dimension", "2") };

/// The number of values before the attribute of a region.
const ATTRIBUTE: usize = 3;

/// A row with its number, without its comment.
type Row<'a> = (usize, &'a [u8]);

/// Reads a plan. `beside` reads the points of the `.node` file beside, and the id of the first.
pub fn read_plan(
    bytes: &[u8],
    memory: Memory,
    beside: &dyn Fn() -> Result<(PointTable, u32), Failure>,
) -> Result<PlanTable, Failure> {
    let (promised, mut rows) = triangle::open(bytes, &HEADER)?;
    let mut table = PointTable::of_rows([2, 3, 4]).within(memory);
    let mut ids = Ids::default();
    if promised == 0 {
        let (points, base) = beside()?;
        table = points.into_items();
        ids.base = base;
    }
    for _ in 0..promised {
        let (row, content) = next(&mut rows, "points", promised, table.len())?;
        let (id, point) = read_point(content, row)?;
        ids.check(id, table.len(), row)?;
        table.push(point, row)?;
    }
    let points = table.len();
    let mut plan = PlanTable::of_points(table, false);
    plan.is_poly = true;
    read_segments(&mut rows, &mut plan, ids.base)?;
    let holes = section(&mut rows, "holes")?.unwrap_or(0);
    for number in 0..holes {
        read_mark(&mut rows, &mut plan, "holes", [holes, number])?;
    }
    plan.holes = plan.table.len() - points;
    let regions = section(&mut rows, "regions")?.unwrap_or(0);
    for number in 0..regions {
        let (row, attribute) = read_mark(&mut rows, &mut plan, "regions", [regions, number])?;
        if let Some(attribute) = attribute {
            number_at(attribute, || Place::Cell { row, column: ATTRIBUTE + 1 })?;
        }
        plan.attributes.push(String::from_utf8_lossy(attribute.unwrap_or(b"0")).into_owned());
    }
    if let Some((row, _)) = rows.next() {
        return Err(Failure::input(format!("row {row} stands behind the last section of the file")));
    }
    plan.complete()
}

/// The next row of a section; an error if there is none.
fn next<'a>(
    rows: &mut impl Iterator<Item = Row<'a>>,
    items: &str,
    promised: u32,
    found: usize,
) -> Result<Row<'a>, Failure> {
    rows.next().ok_or_else(|| {
        Failure::input(format!("the file promises {promised} {items}, but the number of {items} in it is {found}"))
    })
}

/// The number of items of the next section; `None` at the end of the file.
fn section<'a>(rows: &mut impl Iterator<Item = Row<'a>>, items: &str) -> Result<Option<u32>, Failure> {
    let Some((row, content)) = rows.next() else { return Ok(None) };
    let value = text::words(content).next().unwrap_or_default();
    text::whole(value, &format!("a number of {items}"), Place::Cell { row, column: 1 }).map(Some)
}

/// Reads the section of segments, whose ids begin with `base`.
fn read_segments<'a>(rows: &mut impl Iterator<Item = Row<'a>>, plan: &mut PlanTable, base: u32) -> Result<(), Failure> {
    let points = plan.points;
    let promised = section(rows, "segments")?
        .ok_or_else(|| Failure::input("the file ends behind the points: a row with the number of segments follows"))?;
    for number in 0..promised {
        let (row, content) = next(rows, "segments", promised, number as usize)?;
        let mut words = text::words(content);
        let mut ends = [0; 3];
        for (column, value) in (1..).zip(&mut ends) {
            let word = words.next().ok_or_else(|| {
                let count = counted(column - 1, "value");
                Failure::input(format!("row {row} has {count}: a segment is a row 'id a b'"))
            })?;
            *value = text::whole(word, "an id", Place::Cell { row, column })?;
        }
        plan.rings.push([ends[1], ends[2]]);
    }
    let all = || plan.rings.iter().flatten();
    let is_point = |&&end: &&u32| end.checked_sub(base).is_some_and(|index| (index as usize) < points);
    if let Some(end) = all().find(|end| !is_point(end)) {
        let points = counted(points, "point");
        return Err(Failure::input(format!(
            "a segment ends at point {end}, but the ids of the {points} begin at {base}"
        )));
    }
    plan.rings.iter_mut().flatten().for_each(|end| *end -= base);
    Ok(())
}

/// Reads a row `id x y …` of a section. Returns the number of the row, and the value behind.
fn read_mark<'a>(
    rows: &mut impl Iterator<Item = Row<'a>>,
    plan: &mut PlanTable,
    items: &str,
    [promised, number]: [u32; 2],
) -> Result<(usize, Option<&'a [u8]>), Failure> {
    let (row, content) = next(rows, items, promised, number as usize)?;
    let (_, place) = read_point(content, row)?;
    plan.table.push(place, row)?;
    Ok((row, text::words(content).nth(ATTRIBUTE)))
}
