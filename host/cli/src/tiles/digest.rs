//! The digest of an input, which tells whether the input changed between two passes.

use crate::number;
use crate::points::Coordinates;

/// The golden ratio in 64 bits, an odd number that spreads bits well.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// A number of 64 bits that depends on the coordinates of all points of an input and on their sequence. It does not
/// depend on how the points come in pieces, nor on the steps in which a piece counts, so `1.50` is the same as `1.5`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Digest {
    state: u64,
    points: u64,
}

impl Digest {
    /// Adds the points of a piece.
    pub fn add(&mut self, piece: &Coordinates) {
        match piece {
            Coordinates::Steps { steps, unit } if unit.is_whole() => {
                steps.as_flattened().iter().for_each(|&value| self.mix_whole(value));
                self.points += steps.len() as u64;
            }
            Coordinates::Steps { steps, unit } => {
                for point in steps {
                    for (axis, &steps) in point.iter().enumerate() {
                        self.mix_decimal(i128::from(steps) * i128::from(unit.factor) + unit.offset[axis], unit.digits);
                    }
                }
                self.points += steps.len() as u64;
            }
            Coordinates::Doubles(points) => {
                points.as_flattened().iter().for_each(|value| self.mix(value.to_bits()));
                self.points += points.len() as u64;
            }
        }
    }

    /// Adds a whole number, in the bits of the double that it is.
    #[inline]
    fn mix_whole(&mut self, value: i64) {
        if value.unsigned_abs() <= 1 << f64::MANTISSA_DIGITS {
            self.mix((value as f64).to_bits());
        } else {
            self.mix_decimal(value.into(), 0);
        }
    }

    /// Adds a decimal: as the double that it is, or else without the zeros at its end.
    fn mix_decimal(&mut self, mut steps: i128, mut digits: u32) {
        // Most steps fit 64 bits, whose division is much quicker.
        match i64::try_from(steps) {
            Ok(mut short) => {
                while digits > 0 && short % 10 == 0 {
                    (short, digits) = (short / 10, digits - 1);
                }
                steps = short.into();
            }
            Err(_) => {
                while digits > 0 && steps % 10 == 0 {
                    (steps, digits) = (steps / 10, digits - 1);
                }
            }
        }
        // A fraction that is a double ends in 5.
        if (digits == 0 || steps % 5 == 0) && number::is_double(steps, digits) {
            return self.mix(number::nearest(steps, digits).to_bits());
        }
        let bits = steps.cast_unsigned();
        // The low half comes first, which has all bits of most steps.
        self.mix(bits as u64);
        self.mix((bits >> u64::BITS) as u64 ^ u64::from(digits) << 32);
    }

    /// Adds a number.
    #[inline]
    pub fn mix(&mut self, word: u64) {
        let product = (self.state ^ word).wrapping_mul(SPREAD);
        self.state = product ^ product >> 32;
    }

    /// The digest of all that was added.
    pub fn value(&self) -> u64 {
        self.state
    }

    /// The number of points that were added.
    pub fn points(&self) -> u64 {
        self.points
    }
}

/// A number that looks random and is the same for the same index.
#[inline]
pub fn scattered(index: u64) -> u64 {
    let mut digest = Digest { state: SPREAD, points: 0 };
    digest.mix(index);
    digest.mix(SPREAD);
    digest.value()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Unit;

    fn digest(pieces: &[Coordinates]) -> (u64, u64) {
        let mut digest = Digest::default();
        pieces.iter().for_each(|piece| digest.add(piece));
        (digest.value(), digest.points())
    }

    fn steps(steps: &[[i64; 2]], digits: u32) -> Coordinates {
        Coordinates::Steps { steps: steps.to_vec(), unit: Unit::of_digits(digits) }
    }

    #[test]
    fn one_value_has_one_digest_in_all_steps() {
        let large = i64::MAX / 100;
        let whole = digest(&[steps(&[[3, -7], [large, 0]], 0)]);
        assert_eq!(digest(&[steps(&[[300, -700]], 2), steps(&[[large * 10, 0]], 1)]), whole);
        let offset = Unit { offset: [5, -5], factor: 2, ..Unit::of_digits(0) };
        assert_eq!(
            digest(&[Coordinates::Steps { steps: vec![[-1, -1]], unit: offset }, steps(&[[large, 0]], 0)]),
            whole
        );
        let halves = digest(&[Coordinates::Doubles(vec![[1.5, -0.25], [0.0, 4.0]])]);
        assert_eq!(digest(&[steps(&[[1500, -250]], 3), steps(&[[0, 4]], 0)]), halves);
        assert_eq!(digest(&[steps(&[[150, -25], [0, 400]], 2)]), halves);
        let thirds = digest(&[steps(&[[33, 1]], 2)]);
        assert_eq!(digest(&[steps(&[[33_000, 1000]], 5)]), thirds);
    }

    #[test]
    fn other_values_have_other_digests() {
        let sets = [
            vec![steps(&[[33, 1]], 2)],
            vec![steps(&[[33, 1]], 3)],
            vec![steps(&[[33, 1]], 0)],
            vec![steps(&[[1, 33]], 2)],
            vec![steps(&[[-33, 1]], 2)],
            vec![steps(&[[i64::MAX, 1]], 2)],
            vec![steps(&[[i64::MAX, 1]], 0)],
            vec![steps(&[[33, 1], [33, 1]], 2)],
        ];
        let mut found: Vec<_> = sets.iter().map(|set| digest(set)).collect();
        found.sort_unstable();
        found.dedup();
        assert_eq!(found.len(), sets.len());
    }
}
