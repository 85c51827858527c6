//! From floating-point values to grid points, in one step that reports what it did.
//!
//! The triangulation itself never rounds. A device takes only points whose lattice fits its grid, so all other values
//! must be laid onto that grid first; the CPU triangulator takes every finite value as it is. [`integers`] takes values
//! that already are grid coordinates and refuses all others; [`quantize`] scales and rounds, and says by how much.
//! Nothing is rounded silently.

use crate::error::Error;
use crate::limit::check_coord_bits;
use incircle_geometry::{Point, MAX_POINTS};

/// The scale by which values are laid onto the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantize {
    /// Scale the bounding box to fill the grid: the longer side spans 0 to 2^`coord_bits` - 1, both axes alike. The
    /// best resolution for one set, but another set gets another scale.
    Fit,
    /// Use a given scale, `grid = round((value - offset) * scale)`, and refuse values that fall outside the grid.
    /// Several sets can share one grid this way.
    Scale {
        /// Grid units per input unit; positive and finite.
        scale: f64,
        /// The input point that falls on the grid's origin.
        offset: [f64; 2],
    },
}

/// Report of a quantisation: `grid = round((value - offset) * scale)`, halves to even.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantization {
    /// Grid units per input unit.
    pub scale: f64,
    /// The input point that falls on the grid's origin.
    pub offset: [f64; 2],
    /// Largest distance along one axis, in input units, between a value and the grid line that it was moved to.
    pub largest_error: f64,
    /// Distinct input points that fell onto another distinct input point.
    pub merged: usize,
    /// Bits of a coordinate of the grid.
    pub coord_bits: u32,
}

impl Quantization {
    /// The input coordinates of a grid point, within `largest_error`.
    pub fn restore(&self, point: Point) -> [f64; 2] {
        [f64::from(point.x) / self.scale + self.offset[0], f64::from(point.y) / self.scale + self.offset[1]]
    }
}

/// Converts values that already are grid coordinates, and refuses all others.
///
/// Use this for data that is known to be integral but comes as floating point, as from a file. O(n).
///
/// ```
/// use incircle::{quantize::integers, Error, Point};
/// assert_eq!(integers(&[[3.0, 255.0]], 8)?, [Point::new(3, 255)]);
/// assert!(matches!(integers(&[[3.5, 0.0]], 8), Err(Error::NotInteger { index: 0, axis: 'x', .. })));
/// # Ok::<(), incircle::Error>(())
/// ```
///
/// # Errors
/// [`Error::NotFinite`] for the first value that is not finite; else [`Error::NotInteger`] for the first one with a
/// fraction; else [`Error::OutOfGrid`] for the first one outside 0 to 2^`coord_bits` - 1. In this order a caller can
/// tell a set that could be quantised from one that is plainly wrong. [`Error::CoordBits`] for bits outside 1 to 31,
/// and [`Error::TooManyPoints`] beyond [`MAX_POINTS`].
pub fn integers(points: &[[f64; 2]], coord_bits: u32) -> Result<Vec<Point>, Error> {
    check_coord_bits(coord_bits)?;
    check_count(points)?;
    check_finite(points)?;
    if let Some((index, axis, value)) = values(points).find(|&(.., value)| value.fract() != 0.0) {
        return Err(Error::NotInteger { index, axis, value });
    }
    let grid = 0.0..=largest_coordinate(coord_bits);
    if let Some((index, axis, value)) = values(points).find(|(.., value)| !grid.contains(value)) {
        return Err(Error::OutOfGrid { index, axis, value, coord_bits });
    }
    Ok(points.iter().map(|&[x, y]| Point::new(x as u32, y as u32)).collect())
}

/// Lays values onto the grid, and reports scale, offset, largest error and how many points fell onto another. The time
/// is O(n log n).
///
/// ```
/// use incircle::quantize::{quantize, Quantize};
/// let (points, report) = quantize(&[[-1.0, 0.5], [1.0, 0.5]], 16, Quantize::Fit)?;
/// assert_eq!((points[0].x, points[1].x), (0, 65535));
/// assert_eq!(report.scale, 65535.0 / 2.0);
/// # Ok::<(), incircle::Error>(())
/// ```
///
/// # Errors
/// - [`Error::NotFinite`] for the first value that is NaN or infinite.
/// - With [`Quantize::Fit`]: [`Error::Extent`] if the bounding box is too large or too small for a scale.
/// - With [`Quantize::Scale`]: [`Error::Scale`] for a scale that is not positive and finite, and [`Error::OutOfGrid`]
///   for the first value that falls outside the grid.
/// - [`Error::CoordBits`] for bits outside 1 to 31, and [`Error::TooManyPoints`] beyond [`MAX_POINTS`].
pub fn quantize(points: &[[f64; 2]], coord_bits: u32, how: Quantize) -> Result<(Vec<Point>, Quantization), Error> {
    check_coord_bits(coord_bits)?;
    check_count(points)?;
    check_finite(points)?;
    let (scale, offset) = match how {
        Quantize::Fit => fit(points, coord_bits)?,
        Quantize::Scale { scale, offset } => check_scale(scale, offset)?,
    };
    let mut report = Quantization { scale, offset, largest_error: 0.0, merged: 0, coord_bits };
    let mut grid = Vec::with_capacity(points.len());
    for (index, point) in points.iter().enumerate() {
        let place = report.place(index, *point, matches!(how, Quantize::Fit))?;
        let back = report.restore(place);
        for (value, back) in point.iter().zip(back) {
            report.largest_error = report.largest_error.max((value - back).abs());
        }
        grid.push(place);
    }
    report.merged = count_merged(points, &grid);
    Ok((grid, report))
}

impl Quantization {
    /// The grid point of `point`. With a fitted scale only rounding can leave the grid, so the result is clamped.
    fn place(&self, index: usize, point: [f64; 2], fitted: bool) -> Result<Point, Error> {
        let max = largest_coordinate(self.coord_bits);
        let line = |k: usize| ((point[k] - self.offset[k]) * self.scale).round_ties_even();
        let (x, y) = (line(0), line(1));
        if fitted {
            return Ok(Point::new(x.clamp(0.0, max) as u32, y.clamp(0.0, max) as u32));
        }
        for (axis, value) in [('x', x), ('y', y)] {
            if !(0.0..=max).contains(&value) {
                return Err(Error::OutOfGrid { index, axis, value, coord_bits: self.coord_bits });
            }
        }
        Ok(Point::new(x as u32, y as u32))
    }
}

/// The largest coordinate of the grid, 2^`coord_bits` - 1.
fn largest_coordinate(coord_bits: u32) -> f64 {
    ((1u64 << coord_bits) - 1) as f64
}

/// Every value with the index of its point and its axis.
fn values(points: &[[f64; 2]]) -> impl Iterator<Item = (usize, char, f64)> + '_ {
    let both = |(index, &[x, y]): (usize, &[f64; 2])| [(index, 'x', x), (index, 'y', y)];
    points.iter().enumerate().flat_map(both)
}

fn check_count(points: &[[f64; 2]]) -> Result<(), Error> {
    if points.len() > MAX_POINTS {
        return Err(Error::TooManyPoints { points: points.len(), max: MAX_POINTS });
    }
    Ok(())
}

pub(crate) fn check_finite(points: &[[f64; 2]]) -> Result<(), Error> {
    match values(points).find(|(.., value)| !value.is_finite()) {
        Some((index, axis, value)) => Err(Error::NotFinite { index, axis, value }),
        None => Ok(()),
    }
}

fn check_scale(scale: f64, offset: [f64; 2]) -> Result<(f64, [f64; 2]), Error> {
    let usable = scale.is_finite() && scale > 0.0 && offset.iter().all(|value| value.is_finite());
    if usable {
        Ok((scale, offset))
    } else {
        Err(Error::Scale { scale, offset })
    }
}

/// Scale and offset that make the bounding box fill the grid. If all points are in one place, the scale is 1.
fn fit(points: &[[f64; 2]], coord_bits: u32) -> Result<(f64, [f64; 2]), Error> {
    let Some(&first) = points.first() else {
        return Ok((1.0, [0.0, 0.0]));
    };
    let (mut low, mut high) = (first, first);
    for point in points {
        for k in 0..2 {
            low[k] = low[k].min(point[k]);
            high[k] = high[k].max(point[k]);
        }
    }
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    if extent == 0.0 {
        return Ok((1.0, low));
    }
    let scale = largest_coordinate(coord_bits) / extent;
    if extent.is_finite() && scale.is_finite() && scale > 0.0 {
        Ok((scale, low))
    } else {
        Err(Error::Extent { extent })
    }
}

/// Number of distinct input points minus the number of distinct grid points.
fn count_merged(points: &[[f64; 2]], grid: &[Point]) -> usize {
    // Bits are compared in place of values. Adding zero turns -0.0 into 0.0, so that equal values have equal bits.
    let bits = |index: u32| points[index as usize].map(|value| (value + 0.0).to_bits());
    let place = |index: u32| grid[index as usize];
    let mut sorted: Vec<u32> = (0..grid.len() as u32).collect();
    sorted.sort_unstable_by_key(|&index| (place(index), bits(index)));
    let merged = |pair: &&[u32]| place(pair[0]) == place(pair[1]) && bits(pair[0]) != bits(pair[1]);
    sorted.windows(2).filter(merged).count()
}
