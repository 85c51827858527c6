//! The place where two constraints cross, as exact fractions.

use core::fmt;

use crate::lattice::{exponent, scaled, Lattice, Step};

/// A fraction in lowest terms. The denominator is positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Fraction {
    /// The number above the line.
    pub numerator: i128,
    /// The number below the line.
    pub denominator: i128,
}

impl Fraction {
    /// The fraction of two numbers. `None` if the second is zero, or if a sign cannot be changed.
    fn new(numerator: i128, denominator: i128) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        let divisor = i128::try_from(greatest_divisor(numerator.unsigned_abs(), denominator.unsigned_abs())).ok()?;
        let (numerator, denominator) = (numerator.checked_div(divisor)?, denominator.checked_div(divisor)?);
        if denominator < 0 {
            return Some(Self { numerator: numerator.checked_neg()?, denominator: denominator.checked_neg()? });
        }
        Some(Self { numerator, denominator })
    }

    /// The fraction times a step; `None` if 128 bits do not hold it.
    fn times(self, step: Step) -> Option<Self> {
        match step {
            Step::Whole => Some(self),
            Step::Binary { exponent } => {
                let power = 2i128.checked_pow(exponent.unsigned_abs())?;
                match exponent < 0 {
                    true => Self::new(self.numerator, self.denominator.checked_mul(power)?),
                    false => Self::new(self.numerator.checked_mul(power)?, self.denominator),
                }
            }
        }
    }

    fn plus(self, whole: i64) -> Option<Self> {
        let more = self.denominator.checked_mul(whole.into())?;
        Self::new(self.numerator.checked_add(more)?, self.denominator)
    }
}

impl fmt::Display for Fraction {
    /// Writes `7/2`, or `3` for a whole number.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.denominator {
            1 => write!(f, "{}", self.numerator),
            denominator => write!(f, "{}/{denominator}", self.numerator),
        }
    }
}

fn greatest_divisor(mut one: u128, mut other: u128) -> u128 {
    while other != 0 {
        (one, other) = (other, one % other);
    }
    one.max(1)
}

/// The place where two constraints cross.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Place {
    /// The exact place.
    Exact([Fraction; 2]),
    /// The place as doubles, where numbers of 128 bits do not hold the exact one.
    About([f64; 2]),
}

impl Eq for Place {}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exact([x, y]) => write!(f, "({x}, {y})"),
            Self::About([x, y]) => write!(f, "about ({}, {})", Shown(*x), Shown(*y)),
        }
    }
}

/// A double as messages show it: with an exponent where its digits would not fit a line.
struct Shown(f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            0.0 => f.write_str("0"),
            value if (1e-7..1e17).contains(&value.abs()) => write!(f, "{value}"),
            value => write!(f, "{value:e}"),
        }
    }
}

impl Place {
    /// The place in the coordinates of points that a lattice brought onto the grid.
    #[must_use]
    pub fn restored(self, lattice: &Lattice) -> Self {
        let Self::Exact([x, y]) = self else { return self };
        let restore = |fraction: Fraction, offset: i64| fraction.plus(offset)?.times(lattice.step);
        match (restore(x, lattice.offset[0]), restore(y, lattice.offset[1])) {
            (Some(x), Some(y)) => Self::Exact([x, y]),
            _ => {
                let length = lattice.step.length();
                let about =
                    |f: Fraction, offset: i64| (f.numerator as f64 / f.denominator as f64 + offset as f64) * length;
                Self::About([about(x, lattice.offset[0]), about(y, lattice.offset[1])])
            }
        }
    }

    /// The crossing of the lines through two pairs of points, whose coordinates are whole numbers divided by `parts`.
    /// `None` if the lines are parallel, `parts` is zero, or numbers of 128 bits do not hold the crossing.
    ///
    /// ```
    /// use incircle_geometry::constraints::Place;
    ///
    /// let place = Place::of_lines([[[0, 0], [30, 30]], [[0, 20], [40, -10]]], 10);
    /// assert_eq!(place.map(|place| place.to_string()), Some("(8/7, 8/7)".to_owned()));
    /// ```
    pub fn of_lines([[a, b], [c, d]]: [[[i128; 2]; 2]; 2], parts: i128) -> Option<Self> {
        let [x, y] = exact([a, b, c, d])?;
        let part = |of: Fraction| Fraction::new(of.numerator, of.denominator.checked_mul(parts)?);
        Some(Self::Exact([part(x)?, part(y)?]))
    }

    /// The crossing of the lines through two pairs of points that are not parallel, given as whole numbers where they
    /// are, and as doubles.
    pub(crate) fn of(ends: [[Option<[i64; 2]>; 2]; 2], rounded: [[[f64; 2]; 2]; 2]) -> Self {
        match ends {
            [[Some(a), Some(b)], [Some(c), Some(d)]] => exact([a, b, c, d].map(|point| point.map(i128::from)))
                .map_or_else(|| Self::About(about(rounded)), Self::Exact),
            _ => Self::About(about(rounded)),
        }
    }
}

/// The crossing of the lines through `a` and `b` and through `c` and `d`.
fn exact([a, b, c, d]: [[i128; 2]; 4]) -> Option<[Fraction; 2]> {
    let vector = |from: [i128; 2], to: [i128; 2]| Some([to[0].checked_sub(from[0])?, to[1].checked_sub(from[1])?]);
    let cross = |u: [i128; 2], v: [i128; 2]| u[0].checked_mul(v[1])?.checked_sub(u[1].checked_mul(v[0])?);
    let (along, other) = (vector(a, b)?, vector(c, d)?);
    let (share, whole) = (cross(vector(a, c)?, other)?, cross(along, other)?);
    let coordinate = |axis: usize| {
        let numerator = a[axis].checked_mul(whole)?.checked_add(share.checked_mul(along[axis])?)?;
        Fraction::new(numerator, whole)
    };
    Some([coordinate(0)?, coordinate(1)?])
}

/// The same in doubles. All numbers are brought near 1 first, so that products neither overflow nor vanish.
fn about(ends: [[[f64; 2]; 2]; 2]) -> [f64; 2] {
    let largest = ends.as_flattened().as_flattened().iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let exponent = exponent(largest);
    let [[a, b], [c, d]] = ends.map(|pair| pair.map(|point| point.map(|value| scaled(value, -exponent))));
    let vector = |from: [f64; 2], to: [f64; 2]| [to[0] - from[0], to[1] - from[1]];
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let (along, other) = (vector(a, b), vector(c, d));
    let share = cross(vector(a, c), other) / cross(along, other);
    // The crossing lies between `a` and `b`. Lines that are nearly parallel lose all digits of the share.
    let share = if share.is_nan() { 0.5 } else { share.clamp(0.0, 1.0) };
    [0, 1].map(|axis| scaled(a[axis] + share * along[axis], exponent))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_are_fractions_in_lowest_terms() {
        let place = Place::of([[Some([0, 0]), Some([3, 3])], [Some([0, 2]), Some([4, -1])]], [[[0.0; 2]; 2]; 2]);
        assert_eq!(place.to_string(), "(8/7, 8/7)");
        let lattice = Lattice::of_doubles(&[[-1.5, 0.25], [1.0, 1.0]]).expect("a lattice").0;
        assert_eq!(place.restored(&lattice).to_string(), "(-17/14, 15/28)");
    }

    #[test]
    fn large_and_small_places_are_told_with_exponents() {
        let told = |x: f64, y: f64| Place::About([x, y]).to_string();
        assert_eq!(told(1e308, -2.5e-300), "about (1e308, -2.5e-300)");
        assert_eq!(told(-0.0, 123456.5), "about (0, 123456.5)");
    }

    #[test]
    fn what_128_bits_do_not_hold_is_rounded() {
        let wide = [[i64::MIN, i64::MIN], [i64::MAX, i64::MAX - 1], [i64::MIN, i64::MAX], [i64::MAX, i64::MIN]];
        let [a, b, c, d] = wide.map(Some);
        let rounded = [a, b, c, d].map(|point| point.unwrap_or_default().map(|value| value as f64));
        let place = Place::of([[a, b], [c, d]], [[rounded[0], rounded[1]], [rounded[2], rounded[3]]]);
        assert!(matches!(place, Place::About([x, y]) if x.abs() < 1e4 && y.abs() < 1e4), "{place}");
    }

    #[test]
    fn crossings_of_the_largest_and_the_smallest_doubles_are_near_the_place() {
        for size in [f64::MAX, 1e200, 1.0, 1e-200, 8.0 * f64::from_bits(1)] {
            let ends = [[[-size, -size], [size, size]], [[-size, size], [size, 0.0]]];
            let [x, y] = about(ends);
            assert!((x / size - 1.0 / 3.0).abs() < 0.1 && x == y, "{size:e}: {x:e} {y:e}");
        }
        // Rounding leaves nothing of the angle between these lines.
        let flat = [[[0.0, 0.0], [1e16, 1.0]], [[0.0, 1e-320], [1e16, 0.0]]];
        let [x, y] = about(flat);
        assert!((0.0..=1e16).contains(&x) && (0.0..=1.0).contains(&y), "{x} {y}");
    }
}
