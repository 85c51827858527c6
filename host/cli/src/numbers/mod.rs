//! The numbers in which a generated set is written.
//!
//! A set is made on the grid from 0 to 2^bits - 1. Each kind of numbers turns the points of that grid into coordinates,
//! by exact steps or by operations that IEEE 754 rounds correctly, so every machine writes the same bytes.

pub mod doubles;

use std::fmt;

use clap::ValueEnum;

use crate::failure::Failure;
use crate::formats::npy_writer::Stored;
use crate::number::Coordinate;

/// Digits behind the point of decimals.
const DECIMAL_DIGITS: usize = 6;
/// Steps of a decimal in a unit.
const STEPS_OF_DECIMALS: u32 = 1_000_000;
/// Bits of the mantissa of an f32, the hidden one included.
const SINGLE_BITS: u32 = f32::MANTISSA_DIGITS;

/// The kinds of numbers that sets are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum NumberKind {
    /// Whole numbers from 0 to 2^BITS - 1
    Whole,
    /// The points of 'whole', moved: from -2^(BITS-1) to 2^(BITS-1) - 1
    Signed,
    /// Decimals with six digits: the numbers of 'signed' in steps of 0.000001
    Decimal,
    /// Doubles between -1 and 1 with mantissas of 53 bits
    Double,
    /// Numbers that are exactly an f32: 'signed' in steps of 2^-(BITS-1), from -1 to 1
    F32,
}

impl NumberKind {
    /// The bits of the grid on which a set is made: `chosen`, or else the default of the kind of numbers.
    pub fn bits(self, chosen: Option<u32>) -> Result<u32, Failure> {
        match (self, chosen) {
            (Self::Double, Some(bits)) => Err(Failure::usage(format!(
                "--bits {bits} counts the steps of a grid, and --numbers double has no steps: leave --bits out, or \
                 choose other --numbers"
            ))),
            (Self::F32, Some(bits)) if bits > SINGLE_BITS => Err(Failure::usage(format!(
                "--bits {bits} is more than the {SINGLE_BITS} bits of an f32: give --bits {SINGLE_BITS} or fewer, or \
                 choose --numbers double"
            ))),
            (_, Some(bits)) => Ok(bits),
            (Self::Whole | Self::Signed, None) => Ok(16),
            // From -134.217728 to 134.217727, about the size of longitudes.
            (Self::Decimal, None) => Ok(28),
            (Self::F32, None) => Ok(SINGLE_BITS),
            (Self::Double, None) => Ok(doubles::GRID_BITS),
        }
    }
}

/// The point, moved so that the middle of the grid of `bits` bits is at 0.
pub fn signed(point: [u32; 2], bits: u32) -> [i32; 2] {
    let middle = 1i64 << (bits - 1);
    point.map(|value| (i64::from(value) - middle) as i32)
}

/// A decimal with six digits behind the point, in steps of 0.000001.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SixDigits(pub i32);

impl fmt::Display for SixDigits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let steps = self.0.unsigned_abs();
        let (whole, fraction) = (steps / STEPS_OF_DECIMALS, steps % STEPS_OF_DECIMALS);
        write_digits(f, self.0 < 0, whole, fraction.into(), DECIMAL_DIGITS)
    }
}

impl Stored for SixDigits {
    type Value = f64;

    /// The double that is nearest to the decimal. Both operands are exact, so the quotient is rounded once.
    fn stored(self) -> f64 {
        f64::from(self.0) / f64::from(STEPS_OF_DECIMALS)
    }
}

/// Writes a decimal with `digits` digits behind the point, and without a point if `digits` is 0.
fn write_digits(
    f: &mut fmt::Formatter<'_>,
    is_negative: bool,
    whole: u32,
    fraction: u128,
    digits: usize,
) -> fmt::Result {
    let sign = if is_negative { "-" } else { "" };
    match digits {
        0 => write!(f, "{sign}{whole}"),
        _ => write!(f, "{sign}{whole}.{fraction:0digits$}"),
    }
}

/// A double, written in the fewest digits that tell it from all others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double(pub f64);

impl fmt::Display for Double {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Coordinate::Double(self.0).fmt(f)
    }
}

impl Stored for Double {
    type Value = f64;

    fn stored(self) -> f64 {
        self.0
    }
}

/// A number that is exactly an f32, written with all its digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Single {
    steps: i32,
    /// The exponent of a step 2^-digits, which is also the number of digits that a step has behind the point.
    digits: u32,
}

impl Single {
    /// The number that lies `steps` steps from the middle of a grid of `bits` bits, at most 24. The grid goes from -1
    /// to 1.
    pub fn new(steps: i32, bits: u32) -> Self {
        Self { steps, digits: bits - 1 }
    }
}

impl fmt::Display for Single {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = 1 << self.digits;
        let steps = self.steps.unsigned_abs();
        // 2^-digits is 5^digits * 10^-digits.
        let fraction = u128::from(steps % unit) * 5u128.pow(self.digits);
        write_digits(f, self.steps < 0, steps / unit, fraction, self.digits as usize)
    }
}

impl Stored for Single {
    type Value = f32;

    /// Both operands are exact, and the divisor is a power of two, so the quotient is exact.
    fn stored(self) -> f32 {
        self.steps as f32 / (1u32 << self.digits) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_the_grid_is_at_zero() {
        assert_eq!(signed([0, 255], 8), [-128, 127]);
        assert_eq!(signed([0, 1], 1), [-1, 0]);
        assert_eq!(signed([0, (1 << 31) - 1], 31), [-(1 << 30), (1 << 30) - 1]);
    }

    #[test]
    fn decimals_have_six_digits() {
        for (steps, text) in
            [(-101_473_911, "-101.473911"), (-1, "-0.000001"), (0, "0.000000"), (1_000_000, "1.000000")]
        {
            assert_eq!(SixDigits(steps).to_string(), text);
            assert_eq!(Ok(SixDigits(steps).stored()), text.parse());
        }
    }

    #[test]
    fn singles_are_written_with_all_digits() {
        assert_eq!(Single::new(-(1 << 23), 24).to_string(), "-1.00000000000000000000000");
        assert_eq!(Single::new(1, 24).to_string(), "0.00000011920928955078125");
        assert_eq!(Single::new(-3, 4).to_string(), "-0.375");
        assert_eq!(Single::new(-1, 1).to_string(), "-1");
        for steps in [-8_388_607, -5_592_405, 1, 8_388_607] {
            let number = Single::new(steps, 24);
            assert_eq!(number.to_string().parse::<f64>(), Ok(f64::from(number.stored())));
            assert_eq!(f64::from(number.stored()) * f64::from(1 << 23), f64::from(steps));
        }
    }

    #[test]
    fn bits_are_chosen_where_there_is_a_grid() {
        assert_eq!(NumberKind::Whole.bits(None).ok(), Some(16));
        assert_eq!(NumberKind::Decimal.bits(Some(31)).ok(), Some(31));
        assert_eq!(NumberKind::F32.bits(Some(24)).ok(), Some(24));
        assert!(NumberKind::F32.bits(Some(25)).is_err());
        assert!(NumberKind::Double.bits(Some(8)).is_err());
    }
}
