//! The step from the numbers of a file to points of the grid.

use incircle::quantize::{integers, quantize};
use incircle::{Error, Point, Quantization, Quantize, Shown};

use crate::failure::{failure_of, Failure};
use crate::points::PointTable;

/// A grid, and the way in which points are laid onto it.
pub struct Grid {
    /// Bits of a coordinate.
    pub coord_bits: u32,
    /// Whether the address of the back end chose the bits, and not `--coord-bits`.
    pub is_addressed: bool,
    /// The value of `--quantize`, if the user gave one.
    pub quantize: Option<Quantize>,
}

/// Points on the grid, with a record of their quantisation.
pub struct Laid {
    /// All points, in input order.
    pub points: Vec<Point>,
    /// The quantisation that was done; `None` if the values were integers of the grid and are unchanged.
    pub quantization: Option<Quantization>,
}

/// Lays points onto the grid. Without `--quantize` integers of the grid stay as they are, values with fractions are
/// fitted, and integers outside the grid are refused with their place.
pub fn lay(table: &PointTable, grid: &Grid) -> Result<Laid, Failure> {
    let bits = grid.coord_bits;
    let how = match grid.quantize {
        Some(how) => how,
        None => match integers(&table.points, bits) {
            Ok(points) => {
                return Ok(Laid { points, quantization: None });
            }
            Err(Error::NotInteger { .. }) => Quantize::Fit,
            Err(error) => return Err(refuse(&error, table, grid, false)),
        },
    };
    let (points, quantization) =
        quantize(&table.points, bits, how).map_err(|error| refuse(&error, table, grid, true))?;
    Ok(Laid { points, quantization: Some(quantization) })
}

/// Turns an error of the library into a failure that names the place of the point in the file.
fn refuse(error: &Error, table: &PointTable, grid: &Grid, quantized: bool) -> Failure {
    let Error::OutOfGrid { index, axis, value, coord_bits } = error else {
        return failure_of(error);
    };
    let place = table.place(*index, usize::from(*axis == 'y'));
    let last = (1u64 << coord_bits) - 1;
    let shown = Shown(*value);
    if quantized {
        return Failure::input(format!(
            "{place}: the value falls on {shown}, outside 0 to {last} ({coord_bits} bits): \
             choose another scale or --quantize fit"
        ));
    }
    let needed = (*coord_bits..=31).find(|bits| (0.0..=((1u64 << bits) - 1) as f64).contains(value));
    let advice = match needed {
        Some(bits) if grid.is_addressed => format!("give the back end coord-bits={bits} or give --quantize fit"),
        Some(bits) => format!("give --coord-bits {bits} or --quantize fit"),
        None => "give --quantize fit".to_owned(),
    };
    Failure::input(format!("{place}: {shown} is outside 0 to {last} ({coord_bits} bits): {advice}"))
}
