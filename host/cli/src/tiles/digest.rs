//! The digest of an input, which tells whether the input changed between two passes.

use crate::points::Coordinates;

/// The golden ratio in 64 bits, an odd number that spreads bits well.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// A number of 64 bits that depends on all points of an input and on their sequence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Digest {
    state: u64,
    points: u64,
}

impl Digest {
    /// Adds the points of a piece.
    pub fn add(&mut self, piece: &Coordinates) {
        match piece {
            Coordinates::Steps { steps, .. } => {
                steps.as_flattened().iter().for_each(|value| self.mix(value.cast_unsigned()));
                self.points += steps.len() as u64;
            }
            Coordinates::Doubles(points) => {
                points.as_flattened().iter().for_each(|value| self.mix(value.to_bits()));
                self.points += points.len() as u64;
            }
        }
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
