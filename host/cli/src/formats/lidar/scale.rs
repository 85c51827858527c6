//! The coordinates for which the integers of a LAS file stand: `integer * scale + offset`, computed exactly if scale
//! and offset are decimals.

use crate::number::{self, Coordinate, Decimal, Number};
use crate::points::Unit;

use super::header::Header;

/// The most digits behind the point of a scale or an offset. Powers of ten up to this one fit 64 bits.
const MOST_DIGITS: u32 = 18;

/// The rule by which the integers of a file become coordinates.
#[derive(Clone, Debug)]
pub struct Scale {
    scale: [f64; 3],
    offset: [f64; 3],
    plane: Option<Plane>,
    height: Option<Line>,
}

/// The rule by which the integers of x and y become steps of one length: `steps = integer * multiple + start`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plane {
    /// The rule by which the steps become coordinates.
    pub unit: Unit,
    /// The number of steps from one integer to the next, on each axis.
    pub multiple: [i64; 2],
    /// The steps for the integer 0, on each axis.
    pub start: [i64; 2],
}

/// The rule by which the integers of one axis become decimals: `(integer * factor + offset) * 10^-digits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Line {
    factor: i64,
    offset: i64,
    digits: u32,
}

impl Line {
    /// The decimals of an axis, if scale and offset are decimals with few digits.
    fn of(scale: f64, offset: f64) -> Option<Self> {
        let (scale, offset) = (decimal(scale)?, decimal(offset)?);
        let digits = scale.digits.max(offset.digits);
        Self { factor: scale.steps, offset: 0, digits: scale.digits }.in_digits(digits).and_then(|line| {
            let offset = offset.steps.checked_mul(10i64.checked_pow(digits - offset.digits)?)?;
            Some(Self { offset, ..line })
        })
    }

    /// The same decimals with more digits behind the point.
    fn in_digits(self, digits: u32) -> Option<Self> {
        let power = 10i64.checked_pow(digits - self.digits)?;
        let (factor, offset) = (self.factor.checked_mul(power)?, self.offset.checked_mul(power)?);
        Some(Self { factor, offset, digits })
    }
}

/// A double of a header as the shortest decimal that reads as this double.
fn decimal(value: f64) -> Option<Decimal> {
    match number::parse(format!("{value:e}").as_bytes()) {
        Some(Number::Decimal(decimal)) if decimal.digits <= MOST_DIGITS => Some(decimal),
        _ => None,
    }
}

impl Plane {
    /// The steps of x and y, if there is a length of step for both.
    fn of(x: Line, y: Line) -> Option<Self> {
        let digits = x.digits.max(y.digits);
        let (x, y) = (x.in_digits(digits)?, y.in_digits(digits)?);
        let factor = greatest_divisor(x.factor, y.factor);
        let multiple = [x.factor / factor, y.factor / factor];
        // An integer has 32 bits, so with multiples of 31 bits the steps fit 64 bits.
        if multiple.iter().any(|&multiple| multiple > i64::from(i32::MAX)) {
            return None;
        }
        let unit = Unit { digits, factor, offset: [x.offset.into(), y.offset.into()], is_stored: true };
        let plane = Self { unit, multiple, start: [0, 0] };
        let is_near = |offset: i64| offset.unsigned_abs() < 1 << 62;
        if (digits, factor) == (0, 1) && is_near(x.offset) && is_near(y.offset) {
            // For whole numbers the offset becomes a part of the steps, so that the steps are the coordinates.
            let unit = Unit { is_stored: true, ..Unit::of_digits(0) };
            return Some(Self { unit, start: [x.offset, y.offset], ..plane });
        }
        Some(plane)
    }

    /// The steps for an integer on an axis.
    pub fn steps(&self, integer: i32, axis: usize) -> i64 {
        i64::from(integer) * self.multiple[axis] + self.start[axis]
    }
}

/// The greatest common divisor of two positive numbers.
fn greatest_divisor(mut a: i64, mut b: i64) -> i64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

impl Scale {
    /// The coordinates for the integers of a file with this header.
    pub fn of(header: &Header) -> Self {
        let Header { scale, offset, .. } = *header;
        let line = |axis: usize| Line::of(scale[axis], offset[axis]);
        let plane = line(0).zip(line(1)).and_then(|(x, y)| Plane::of(x, y));
        Self { scale, offset, plane, height: line(2) }
    }

    /// The steps of x and y; `None` if they have no common length of step.
    pub fn plane(&self) -> Option<Plane> {
        self.plane
    }

    /// The coordinate for an integer on an axis as a double, by the formula of LAS.
    pub fn double(&self, integer: i32, axis: usize) -> f64 {
        // Adding zero turns minus zero into zero.
        f64::from(integer) * self.scale[axis] + self.offset[axis] + 0.0
    }

    /// The coordinate for an integer on axis 0 or 1.
    pub fn coordinate(&self, integer: i32, axis: usize) -> Coordinate {
        match &self.plane {
            Some(plane) => plane.unit.coordinate(plane.steps(integer, axis), axis),
            None => Coordinate::Double(self.double(integer, axis)),
        }
    }

    /// The height for an integer: the double nearest to the decimal. If scale and offset are no decimals, the formula
    /// of LAS is computed in doubles.
    pub fn height(&self, integer: i32) -> f64 {
        match self.height {
            Some(Line { factor, offset, digits }) => {
                number::nearest(i128::from(integer) * i128::from(factor) + i128::from(offset), digits)
            }
            None => self.double(integer, 2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(x: [f64; 2], y: [f64; 2]) -> Option<Plane> {
        Plane::of(Line::of(x[0], x[1])?, Line::of(y[0], y[1])?)
    }

    #[test]
    fn decimals_have_a_common_step() {
        let common = |digits, factor, offset, multiple, start| {
            Some(Plane { unit: Unit { digits, factor, offset, is_stored: true }, multiple, start })
        };
        let same = plane([0.001, 500_000.0], [0.001, -4_100_000.5]);
        assert_eq!(same, common(3, 1, [500_000_000, -4_100_000_500], [1, 1], [0, 0]));
        assert_eq!(plane([0.25, 0.0], [0.25, 0.0]), common(2, 25, [0, 0], [1, 1], [0, 0]));
        assert_eq!(plane([0.01, 0.0], [0.025, 1.0]), common(3, 5, [0, 1000], [2, 5], [0, 0]));
        assert_eq!(plane([1e-7, 0.0], [1e-7, 0.0]), common(7, 1, [0, 0], [1, 1], [0, 0]));
        // Whole numbers count in steps of 1, whatever their offset.
        assert_eq!(plane([1.0, 7.0], [2.0, -3.0]), common(0, 1, [0, 0], [1, 2], [7, -3]));
        assert_eq!(plane([1e-19, 0.0], [1e-19, 0.0]), None);
        assert_eq!(plane([1.0, 0.0], [1e-12, 0.0]), None);
        assert_eq!(plane([0.001, 1e-30], [0.001, 0.0]), None);
        assert_eq!(plane([1e300, 0.0], [1e300, 0.0]), None);
    }
}
