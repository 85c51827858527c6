//! The coordinates of the points of a file: in exact steps if these fit 64 bits, else in doubles.

use std::borrow::Cow;

use crate::number::{self, Coordinate, Decimal, Number};

/// The rule by which steps become coordinates: `(steps * factor + offset) * 10^-digits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Digits behind the point.
    pub digits: u32,
    /// The length of a step, in units of the last digit; positive.
    pub factor: i64,
    /// The coordinates of the place at step 0, in units of the last digit.
    pub offset: [i128; 2],
    /// Whether the file stores the steps as integers. The steps of a text are made of its decimals.
    pub is_stored: bool,
}

impl Unit {
    /// The unit of decimals with `digits` digits behind the point.
    pub fn of_digits(digits: u32) -> Self {
        Self { digits, factor: 1, offset: [0; 2], is_stored: false }
    }

    /// Whether steps are whole numbers.
    pub fn is_whole(&self) -> bool {
        Self { is_stored: false, ..*self } == Self::of_digits(0)
    }

    /// The coordinate for a number of steps on an axis.
    pub fn coordinate(&self, steps: i64, axis: usize) -> Coordinate {
        let (steps, digits) = self.decimal(steps, axis);
        Coordinate::Decimal { steps, digits }
    }

    /// The double nearest to the coordinate for a number of steps on an axis.
    pub fn nearest(&self, steps: i64, axis: usize) -> f64 {
        let (steps, digits) = self.decimal(steps, axis);
        number::nearest(steps, digits)
    }

    /// The coordinate of a step on an axis, in the last digit, and its digits behind the point.
    fn decimal(&self, steps: i64, axis: usize) -> (i128, u32) {
        (i128::from(steps) * i128::from(self.factor) + self.offset[axis], self.digits)
    }
}

/// The coordinates of all points of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Coordinates {
    /// Whole numbers of steps of one length: whole numbers, decimals as written, or the integers of a scanner.
    Steps {
        /// The coordinates of each point, in steps.
        steps: Vec<[i64; 2]>,
        /// The rule by which the steps become coordinates.
        unit: Unit,
    },
    /// Doubles.
    Doubles(Vec<[f64; 2]>),
}

/// Makes an empty list of steps, which are whole numbers.
impl Default for Coordinates {
    fn default() -> Self {
        Self::Steps { steps: Vec::new(), unit: Unit::of_digits(0) }
    }
}

impl Coordinates {
    /// The number of points.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Steps { steps, .. } => steps.len(),
            Self::Doubles(points) => points.len(),
        }
    }

    /// The coordinates of the points at these indices, which must exist.
    pub(super) fn select(&self, indices: &[u32]) -> Self {
        match self {
            Self::Steps { steps, unit } => Self::Steps { steps: chosen(steps, indices), unit: *unit },
            Self::Doubles(points) => Self::Doubles(chosen(points, indices)),
        }
    }

    /// Adds a point as it is written. The coordinates stay exact as long as all are decimals whose steps of one common
    /// length fit 64 bits. Otherwise all coordinates become the nearest doubles. Returns how many coordinates were
    /// rounded, earlier ones included.
    pub fn push(&mut self, point: [Number; 2]) -> usize {
        if let [Number::Decimal(x), Number::Decimal(y)] = point {
            if self.push_decimals(x, y).is_some() {
                return 0;
            }
        }
        let point = point.map(Number::nearest);
        let rounded = point.iter().filter(|nearest| !nearest.is_exact).count();
        rounded + self.push_doubles(point.map(|nearest| nearest.value))
    }

    /// Adds a point of doubles. All earlier coordinates become doubles, too; returns how many of them were rounded.
    pub fn push_doubles(&mut self, point: [f64; 2]) -> usize {
        let mut rounded = 0;
        if let Self::Steps { .. } = self {
            rounded = self.count_no_doubles();
            *self = Self::Doubles(self.doubles().into_owned());
        }
        if let Self::Doubles(points) = self {
            // Adding zero turns minus zero into zero.
            points.push(point.map(|value| value + 0.0));
        }
        rounded
    }

    /// The number of coordinates that are no doubles.
    pub fn count_no_doubles(&self) -> usize {
        match self {
            Self::Steps { steps, unit } => steps
                .iter()
                .flat_map(|point| [0, 1].map(|axis| unit.decimal(point[axis], axis)))
                .filter(|&(steps, digits)| !number::is_double(steps, digits))
                .count(),
            Self::Doubles(_) => 0,
        }
    }

    /// Adds the points of another list. They stay exact as in [`push`](Self::push); returns how many coordinates were
    /// rounded, earlier ones included.
    pub fn append(&mut self, other: Self) -> usize {
        match (self, other) {
            (own, other) if own.len() == 0 => {
                *own = other;
                0
            }
            (Self::Steps { steps, unit }, Self::Steps { steps: more, unit: same }) if *unit == same => {
                steps.extend(more);
                0
            }
            (own, Self::Doubles(points)) => points.into_iter().map(|point| own.push_doubles(point)).sum(),
            (own, Self::Steps { steps, unit }) => {
                own.make_decimal();
                let number = |steps: i64, axis: usize| {
                    let (steps, digits) = unit.decimal(steps, axis);
                    Number::of_decimal(steps, digits)
                };
                steps.into_iter().map(|[x, y]| own.push([number(x, 0), number(y, 1)])).sum()
            }
        }
    }

    /// Counts the steps in units of the last digit, from zero on. If those do not fit 64 bits, the coordinates become
    /// the nearest doubles.
    fn make_decimal(&mut self) {
        let Self::Steps { steps, unit } = self else { return };
        let fits = steps
            .iter_mut()
            .all(|point| [0, 1].into_iter().all(|axis| i64::try_from(unit.decimal(point[axis], axis).0).is_ok()));
        if !fits {
            *self = Self::Doubles(self.doubles().into_owned());
            return;
        }
        for point in steps {
            *point = [0, 1].map(|axis| unit.decimal(point[axis], axis).0 as i64);
        }
        *unit = Unit::of_digits(unit.digits);
    }

    /// Adds a point of decimals; `None` if the steps of any point would not fit 64 bits.
    fn push_decimals(&mut self, x: Decimal, y: Decimal) -> Option<()> {
        let Self::Steps { steps, unit } = self else {
            return None;
        };
        let digits = x.digits.max(y.digits);
        if digits > unit.digits {
            let power = 10i64.checked_pow(digits - unit.digits);
            let fits = |value: i64| value == 0 || power.is_some_and(|power| value.checked_mul(power).is_some());
            if !steps.iter().flatten().all(|&value| fits(value)) {
                return None;
            }
            let power = power.unwrap_or(0);
            steps.iter_mut().flatten().for_each(|value| *value *= power);
            unit.digits = digits;
        }
        let scaled = |decimal: Decimal| match decimal.digits {
            digits if digits == unit.digits || decimal.steps == 0 => Some(decimal.steps),
            digits => decimal.steps.checked_mul(10i64.checked_pow(unit.digits - digits)?),
        };
        steps.push([scaled(x)?, scaled(y)?]);
        Some(())
    }

    /// The doubles that are nearest to the coordinates.
    pub fn doubles(&self) -> Cow<'_, [[f64; 2]]> {
        match self {
            Self::Steps { steps, unit } => {
                Cow::Owned(steps.iter().map(|&[x, y]| [unit.nearest(x, 0), unit.nearest(y, 1)]).collect())
            }
            Self::Doubles(points) => Cow::Borrowed(points),
        }
    }

    /// The coordinate of the point at `index` on an axis, in the numbers of the file; zero if there is no such point.
    pub fn coordinate(&self, index: usize, axis: usize) -> Coordinate {
        match self {
            Self::Steps { steps, unit } => unit.coordinate(steps.get(index).map_or(0, |point| point[axis]), axis),
            Self::Doubles(points) => Coordinate::Double(points.get(index).map_or(0.0, |point| point[axis])),
        }
    }
}

/// The items at these indices, which must exist.
pub fn chosen<T: Copy>(items: &[T], indices: &[u32]) -> Vec<T> {
    indices.iter().map(|&index| items[index as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(points: &[[&str; 2]]) -> Coordinates {
        let mut all = Coordinates::default();
        for point in points {
            all.push(point.map(|text| number::parse(text.as_bytes()).expect("a number")));
        }
        all
    }

    #[test]
    fn one_power_of_ten_makes_decimals_whole() {
        let all = read(&[["1", "-2.5"], ["0.125", "3"]]);
        let unit = Unit::of_digits(3);
        assert_eq!(all, Coordinates::Steps { steps: vec![[1000, -2500], [125, 3000]], unit });
        assert_eq!(all.coordinate(0, 1).to_string(), "-2.5");
        assert_eq!(all.doubles()[1], [0.125, 3.0]);
    }

    #[test]
    fn numbers_without_a_common_step_become_doubles() {
        let all = read(&[["9007199254740993", "-0"], ["1e-10", "0.1"]]);
        assert_eq!(all, Coordinates::Doubles(vec![[9_007_199_254_740_992.0, 0.0], [1e-10, 0.1]]));
        let all = read(&[["0.1", "0"], ["1e300", "9223372036854775807"]]);
        assert_eq!(all, Coordinates::Doubles(vec![[0.1, 0.0], [1e300, 9.223_372_036_854_776e18]]));
        // Zeros have every step.
        let all = read(&[["0", "0"], ["1e-30", "2e-29"]]);
        assert_eq!(all, Coordinates::Steps { steps: vec![[0, 0], [1, 20]], unit: Unit::of_digits(30) });
    }
}
