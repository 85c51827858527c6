//! The airports of the world, thinned to a given number.

use incircle::quantize::{quantize, Quantize};
use incircle::Point;

use super::{MeasureError, BITS};

const FILE: &str = include_str!("../../data/airports.csv");

/// Returns `n` airports, evenly spread over the list, scaled to the grid.
///
/// # Errors
/// A line of the list is malformed.
pub fn thinned_airports(n: usize) -> Result<Vec<Point>, MeasureError> {
    let lines: Vec<&str> = FILE.lines().skip(1).collect();
    let places = (0..n).map(|index| index * lines.len() / n);
    let values = places.map(|place| {
        let mut cells = lines[place].split(',').map(str::parse);
        match (cells.next(), cells.next()) {
            (Some(Ok(x)), Some(Ok(y))) => Ok([x, y]),
            _ => Err(MeasureError::Airport(place + 2)),
        }
    });
    let values: Vec<[f64; 2]> = values.collect::<Result<_, _>>()?;
    Ok(quantize(&values, BITS, Quantize::Fit)?.0)
}
