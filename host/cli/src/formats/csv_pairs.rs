//! Constraints as comma-separated values: rows `a,b` of two point indices, counted from 0.
//!
//! A first row of two values without a number is a header. A file without a constraint is refused, because a mesh
//! without the edges that somebody asked for looks like any other.

use crate::failure::{counted, quoted, Failure};
use crate::formats::csv_rows::{CsvRows, Values};
use crate::points::Place;
use crate::text;

/// Reads pairs of indices of points, of which there are `points`.
pub fn read_pairs(bytes: &[u8], points: usize) -> Result<Vec<[u32; 2]>, Failure> {
    let mut rows = CsvRows::new(text::without_mark(bytes)?);
    let (mut pairs, mut header) = (Vec::new(), None);
    while let Some((row, values)) = rows.next()? {
        let is_first = pairs.is_empty() && header.is_none();
        if is_first && values.len() == 2 && !values.iter().any(text::looks_like_number) {
            header = Some((row, [values.get(0), values.get(1)].map(quoted)));
            continue;
        }
        pairs.push(pair_of(&values, row, points)?);
    }
    const DUE: &str = "a constraint is a row of two point indices, counted from 0, such as '0,1'";
    match header {
        _ if !pairs.is_empty() => Ok(pairs),
        None => Err(Failure::input(format!("the file has no constraint: {DUE}"))),
        Some((row, [one, other])) => Err(Failure::input(format!(
            "the file has no constraint: row {row}, {one} and {other}, has no number, and no row follows: {DUE}"
        ))),
    }
}

fn pair_of(values: &Values<'_>, row: usize, points: usize) -> Result<[u32; 2], Failure> {
    if values.len() != 2 {
        let columns = counted(values.len(), "column");
        return Err(Failure::input(format!("row {row} has {columns}: a constraint is a row of two point indices")));
    }
    let mut pair = [0; 2];
    for (column, end) in pair.iter_mut().enumerate() {
        *end = text::whole(values.get(column), "a point index", Place::Cell { row, column: column + 1 })?;
        if *end as usize >= points {
            let points = counted(points, "point");
            return Err(Failure::input(format!(
                "row {row}, column {}: the point {end} does not exist: the set has {points}, counted from 0",
                column + 1
            )));
        }
    }
    Ok(pair)
}
