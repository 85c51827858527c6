//! From the values of a file to points of the grid.

use incircle::quantize::{integers, quantize};
use incircle::{Error, Point, Quantization, Quantize, Shown};

use crate::failure::{failure_of, Failure};
use crate::points::PointTable;

/// A grid, and how points come onto it.
pub struct Grid {
    /// Bits of a coordinate.
    pub coord_bits: u32,
    /// The address of the back end chooses the bits, not `--coord-bits`.
    pub is_addressed: bool,
    /// How points are laid onto the grid, if that is asked for.
    pub quantize: Option<Quantize>,
}

/// Points on the grid, and how they came there.
pub struct Laid {
    /// All points, in input order.
    pub points: Vec<Point>,
    /// What quantisation did; `None` if the values were integers of the grid and are untouched.
    pub quantization: Option<Quantization>,
}

/// Lays points onto the grid. Integers of the grid stay as they are unless quantisation is asked for; values with
/// fractions are fitted; integers outside the grid are refused with their place.
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

/// Library errors that name a point name its place in the file here.
fn refuse(error: &Error, table: &PointTable, grid: &Grid, quantized: bool) -> Failure {
    let Error::OutOfGrid { index, axis, value, coord_bits } = error else {
        return failure_of(error);
    };
    let place = table.place(*index, usize::from(*axis == 'y'));
    let last = (1u64 << coord_bits) - 1;
    let shown = Shown(*value);
    if quantized {
        return Failure::input(format!(
            "{place}: the value falls on {shown}, outside 0 to {last} ({coord_bits} bits): choose another scale or --quantize fit"
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
