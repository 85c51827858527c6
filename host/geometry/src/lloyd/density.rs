//! The density of an image over a clip.

use alloc::vec;
use alloc::vec::Vec;

use crate::point::Point;
use crate::voronoi::Clip;

/// Bits behind the point of places in an image.
pub(super) const PLACE_BITS: u32 = 4;

/// The reasons why there is no density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DensityError {
    /// There is no pixel, or the rows are not full.
    #[error("{weights} pixels do not fill rows of {columns}: give one weight for each pixel of a rectangle")]
    NotFull {
        /// Number of weights.
        weights: usize,
        /// Pixels in a row.
        columns: usize,
    },
    /// All weights are zero.
    #[error("all pixels of the image weigh nothing: give an image with mass")]
    NoMass,
    /// The density was made for a clip with another rectangle around it.
    #[error("the density was made for another clip: make it for the clip of the relaxation")]
    OtherClip,
}

/// How densely mass is spread over a clip: an image of weights, stretched over the smallest rectangle around the clip.
///
/// The density is the weight of the pixel at each place. A border between pixels lies at its exact place, rounded down
/// to 2^-4 of a step. The density takes 18 bytes a pixel.
///
/// ```
/// use core::num::NonZeroUsize;
/// use incircle_geometry::lloyd::{weighted_step, Density};
/// use incircle_geometry::voronoi::Clip;
/// use incircle_geometry::Point;
///
/// let clip = Clip::rectangle(Point::new(0, 0), Point::new(400, 100))?;
/// // The left half of the rectangle weighs three times as much as the right one.
/// let density = Density::over(&clip, 2, &[3, 1])?;
/// assert_eq!(weighted_step(&[Point::new(7, 7)], &clip, &density, NonZeroUsize::MIN)?, [Point::new(150, 50)]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Density {
    bounds: [Point; 2],
    /// The borders of columns and of rows, from the lower left corner on, in 2^-4 of a step. Rows grow upwards.
    pub(super) borders: [Vec<i64>; 2],
    /// Row by row.
    weights: Vec<u16>,
    /// The mass between the left end of each row and each border of a column, for a height of 2^-4 of a step.
    in_rows: Vec<u64>,
    /// The mass between the lower end of each column and each border of a row, column by column.
    in_columns: Vec<u64>,
}

impl Density {
    /// Makes a density of weights: rows of `columns` pixels, the uppermost first, as in images. O(pixels).
    ///
    /// # Errors
    /// There are no full rows, or all weights are zero.
    pub fn over(clip: &Clip, columns: usize, weights: &[u16]) -> Result<Self, DensityError> {
        if columns == 0 || weights.is_empty() || !weights.len().is_multiple_of(columns) {
            return Err(DensityError::NotFull { weights: weights.len(), columns });
        }
        if weights.iter().all(|&weight| weight == 0) {
            return Err(DensityError::NoMass);
        }
        let rows = weights.len() / columns;
        let bounds @ [low, high] = clip.bounds();
        let borders = [cut(high.x - low.x, columns), cut(high.y - low.y, rows)];
        let weights: Vec<u16> = weights.chunks(columns).rev().flatten().copied().collect();
        let mut in_rows = vec![0; (columns + 1) * rows];
        let mut in_columns = vec![0; columns * (rows + 1)];
        for (place, &weight) in weights.iter().enumerate() {
            let (row, column) = (place / columns, place % columns);
            let [width, height] =
                [(0, column), (1, row)].map(|(axis, k)| (borders[axis][k + 1] - borders[axis][k]) as u64);
            let (along, up) = (row * (columns + 1) + column, column * (rows + 1) + row);
            // A side has at most 2^35 parts, and a weight 16 bits.
            in_rows[along + 1] = in_rows[along] + u64::from(weight) * width;
            in_columns[up + 1] = in_columns[up] + u64::from(weight) * height;
        }
        Ok(Self { bounds, borders, weights, in_rows, in_columns })
    }

    /// The lower left and the upper right corner of the rectangle over which the image is stretched.
    pub fn bounds(&self) -> [Point; 2] {
        self.bounds
    }

    /// The mass left of a place in its row, for a height of 2^-4 of a step. The pixel is the one at the place, or one at
    /// whose border the place lies.
    pub(super) fn left_of(&self, x: i64, [column, row]: [usize; 2]) -> i128 {
        let columns = self.borders[0].len() - 1;
        let weight = i128::from(self.weights[row * columns + column]);
        i128::from(self.in_rows[row * (columns + 1) + column]) + weight * i128::from(x - self.borders[0][column])
    }

    /// The mass below a place in its column, for a width of 2^-4 of a step.
    pub(super) fn below(&self, y: i64, [column, row]: [usize; 2]) -> i128 {
        let (columns, rows) = (self.borders[0].len() - 1, self.borders[1].len() - 1);
        let weight = i128::from(self.weights[row * columns + column]);
        i128::from(self.in_columns[column * (rows + 1) + row]) + weight * i128::from(y - self.borders[1][row])
    }
}

/// The borders that cut a length in equal parts.
fn cut(length: u32, parts: usize) -> Vec<i64> {
    let whole = u128::from(length) << PLACE_BITS;
    (0..=parts).map(|part| (part as u128 * whole / parts as u128) as i64).collect()
}
