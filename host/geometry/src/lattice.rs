//! The lattice of a point set: whole steps of one length in which all its coordinates are integers.
//!
//! Triangulation in integers of up to 32 bits is the fastest, so a lattice is looked for first: the coordinates are
//! whole numbers, or else multiples of a power of two below 1. A set without a lattice is triangulated on its doubles
//! or long integers, exactly as well.

use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::fmt;

use crate::point::Point;

/// The length of the steps of a [`Lattice`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Step {
    /// Steps of 1: the coordinates are whole numbers.
    Whole,
    /// Steps of `2^exponent`: the coordinates are doubles that share a grid.
    Binary {
        /// The exponent of the step.
        exponent: i32,
    },
}

impl Step {
    /// The length of a step. A power of two beyond the range of doubles is 0 or infinity.
    ///
    /// ```
    /// use incircle_geometry::lattice::Step;
    ///
    /// assert_eq!(Step::Binary { exponent: -1074 }.length(), 5e-324);
    /// ```
    pub fn length(self) -> f64 {
        match self {
            Self::Whole => 1.0,
            Self::Binary { exponent } => scaled(1.0, exponent),
        }
    }
}

impl fmt::Display for Step {
    /// `1` or `2^-20`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => write!(f, "1"),
            Self::Binary { exponent } => write!(f, "2^{exponent}"),
        }
    }
}

/// The lattice of a set of points. A grid point `p` stands for the coordinates `offset + p`, times the step.
///
/// ```
/// use incircle_geometry::lattice::{Lattice, Step};
///
/// let (lattice, grid) = Lattice::of_doubles(&[[-3.0, 0.5], [1.25, 7.0]]).expect("a binary grid");
/// assert_eq!(lattice.step, Step::Binary { exponent: -2 });
/// assert_eq!((lattice.offset, lattice.bits), ([-12, 2], 5));
/// assert_eq!((grid[1].x, grid[1].y), (17, 26));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Lattice {
    /// The length of a step.
    pub step: Step,
    /// The smallest x and the smallest y of the points, in steps; 0 for points that are on the grid already.
    pub offset: [i64; 2],
    /// Bits of the largest coordinate of the grid points, at most 32.
    pub bits: u32,
}

/// The smallest x and y, and the bits of the larger span.
struct Extent {
    offset: [i64; 2],
    bits: u32,
}

impl Extent {
    fn of(points: impl Iterator<Item = [i64; 2]>) -> Self {
        let none = ([i64::MAX; 2], [i64::MIN; 2]);
        let (low, high) =
            points.fold(none, |(low, high), [x, y]| ([low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)]));
        if low[0] > high[0] {
            return Self { offset: [0; 2], bits: 0 };
        }
        let spans = high[0].abs_diff(low[0]) | high[1].abs_diff(low[1]);
        Self { offset: low, bits: u64::BITS - spans.leading_zeros() }
    }
}

impl Lattice {
    /// The lattice of points that are on the grid already.
    pub fn of_grid(points: &[Point]) -> Self {
        let all = points.iter().fold(0, |all, point| all | point.x | point.y);
        Self { step: Step::Whole, offset: [0; 2], bits: u32::BITS - all.leading_zeros() }
    }

    /// The lattice of whole numbers times a step, and the points on it. `None` if a span is 2^32 or more.
    pub fn of_integers(points: &[[i64; 2]], step: Step) -> Option<(Self, Vec<Point>)> {
        let Extent { offset, bits } = Extent::of(points.iter().copied());
        let grid = |&[x, y]: &[i64; 2]| Point::new((x - offset[0]) as u32, (y - offset[1]) as u32);
        (bits <= u32::BITS).then(|| (Self { step, offset, bits }, points.iter().map(grid).collect()))
    }

    /// The lattice of doubles, and the points on it: whole numbers if all are, else multiples of the largest power of
    /// two, which is below 1, of which all are. `None` if a coordinate is infinite or not a number, or 9.2e18 steps or
    /// more in magnitude, or if a span is 2^32 steps or more.
    pub fn of_doubles(points: &[[f64; 2]]) -> Option<(Self, Vec<Point>)> {
        let exponent = least_exponent(points)?;
        let step = if exponent == 0 { Step::Whole } else { Step::Binary { exponent } };
        let whole = |value: f64| {
            let steps = scaled(value, -exponent);
            (steps.abs() < 9.2e18).then_some(steps as i64)
        };
        let points: Option<Vec<[i64; 2]>> = points.iter().map(|&[x, y]| Some([whole(x)?, whole(y)?])).collect();
        Self::of_integers(&points?, step)
    }

    /// The coordinates of a grid point as doubles. Points of the set that the lattice was made of have their
    /// coordinates back, if these were doubles. Coordinates with more than 53 bits are rounded.
    pub fn restore(&self, point: Point) -> [f64; 2] {
        self.steps(point).map(|steps| match self.step {
            Step::Whole => steps as f64,
            Step::Binary { exponent } => scaled(steps as f64, exponent),
        })
    }

    /// The coordinates of a grid point in steps.
    pub fn steps(&self, point: Point) -> [i64; 2] {
        [self.offset[0] + i64::from(point.x), self.offset[1] + i64::from(point.y)]
    }
}

/// The exponent of the largest power of two, at most 1, of which all coordinates are multiples. `None` if a coordinate
/// is infinite or not a number, or as soon as the points read so far have a span of 2^33 multiples or more: most sets
/// without a lattice are recognised by their first points.
fn least_exponent(points: &[[f64; 2]]) -> Option<i32> {
    const POINTS: usize = 256;
    // A lattice has spans below 2^32 steps. Twice that number leaves room for the rounding of the span.
    const STEPS: f64 = (1u64 << 33) as f64;
    let (mut least, mut low, mut high) = (0, [f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for some in points.chunks(POINTS) {
        for &point in some {
            for axis in 0..2 {
                least = least.min(trailing_exponent(point[axis])?);
                (low[axis], high[axis]) = (low[axis].min(point[axis]), high[axis].max(point[axis]));
            }
        }
        if (0..2).any(|axis| scaled(high[axis] - low[axis], -least) >= STEPS) {
            return None;
        }
    }
    Some(least)
}

/// The exponent of the lowest bit that is set in a double; `None` for infinities and what is not a number, the
/// largest exponent for zero.
fn trailing_exponent(value: f64) -> Option<i32> {
    let bits = value.to_bits();
    let (fraction, biased) = (bits & ((1 << 52) - 1), (bits >> 52 & 0x7ff) as i32);
    match (biased, fraction) {
        (0x7ff, _) => None,
        (0, 0) => Some(i32::MAX),
        (0, _) => Some(fraction.trailing_zeros() as i32 - 1074),
        _ => Some((fraction | 1 << 52).trailing_zeros() as i32 + biased - 1075),
    }
}

/// The exponent of the leading bit of a finite double; that of the smallest double for zero.
pub(crate) fn exponent(value: f64) -> i32 {
    let bits = value.abs().to_bits();
    match (bits >> 52) as i32 {
        0 => (bits | 1).ilog2() as i32 - 1074,
        biased => biased - 1023,
    }
}

/// `value * 2^exponent`, exact if a double holds that: a power beyond the range of doubles is the product of two within
/// it.
pub(crate) fn scaled(value: f64, exponent: i32) -> f64 {
    // Beyond these, a product with a number of up to 64 bits is 0 or infinity in any case.
    let exponent = exponent.clamp(-2044, 2046);
    let half = exponent / 2;
    value * power_of_two(half) * power_of_two(exponent - half)
}

/// `2^exponent`, for the exponents of normal doubles, -1022 to 1023.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// A set of points in the numbers in which it is triangulated.
#[derive(Clone, Debug)]
pub enum Numbers<'a> {
    /// Points of the grid.
    Grid(Cow<'a, [Point]>),
    /// Points with whole coordinates of up to 64 bits.
    Whole(Cow<'a, [[i64; 2]]>),
    /// Points with doubles as coordinates, which must be finite.
    Doubles(Cow<'a, [[f64; 2]]>),
}

impl<'a> Numbers<'a> {
    /// Finds the lattice of the points and lays them onto the grid; returns them as they are, and `None`,
    /// if there is none.
    pub fn on_lattice(self) -> (Self, Option<Lattice>) {
        let found = match &self {
            Self::Grid(points) => {
                let lattice = Lattice::of_grid(points);
                return (self, Some(lattice));
            }
            Self::Whole(points) => Lattice::of_integers(points, Step::Whole),
            Self::Doubles(points) => Lattice::of_doubles(points),
        };
        match found {
            Some((lattice, grid)) => (Self::Grid(Cow::Owned(grid)), Some(lattice)),
            None => (self, None),
        }
    }

    /// The first points, at most as many as there are.
    pub(crate) fn first(&self, points: usize) -> Numbers<'_> {
        match self {
            Self::Grid(all) => Numbers::Grid(Cow::Borrowed(&all[..points.min(all.len())])),
            Self::Whole(all) => Numbers::Whole(Cow::Borrowed(&all[..points.min(all.len())])),
            Self::Doubles(all) => Numbers::Doubles(Cow::Borrowed(&all[..points.min(all.len())])),
        }
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        match self {
            Self::Grid(points) => points.len(),
            Self::Whole(points) => points.len(),
            Self::Doubles(points) => points.len(),
        }
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    fn lattice(points: &[[f64; 2]]) -> Option<(Step, [i64; 2], u32)> {
        Lattice::of_doubles(points).map(|(lattice, _)| (lattice.step, lattice.offset, lattice.bits))
    }

    #[test]
    fn the_first_lattice_that_fits_is_found() {
        assert_eq!(lattice(&[]), Some((Step::Whole, [0, 0], 0)));
        assert_eq!(lattice(&[[-363.0, 4.0], [0.0, -0.0]]), Some((Step::Whole, [-363, 0], 9)));
        assert_eq!(lattice(&[[1e18, 0.0], [1e18 + 1024.0, 5.0]]), Some((Step::Whole, [10i64.pow(18), 0], 11)));
        let wide = [[0.0, 0.0], [4_294_967_295.0, 1.0]];
        assert_eq!(lattice(&wide), Some((Step::Whole, [0, 0], 32)));
        assert_eq!(lattice(&[wide[0], [4_294_967_296.0, 1.0]]), None);
        assert_eq!(lattice(&[[0.5, 0.25], [3.0, 1.0]]), Some((Step::Binary { exponent: -2 }, [2, 1], 4)));
        assert_eq!(lattice(&[[5e-324, 0.0], [1.5e-323, 0.0]]), Some((Step::Binary { exponent: -1074 }, [1, 0], 2)));
        assert_eq!(lattice(&[[0.1, 0.0], [1.0, 0.0]]), None);
        assert_eq!(lattice(&[[f64::NAN, 0.0]]), None);
        assert_eq!(lattice(&[[f64::INFINITY, 0.0]]), None);
        assert_eq!(lattice(&[[1e300, 0.0]]), None);
    }

    #[test]
    fn a_span_is_too_wide_wherever_it_shows() {
        // 2^32 steps are too many and 2^32 - 1 are not, whether early or late points show the span or the step.
        for (first, last) in [(0, 999), (999, 0), (0, 1), (500, 501)] {
            for exponent in [-60, -1, 0] {
                let mut points = vec![[scaled(1.0, 8 + exponent), 0.0]; 1000];
                points[first] = [0.0, 0.0];
                points[last] = [scaled(f64::from(u32::MAX), exponent), 0.0];
                let bits = Lattice::of_doubles(&points).map(|(lattice, _)| lattice.bits);
                assert_eq!(bits, Some(32), "{first} {last} {exponent}");
                points[last][0] += scaled(1.0, exponent);
                points[first][1] = scaled(1.0, exponent);
                assert_eq!(lattice(&points), None, "{first} {last} {exponent}");
            }
        }
        let mut points = vec![[0.1, 0.2]; 1000];
        points[0] = [1e300, 0.0];
        points[999] = [f64::NAN, 0.0];
        assert_eq!(lattice(&points), None);
    }

    #[test]
    fn grid_points_restore_the_doubles_they_came_from() {
        let mut random = SplitMix64::new(31);
        for exponent in [-1074, -1040, -30, -3, 0, 20, 900] {
            let value = |random: &mut SplitMix64| scaled((random.below(1 << 31) as f64) - 2f64.powi(30), exponent);
            let points: Vec<[f64; 2]> = (0..50).map(|_| [value(&mut random), value(&mut random)]).collect();
            match Lattice::of_doubles(&points) {
                Some((lattice, grid)) => {
                    let back: Vec<[f64; 2]> = grid.iter().map(|&point| lattice.restore(point)).collect();
                    assert_eq!(back, points);
                }
                None => assert!(exponent > 0, "2^{exponent}"),
            }
        }
    }

    #[test]
    fn steps_of_any_exponent_have_a_length() {
        let length = |exponent| Step::Binary { exponent }.length();
        assert_eq!([0, -1, 1, -1074, 1023].map(length), [1.0, 0.5, 2.0, 5e-324, f64::MAX / (2.0 - f64::EPSILON)]);
        assert_eq!([-1075, i32::MIN].map(length), [0.0; 2]);
        assert_eq!([1024, i32::MAX].map(length), [f64::INFINITY; 2]);
        assert_eq!(Step::Whole.length(), 1.0);
        assert_eq!(Step::Whole.to_string(), "1");
        let lattice = Lattice { step: Step::Binary { exponent: i32::MIN }, offset: [i64::MIN, 0], bits: 1 };
        assert_eq!(lattice.restore(Point::new(0, 1)), [0.0, 0.0]);
        assert_eq!(lattice.step.to_string(), "2^-2147483648");
    }
}
