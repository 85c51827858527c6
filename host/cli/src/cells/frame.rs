//! From exact places on the grid to coordinates in the numbers of the file.
//!
//! A coordinate is `(base + factor * g) * 10^-digits * 2^exponent`, where `g` is the place on the grid, a fraction. The
//! double nearest to it is found by integers, and by the standard library where these would be too long: it rounds any
//! text correctly. Only points that `--quantize` rounded have no such form, and their coordinates are worked out in
//! doubles.

use incircle::voronoi::{nearest_quotient, Corner};
use incircle::Quantization;

use crate::lattice::{Kind, Laid, Numbers};
use crate::number::Coordinate;
use crate::points::PointTable;

/// Digits behind the point after which a text surely names the double nearest to the number: no middle between two
/// doubles has more digits that are not zero.
const ALL_DIGITS: u32 = 1100;
/// Digits behind the point with which rounding usually is certain.
const SOME_DIGITS: u32 = 30;

/// The map from the grid to the coordinates of a file.
pub enum Frame {
    /// Steps of a decimal or of a power of two.
    Steps {
        /// The coordinates of the place at 0, in units of the last digit.
        base: [i128; 2],
        /// The length of a step, in units of the last digit.
        factor: i128,
        /// Digits behind the point.
        digits: u32,
        /// The exponent of the power of two.
        exponent: i32,
    },
    /// A grid onto which points were rounded.
    Quantized(Quantization),
}

/// `value * 2^exponent`, by two factors within the range of doubles.
fn scaled(value: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    value * 2f64.powi(half) * 2f64.powi(exponent - half)
}

impl Frame {
    /// The map of points that lie on a lattice; `None` if they lie on none.
    pub fn of(table: &PointTable, laid: &Laid<'_>) -> Option<Self> {
        let Numbers::Grid(grid) = &laid.numbers else { return None };
        let (factor, digits, exponent) = match &laid.kind {
            Kind::Quantized(quantization) => return Some(Self::Quantized(*quantization)),
            Kind::Whole => (1, 0, 0),
            &Kind::Decimal(factor, exponent @ ..=0) => (i128::from(factor), exponent.unsigned_abs(), 0),
            &Kind::Decimal(factor, exponent) => (i128::from(factor) * 10i128.pow(exponent.unsigned_abs()), 0, 0),
            &Kind::Binary(exponent) => (1, 0, exponent),
            Kind::Doubles(_) => return None,
        };
        let base = |axis: usize| {
            let first = grid.first().map_or([0, 0], |point| [point.x, point.y])[axis];
            let last_digits = match table.coordinate(0, axis) {
                Coordinate::Decimal { steps, digits: own } if exponent == 0 && own <= digits => {
                    steps * 10i128.pow(digits - own)
                }
                // Points have a power of two as their step only if each coordinate is a double, so this rounds nothing.
                Coordinate::Decimal { steps, digits: own } => {
                    scaled(crate::number::nearest(steps, own), -exponent) as i128
                }
                // A whole number of steps, below 2^63.
                Coordinate::Double(value) => scaled(value, -exponent) as i128,
            };
            last_digits - factor * i128::from(first)
        };
        Some(Self::Steps { base: [base(0), base(1)], factor, digits, exponent })
    }

    /// The doubles nearest to the coordinates of a place. They are rounded once, except after `--quantize`, and for
    /// coordinates beyond 10^27 steps.
    pub fn coordinates(&self, corner: Corner) -> [f64; 2] {
        match self {
            Self::Quantized(quantization) => {
                let [x, y] = corner.nearest();
                let (scale, offset) = (quantization.scale, quantization.offset);
                [x / scale + offset[0], y / scale + offset[1]]
            }
            &Self::Steps { base, factor, digits, exponent } => {
                let value =
                    |numerator, axis: usize| scaled(rounded(numerator, corner.d, base[axis], factor, digits), exponent);
                [value(corner.x, 0), value(corner.y, 1)]
            }
        }
    }

    /// The length of a step.
    pub fn step(&self) -> f64 {
        match self {
            Self::Quantized(quantization) => 1.0 / quantization.scale,
            &Self::Steps { factor, digits, exponent, .. } => scaled(crate::number::nearest(factor, digits), exponent),
        }
    }
}

/// The double nearest to `(base + factor * numerator / d) * 10^-digits`.
fn rounded(numerator: i128, d: u64, base: i128, factor: i128, digits: u32) -> f64 {
    let wide = i128::from(d);
    let (quotient, rest) = (numerator.div_euclid(wide), numerator.rem_euclid(wide));
    let exact = || {
        // The rest is below 2^64 and the factor below 2^63.
        let rest = factor.checked_mul(rest)?;
        let whole = factor.checked_mul(quotient)?.checked_add(base)?.checked_add(rest.div_euclid(wide))?;
        Some((whole, rest.rem_euclid(wide)))
    };
    let Some((whole, rest)) = exact() else {
        let steps = numerator as f64 / d as f64 * factor as f64 + base as f64;
        return steps / 10f64.powi(digits as i32);
    };
    let short = || {
        let denominator = 10u128.checked_pow(digits)?.checked_mul(d.into())?;
        nearest_quotient(whole.checked_mul(wide)?.checked_add(rest)?, denominator)
    };
    short().unwrap_or_else(|| by_text(whole, rest, wide, digits))
}

/// The double nearest to `(whole + rest / d) * 10^-digits`, where `rest` is at least 0 and less than `d`.
fn by_text(whole: i128, rest: i128, d: i128, digits: u32) -> f64 {
    // A negative number is its magnitude, negated.
    let is_negative = whole < 0;
    let (whole, rest) = match (is_negative, rest) {
        (true, 0) => (-whole, 0),
        (true, _) => (-whole - 1, d - rest),
        (false, _) => (whole, rest),
    };
    let read = |text: &str, end: &str| format!("{text}{end}e-{digits}").parse().unwrap_or(0.0);
    let (some, remainder) = expanded(whole, rest, d, SOME_DIGITS);
    let (low, high): (f64, f64) = (read(&some, ""), read(&some, "9999"));
    let size = if remainder == 0 || low == high {
        low
    } else {
        let (all, remainder) = expanded(whole, rest, d, ALL_DIGITS + digits);
        read(&all, if remainder == 0 { "" } else { "1" })
    };
    if is_negative {
        -size
    } else {
        size
    }
}

/// The decimal digits of `whole + rest / d`, with the given number of digits behind the point, and the remainder.
fn expanded(whole: i128, mut rest: i128, d: i128, digits: u32) -> (String, i128) {
    let mut text = format!("{whole}.");
    for _ in 0..digits {
        // The denominator has 64 bits.
        rest *= 10;
        text.push(char::from(b'0' + (rest / d) as u8));
        rest %= d;
    }
    (text, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_rounded_once() {
        // A third of a step of 0.000001, beside -0.1.
        assert_eq!(rounded(1, 3, -100_000, 1, 6), -0.099_999_666_666_666_67);
        assert_eq!(rounded(-1, 3, 0, 1, 0), -1.0 / 3.0);
        assert_eq!(rounded(1, 2, 0, 25, 5), 0.000_125);
        // The long way gives what the short way gives, and halves go to the even double.
        for (whole, rest, d, digits) in [(5, 1, 3, 2), (-7, 2, 9, 0), (-1, 1, 7, 1), (0, 5, 11, 3)] {
            let short = nearest_quotient(whole * d + rest, 10u128.pow(digits) * d as u128);
            assert_eq!(Some(by_text(whole, rest, d, digits)), short);
        }
        let half = (1i128 << 53) + 1;
        assert_eq!(by_text(half, 0, 1, 0), (1u64 << 53) as f64);
        assert_eq!(by_text(half, 1, u64::MAX.into(), 0), ((1u64 << 53) + 2) as f64);
        assert_eq!(by_text(-half, 0, 1, 0), -((1u64 << 53) as f64));
    }
}
