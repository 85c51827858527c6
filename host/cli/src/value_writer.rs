//! Values at places, written as CSV, as an array of NumPy, or as an ASCII grid.

use std::io::{self, Write};

use npyz::{DType, TypeStr, WriteOptions, WriterBuilder};

use crate::failure::Failure;
use crate::grid::Grid;
use crate::number::Coordinate;
use crate::value_places::ValuePlaces;

/// The digits of the numbers that stand for a place without a value in an ASCII grid. The first is the usual one.
const NINES: std::ops::RangeInclusive<u32> = 4..=15;

/// A value as text; `nan` outside the hull.
fn text(value: f64) -> String {
    if value.is_nan() {
        "nan".to_owned()
    } else {
        Coordinate::Double(value).to_string()
    }
}

/// Writes rows `x,y,value` below that header.
pub fn write_csv(places: &ValuePlaces, values: &[f64], out: &mut dyn Write) -> io::Result<()> {
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

/// A number that stands for a place without a value in an ASCII grid, and that is no value of the grid: -9999, or the
/// first with more nines. Programs that read such grids often take values as single floats, so these are compared.
///
/// # Errors
/// All such numbers are values of the grid.
pub fn no_data(values: &[f64]) -> Result<i64, Failure> {
    let number = |nines: u32| 1 - 10i64.pow(nines);
    let mut free: Vec<i64> = NINES.map(number).collect();
    for &value in values {
        free.retain(|&number| number as f32 != value as f32);
    }
    free.first().copied().ok_or_else(|| {
        Failure::input(format!(
            "all numbers from {} to {} with which an ASCII grid could mark places without a value are values: write \
             .npy or .tif",
            number(*NINES.start()),
            number(*NINES.end())
        ))
    })
}

/// Writes the rows from the highest y on, as the format wants. `no_data` stands where there is no value.
pub fn write_asc(values: &[f64], grid: &Grid, no_data: i64, out: &mut dyn Write) -> io::Result<()> {
    let ([x, y], step) = grid.origin();
    let [columns, rows] = grid.counts;
    let [x, y, step] = [x, y, step].map(Coordinate::Double);
    writeln!(
        out,
        "ncols {columns}\nnrows {rows}\nxllcenter {x}\nyllcenter {y}\ncellsize {step}\nNODATA_value {no_data}"
    )?;
    for row in values.chunks((columns as usize).max(1)).rev() {
        for (column, &value) in row.iter().enumerate() {
            if column > 0 {
                write!(out, " ")?;
            }
            if value.is_nan() {
                write!(out, "{no_data}")?;
            } else {
                write!(out, "{}", Coordinate::Double(value))?;
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_value_is_taken_for_a_missing_one() {
        let no_data = |values: &[f64]| no_data(values).map_err(|failure| failure.message);
        assert_eq!(no_data(&[]), Ok(-9999));
        assert_eq!(no_data(&[1.0, f64::NAN, -99999.0, -9998.0]), Ok(-9999));
        assert_eq!(no_data(&[1.0, -9999.0]), Ok(-99999));
        // As a single float this is -9999, and the next is -999999.
        assert_eq!(no_data(&[-99999.0, -9999.0001, -999999.01]), Ok(-9999999));
        let all: Vec<f64> = (4..=15).map(|nines| 1.0 - 10f64.powi(nines)).collect();
        assert!(no_data(&all).is_err_and(|message| message.contains("from -9999 to -999999999999999 with which")));
    }
}
