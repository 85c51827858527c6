//! Values at places, written as CSV, as an array of NumPy, or as an ASCII grid.

use std::io::{self, Write};

use npyz::{DType, TypeStr, WriteOptions, WriterBuilder};

use crate::grid::Grid;
use crate::number::Coordinate;
use crate::points::PointTable;

/// The value of a place without one in an ASCII grid.
const NO_DATA: &str = "-9999";

/// A value as text; `nan` outside the hull.
fn text(value: f64) -> String {
    if value.is_nan() {
        "nan".to_owned()
    } else {
        Coordinate::Double(value).to_string()
    }
}

/// Writes rows `x,y,value` below that header.
pub fn write_csv(places: &PointTable, values: &[f64], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "x,y,value")?;
    for (index, &value) in values.iter().enumerate() {
        let [x, y] = [0, 1].map(|axis| places.coordinate(index, axis));
        writeln!(out, "{x},{y},{}", text(value))?;
    }
    Ok(())
}

/// Writes an array of the values, with a row for each row of a grid.
pub fn write_npy(values: &[f64], grid: Option<&Grid>, out: &mut dyn Write) -> io::Result<()> {
    let item: TypeStr = "<f8".parse().map_err(io::Error::other)?;
    let shape = grid.map_or(vec![values.len() as u64], |grid| vec![grid.counts[1], grid.counts[0]]);
    let mut array = WriteOptions::new().dtype(DType::Plain(item)).shape(&shape).writer(out).begin_nd()?;
    array.extend(values.iter().copied())?;
    array.finish()
}

/// Writes the rows from the highest y on, as the format wants.
pub fn write_asc(values: &[f64], grid: &Grid, out: &mut dyn Write) -> io::Result<()> {
    let ([x, y], step) = grid.origin();
    let [columns, rows] = grid.counts;
    let [x, y, step] = [x, y, step].map(Coordinate::Double);
    writeln!(
        out,
        "ncols {columns}\nnrows {rows}\nxllcenter {x}\nyllcenter {y}\ncellsize {step}\nNODATA_value {NO_DATA}"
    )?;
    for row in values.chunks((columns as usize).max(1)).rev() {
        let value = |&value: &f64| if value.is_nan() { NO_DATA.to_owned() } else { text(value) };
        let texts: Vec<String> = row.iter().map(value).collect();
        writeln!(out, "{}", texts.join(" "))?;
    }
    Ok(())
}
