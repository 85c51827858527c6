//! Points of any kind of numbers, laid with the corners of a clip onto one grid, and the way back.
//!
//! Voronoi cells and Lloyd's relaxation take grid points of at most 31 bits. A [`GridSet`] finds the lattice that the
//! points share with the corners of a clip, and gives coordinates back as the nearest doubles.

use std::borrow::Cow;

use incircle_geometry::lattice::{Lattice, Numbers};
use incircle_geometry::voronoi::{nearest_quotient, Clip, Corner};
use incircle_geometry::{lloyd, voronoi, PlanePoint, Point, MAX_COORD_BITS};

use crate::error::Error;
use crate::quantize::{quantize, Quantization, Quantize};

/// The reasons why points cannot be laid onto the grid, or have no cells.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GridSetError {
    /// The lattice of the points and the corners is too fine for its span.
    #[error(
        "the points and the corners of the clip need {have} bits on their lattice, but {most} are possible: quantise \
         them, which rounds"
    )]
    TooWide {
        /// Bits that the lattice has.
        have: u32,
        /// Bits that are possible.
        most: u32,
    },
    /// The points and the corners lie on no lattice of up to 32 bits.
    #[error(
        "the points and the corners of the clip lie on no lattice of up to 32 bits, but {most} bits are possible: \
         quantise them, which rounds"
    )]
    NoLattice {
        /// Bits that are possible.
        most: u32,
    },
    /// More bits were to be left spare than there are.
    #[error("{spare} spare bits are not possible: leave at most {most}")]
    Spare {
        /// Bits that were asked for.
        spare: u32,
        /// Bits that are possible.
        most: u32,
    },
    /// The rectangle around the points has no area, and no clip was given.
    #[error("the rectangle around the points has no area: give a clip")]
    NoRectangle,
    /// A value is not finite, or the points cannot be quantised.
    #[error(transparent)]
    Points(#[from] Error),
    /// The clip is empty or crosses itself, or there is no diagram.
    #[error(transparent)]
    Cells(#[from] voronoi::Error),
    /// The points cannot be relaxed.
    #[error(transparent)]
    Relaxation(#[from] lloyd::Error),
}

/// Points and the corners of a clip on one grid.
///
/// ```
/// use incircle::lloyd::{relax, Stop};
/// use incircle::GridSet;
///
/// let points = [[0.5, 0.25], [-3.0, 1.0], [2.0, 2.0]];
/// let set = GridSet::of(&points, &[[-4.0, 0.0], [4.0, 4.0]], 8, None)?;
/// let stop = Stop { iterations: 50, when_still: true };
/// let relaxed = relax(set.points().to_vec(), &set.clip()?, stop, std::num::NonZeroUsize::MIN)?;
/// let places: Vec<[f64; 2]> = relaxed.points.iter().map(|&point| set.restore(point)).collect();
/// assert!(places.iter().all(|[x, y]| (-4.0..=4.0).contains(x) && (0.0..=4.0).contains(y)));
/// # Ok::<(), incircle::GridSetError>(())
/// ```
#[derive(Clone, Debug)]
pub struct GridSet {
    points: Vec<Point>,
    corners: Vec<Point>,
    /// The bits by which the grid is finer than the lattice.
    shift: u32,
    origin: Origin,
}

/// The source of the coordinates of the grid: a lattice, or a quantisation.
#[derive(Clone, Debug)]
enum Origin {
    Lattice(Lattice),
    Quantized(Quantization),
}

impl GridSet {
    /// Lays points and the corners of a clip onto one grid of 31 bits: two opposite corners of a rectangle, a ring of
    /// three or more, several rings one behind the other, or none. O(n).
    ///
    /// At least `spare` bits are left for places between the points, as a relaxation needs them: 0 for cells, and 8 or
    /// more for a relaxation. All bits that the lattice leaves are taken if `spare` is not 0. With `how`, the points
    /// are rounded onto a grid with `31 - spare` bits instead of their lattice; [`quantization`](Self::quantization)
    /// says by how much.
    ///
    /// # Errors
    /// A coordinate is not finite, the common lattice leaves too few bits, or the points cannot be quantised.
    pub fn of<P: PlanePoint>(
        points: &[P],
        corners: &[P],
        spare: u32,
        how: Option<Quantize>,
    ) -> Result<Self, GridSetError> {
        if spare >= MAX_COORD_BITS {
            return Err(GridSetError::Spare { spare, most: MAX_COORD_BITS - 1 });
        }
        let (all, most) = ([points, corners].concat(), MAX_COORD_BITS - spare);
        let numbers = P::numbers(&all);
        if let Numbers::Doubles(doubles) = &numbers {
            check_finite(doubles)?;
        }
        let (grid, bits, origin) = match how {
            Some(how) => {
                let (grid, quantization) = quantize(&doubles_of(&numbers), most, how)?;
                (grid, most, Origin::Quantized(quantization))
            }
            None => match numbers.on_lattice() {
                (Numbers::Grid(grid), Some(lattice)) if lattice.bits <= most => {
                    (grid.into_owned(), lattice.bits, Origin::Lattice(lattice))
                }
                (_, Some(lattice)) => return Err(GridSetError::TooWide { have: lattice.bits, most }),
                (_, None) => return Err(GridSetError::NoLattice { most }),
            },
        };
        let shift = if spare == 0 { 0 } else { MAX_COORD_BITS - bits };
        let mut points: Vec<Point> = grid.iter().map(|point| Point::new(point.x << shift, point.y << shift)).collect();
        let corners = points.split_off(all.len() - corners.len());
        Ok(Self { points, corners, shift, origin })
    }

    /// The points on the grid, in their order.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The clip without holes that the corners make, or the smallest rectangle around the points if there are no
    /// corners.
    ///
    /// # Errors
    /// The clip has no area, or crosses or touches itself.
    pub fn clip(&self) -> Result<Clip, GridSetError> {
        match self.corners[..] {
            [] => self.around().ok_or(GridSetError::NoRectangle),
            [one, other] => Ok(Clip::rectangle(one, other)?),
            _ => Ok(Clip::polygon(&self.corners)?),
        }
    }

    /// The polygon with holes that the corners make. `counts` says how many of the corners each ring has: that around
    /// the polygon, then those of the holes.
    ///
    /// ```
    /// use incircle::GridSet;
    ///
    /// let (outer, hole) = ([[0, 0], [9, 0], [9, 9], [0, 9]], [[1, 1], [3, 1], [1, 3]]);
    /// let set = GridSet::of(&[[5, 5]], &[&outer[..], &hole].concat(), 0, None)?;
    /// assert_eq!(set.clip_with_holes(&[4, 3])?.twice_area(), 2 * 81 - 4);
    /// # Ok::<(), incircle::GridSetError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`clip`](Self::clip); the counts do not add up to the number of corners; a hole lies outside the outer
    /// ring or inside another hole.
    pub fn clip_with_holes(&self, counts: &[usize]) -> Result<Clip, GridSetError> {
        Ok(Clip::of_rings(&self.corners, counts)?)
    }

    fn around(&self) -> Option<Clip> {
        let (xs, ys) = (self.points.iter().map(|point| point.x), self.points.iter().map(|point| point.y));
        let low = Point::new(xs.clone().min()?, ys.clone().min()?);
        Clip::rectangle(low, Point::new(xs.max()?, ys.max()?)).ok()
    }

    /// The report of the quantisation, if one was asked for.
    pub fn quantization(&self) -> Option<&Quantization> {
        match &self.origin {
            Origin::Lattice(_) => None,
            Origin::Quantized(quantization) => Some(quantization),
        }
    }

    /// The coordinates of a grid point: those of the caller for a point of the set, to the nearest double.
    pub fn restore(&self, point: Point) -> [f64; 2] {
        self.coordinates(Corner { x: point.x.into(), y: point.y.into(), d: 1 })
    }

    /// The coordinates of an exact corner, each the nearest double. Coordinates of quantised points, and those beyond
    /// 2^63 steps, are rounded more than once.
    pub fn coordinates(&self, corner: Corner) -> [f64; 2] {
        let length = self.length();
        match &self.origin {
            Origin::Lattice(lattice) => [(corner.x, 0), (corner.y, 1)].map(|(numerator, axis)| {
                let offset = i128::from(lattice.offset[axis]) << self.shift;
                let exact = || {
                    let whole = offset.checked_mul(corner.d.into())?.checked_add(numerator)?;
                    nearest_quotient(whole, corner.d.into())
                };
                let steps = exact().unwrap_or_else(|| offset as f64 + numerator as f64 / corner.d as f64);
                steps * length
            }),
            Origin::Quantized(quantization) => {
                let place = corner.nearest();
                [0, 1].map(|axis| place[axis] * length + quantization.offset[axis])
            }
        }
    }

    /// The length of a step of the grid, in the numbers of the caller.
    pub fn length(&self) -> f64 {
        let length = match &self.origin {
            Origin::Lattice(lattice) => lattice.step.length(),
            Origin::Quantized(quantization) => 1.0 / quantization.scale,
        };
        length / f64::from(1u32 << self.shift)
    }
}

fn check_finite(points: &[[f64; 2]]) -> Result<(), Error> {
    for (index, point) in points.iter().enumerate() {
        for (axis, value) in ['x', 'y'].into_iter().zip(*point) {
            if !value.is_finite() {
                return Err(Error::NotFinite { index, axis, value });
            }
        }
    }
    Ok(())
}

/// The doubles nearest to coordinates.
fn doubles_of<'a>(numbers: &'a Numbers<'_>) -> Cow<'a, [[f64; 2]]> {
    match numbers {
        Numbers::Grid(points) => points.iter().map(|point| [point.x.into(), point.y.into()]).collect(),
        Numbers::Whole(points) => points.iter().map(|point| point.map(|value| value as f64)).collect(),
        Numbers::Doubles(points) => Cow::Borrowed(points),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_come_back_in_all_numbers() {
        let doubles = [[-0.75, 3.5], [1e6, -2.25], [0.0, 0.0]];
        let set = GridSet::of(&doubles, &[], 5, None).expect("a lattice of 22 bits");
        let back: Vec<[f64; 2]> = set.points().iter().map(|&point| set.restore(point)).collect();
        assert_eq!((back, set.length()), (doubles.to_vec(), 0.25 / 512.0));
        let far = [[i64::MAX - 3, i64::MIN], [i64::MAX - 4, i64::MIN + 9]];
        let set = GridSet::of(&far, &[], 8, None).expect("a lattice of 4 bits");
        let half = Corner { x: 1, y: 3 << 27, d: 2 << 27 };
        // Whole numbers beyond 2^53 are rounded once.
        assert_eq!(set.coordinates(half), [9_223_372_036_854_775_803i64 as f64, i64::MIN as f64 + 0.0]);
        let set = GridSet::of(&[[1u32, 2]], &[[0, 0], [9, 9]], 0, None).expect("a lattice");
        assert_eq!(set.coordinates(Corner { x: 1, y: 2, d: 3 }), [1.0 / 3.0, 2.0 / 3.0]);
    }

    #[test]
    fn what_has_no_grid_is_refused() {
        let message = |points: &[[f64; 2]], spare| match GridSet::of(points, &[], spare, None) {
            Ok(set) => set.clip().err().map_or_else(String::new, |error| error.to_string()),
            Err(error) => error.to_string(),
        };
        assert!(message(&[[0.1, 0.2], [1.0, 1.0]], 0).contains("on no lattice"));
        assert!(message(&[[0.0, 0.0], [16_777_215.0, 0.0]], 8).contains("need 24 bits on their lattice, but 23 are"));
        assert!(message(&[[0.0, f64::NAN]], 0).contains("the y of point 0 is NaN"));
        assert!(message(&[], 31).contains("31 spare bits are not possible: leave at most 30"));
        assert!(message(&[[1.0, 1.0]], 8).contains("no area: give a clip"));
        assert!(message(&[[1.0, 1.0], [2.0, 3.0]], 8).is_empty());
        let set = GridSet::of(&[[0.1, 0.2], [0.3, 0.7]], &[], 8, Some(Quantize::Fit)).expect("a grid of 23 bits");
        let error = set.quantization().expect("a quantisation").largest_error;
        let [x, y] = set.restore(set.points()[1]);
        assert!((x - 0.3).abs() <= error && (y - 0.7).abs() <= error + 1e-16 && error < 1e-7);
    }
}
