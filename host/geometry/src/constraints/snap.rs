//! Snap rounding: constraints that cross get points of a finer grid at their crossings.
//!
//! The grid is made 2^8 times finer. Each of its points is the centre of a *pixel*, the half-open square of side 1
//! around it. A pixel with a point or a crossing inside is *hot*, and a constraint goes through the centre of each hot
//! pixel that it meets. No two of the new constraints then cross, because a constraint that is moved within pixels
//! passes over no hot one (Hobby, *Practical segment intersection with finite precision output*, 1999; Guibas and
//! Marimont, *Rounding arrangements dynamically*, 1998).

use alloc::vec::Vec;

use super::pixels::{Hot, Segment};
use super::sweep::each_crossing;
use crate::lattice::{Lattice, Step};
use crate::point::{Point, MAX_POINTS};

/// The number of bits by which the grid of a snapped set is finer than that of the points.
pub const SNAP_BITS: u32 = 8;
/// The most pairs of constraint and crossing that are kept. They take 512 MiB.
const MOST_CROSSINGS: usize = 1 << 26;

/// The reason why crossings cannot be snapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapError {
    /// The grid cannot be made finer.
    #[error(
        "constraints cross, and the points need {bits} of 32 bits, which leaves {} spare where snapping needs \
         {SNAP_BITS}: round the points to at most {} bits first (--quantize)", 32 - bits, 32 - SNAP_BITS
    )]
    NoRoom {
        /// Bits of the largest coordinate.
        bits: u32,
    },
    /// A constraint names a point that does not exist.
    #[error("constraint {constraint} names point {index}, but the number of points is {points}")]
    OutOfRange {
        /// Number of the constraint.
        constraint: u32,
        /// The index that the constraint names.
        index: u32,
        /// Number of points.
        points: usize,
    },
    /// There would be too many crossings or points.
    #[error(
        "constraints cross more than {MOST_CROSSINGS} times, or lead to more than {MAX_POINTS} points: snap a smaller \
         set of constraints"
    )]
    TooManyCrossings,
}

/// A set whose constraints do not cross.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Snapped {
    /// The points: those of the input in their order, and behind them the new ones in lexicographic order.
    pub points: Vec<Point>,
    /// The number of new points.
    pub new_points: usize,
    /// The constraints, in the order of those of the input that they are parts of, and along these.
    pub constraints: Vec<[u32; 2]>,
    /// The number of the constraint of the input that each is a part of, in rising order.
    pub of: Vec<u32>,
    /// The bits by which the grid is finer than that of the input: [`SNAP_BITS`], or 0 if no constraints cross.
    pub finer_bits: u32,
    /// The largest distance from a point that a constraint was led through to that constraint, in steps of the finer
    /// grid; below 0.708. It is rounded down to a multiple of 2^-20.
    pub largest_displacement: f64,
}

impl Snapped {
    /// The lattice of the snapped points, given that of the points of the input.
    ///
    /// ```
    /// use incircle_geometry::constraints::snap;
    /// use incircle_geometry::lattice::Lattice;
    ///
    /// let doubles = [[0.0, 0.0], [0.5, 1.5], [0.0, 1.0], [1.0, 0.0]];
    /// let (lattice, grid) = Lattice::of_doubles(&doubles).ok_or("no lattice")?;
    /// let snapped = snap(&grid, &[[0, 1], [2, 3]])?;
    /// let finer = snapped.lattice(&lattice);
    /// assert_eq!(finer.restore(snapped.points[1]), [0.5, 1.5]);
    /// assert_eq!(finer.restore(snapped.points[4]), [0.25, 0.75]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn lattice(&self, lattice: &Lattice) -> Lattice {
        let exponent = match lattice.step {
            Step::Whole => 0,
            Step::Binary { exponent } => exponent,
        };
        let step = match self.finer_bits {
            0 => lattice.step,
            finer => Step::Binary { exponent: exponent - finer as i32 },
        };
        let offset = lattice.offset.map(|steps| steps << self.finer_bits);
        Lattice { step, offset, bits: lattice.bits + self.finer_bits }
    }
}

/// Gives constraints that cross points at their crossings, rounded to a grid that is 2^8 times finer.
///
/// If no two constraints cross inside both at a place without a point, the set is returned as it is. Else all
/// coordinates are multiplied by 256, and every constraint is led through the points of the finer grid in whose pixel
/// it meets a point or a crossing. Constraints move by less than 0.708 steps of the finer grid, and may then share
/// edges. If the constraints come in another order, the result is the same, except for the order of the constraints and
/// of their parts.
///
/// O((c + k) log c) to find the crossings, for `c` constraints and points and `k` pairs of constraints that cross; `k`
/// also counts pairs of constraints that cross at a point of the set. If others cross, a grid has about a cell for each
/// point, old or new, and those of its cells that the constraints touch are looked at, too.
///
/// ```
/// use incircle_geometry::constraints::snap;
/// use incircle_geometry::Point;
///
/// let points = [(0, 0), (3, 3), (0, 2), (4, 0)].map(|(x, y)| Point::new(x, y));
/// let snapped = snap(&points, &[[0, 1], [2, 3]])?;
/// // The crossing (4/3, 4/3) is (341.33, 341.33) on the finer grid.
/// assert_eq!((snapped.new_points, snapped.points[4]), (1, Point::new(341, 341)));
/// assert_eq!(snapped.constraints, [[0, 4], [4, 1], [2, 4], [4, 3]]);
/// assert_eq!(snapped.of, [0, 0, 1, 1]);
/// # Ok::<(), incircle_geometry::constraints::SnapError>(())
/// ```
///
/// # Errors
/// A constraint names a point that does not exist; constraints cross and the points need more than 24 bits; or there
/// are too many crossings.
pub fn snap(points: &[Point], constraints: &[[u32; 2]]) -> Result<Snapped, SnapError> {
    let mut segments = Vec::with_capacity(constraints.len());
    for (constraint, ends) in (0..).zip(constraints) {
        let end = |index: u32| {
            let found = points.get(index as usize).copied();
            found.ok_or(SnapError::OutOfRange { constraint, index, points: points.len() })
        };
        segments.push(Segment([end(ends[0])?, end(ends[1])?]));
    }
    let mut places: Vec<Point> = points.to_vec();
    places.sort_unstable();
    places.dedup();
    let pairs = crossing_pairs(&segments, &places)?;
    if pairs.is_empty() {
        let of = (0..constraints.len() as u32).collect();
        let (points, constraints) = (points.to_vec(), constraints.to_vec());
        return Ok(Snapped { points, new_points: 0, constraints, of, finer_bits: 0, largest_displacement: 0.0 });
    }
    snap_pairs(points, constraints, &segments, &pairs)
}

/// Snaps the crossings of these pairs of constraints, of which there are some.
fn snap_pairs(
    points: &[Point],
    constraints: &[[u32; 2]],
    segments: &[Segment],
    pairs: &[[u32; 2]],
) -> Result<Snapped, SnapError> {
    let bits = Lattice::of_grid(points).bits;
    if bits + SNAP_BITS > u32::BITS {
        return Err(SnapError::NoRoom { bits });
    }
    let finer = |point: Point| Point::new(point.x << SNAP_BITS, point.y << SNAP_BITS);
    let segments: Vec<Segment> = segments.iter().map(|segment| Segment(segment.0.map(finer))).collect();
    let mut old: Vec<Point> = points.iter().map(|&point| finer(point)).collect();
    old.sort_unstable();
    let rounded = |&[one, other]: &[u32; 2]| segments[one as usize].pixel(&segments[other as usize]);
    let mut new: Vec<Point> = pairs.iter().map(rounded).filter(|at| old.binary_search(at).is_err()).collect();
    new.sort_unstable();
    new.dedup();
    if points.len() + new.len() > MAX_POINTS {
        return Err(SnapError::TooManyCrossings);
    }
    let all: Vec<Point> = points.iter().map(|&point| finer(point)).chain(new.iter().copied()).collect();
    let mut snapped = Snapped {
        points: all,
        new_points: new.len(),
        constraints: Vec::new(),
        of: Vec::new(),
        finer_bits: SNAP_BITS,
        largest_displacement: 0.0,
    };
    snapped.lead(&segments, constraints);
    Ok(snapped)
}

impl Snapped {
    /// Leads every constraint through the hot pixels that it meets.
    fn lead(&mut self, segments: &[Segment], constraints: &[[u32; 2]]) {
        let hot = Hot::of(&self.points);
        let (mut met, mut largest) = (Vec::new(), 0);
        for ((number, segment), &[from, to]) in (0u32..).zip(segments).zip(constraints) {
            hot.met_by(segment, &mut met);
            let mut last = from;
            for &(place, index) in &met {
                largest = largest.max(segment.distance(place));
                if place != segment.0[0] && place != segment.0[1] {
                    self.constraints.push([last, index]);
                    self.of.push(number);
                    last = index;
                }
            }
            self.constraints.push([last, to]);
            self.of.push(number);
        }
        self.largest_displacement = largest as f64 / (1u32 << 20) as f64;
    }
}

/// The pairs of segments that cross inside both at a place that is none of these, which are sorted. The segments are
/// given by their numbers.
pub(super) fn crossing_pairs(segments: &[Segment], places: &[Point]) -> Result<Vec<[u32; 2]>, SnapError> {
    let is_place =
        |one: &Segment, other: &Segment| one.crossing(other).is_some_and(|place| places.binary_search(&place).is_ok());
    let mut pairs = Vec::new();
    each_crossing(segments, |one, other| {
        // Many constraints may go through one point, so those that meet in points are not kept.
        if !is_place(&segments[one as usize], &segments[other as usize]) {
            if pairs.len() == MOST_CROSSINGS {
                return Err(SnapError::TooManyCrossings);
            }
            pairs.push([one, other]);
        }
        Ok(())
    })?;
    Ok(pairs)
}
