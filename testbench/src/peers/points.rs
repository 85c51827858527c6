//! The point sets of the comparison.

use std::fmt;
use std::str::FromStr;

use incircle::quantize::{quantize, Quantize};
use incircle::Point;
use incircle_testkit::{generate, Distribution, SplitMix64};

use super::error::PeerError;

const AIRPORTS: &str = include_str!("../../data/airports.csv");
const AIRPORTS_NAME: &str = "airports";

/// A set of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// A set that the kit generates.
    Distribution(Distribution),
    /// The airports of the world, as many as the list has.
    Airports,
}

impl Set {
    /// The sets that are compared by default.
    pub fn usual() -> Vec<Self> {
        let generated = Distribution::LITERATURE.into_iter().chain([Distribution::Lattice]).map(Self::Distribution);
        generated.chain([Self::Airports]).collect()
    }

    /// Points of this set: `n`, or fewer if the set has no more. Each seed gives other points.
    pub(super) fn points(self, n: usize, bits: u32, seed: u64) -> Result<Vec<Point>, PeerError> {
        match self {
            Self::Distribution(distribution) => {
                Ok(generate(distribution, n, bits, seed)?.into_iter().map(Point::from).collect())
            }
            Self::Airports => {
                let numbers = |line: &str| -> Option<[f64; 2]> {
                    let mut cells = line.split(',').map(str::parse);
                    Some([cells.next()?.ok()?, cells.next()?.ok()?])
                };
                let mut values: Vec<[f64; 2]> = AIRPORTS.lines().filter_map(numbers).collect();
                SplitMix64::new(seed).shuffle(&mut values);
                values.truncate(n);
                Ok(quantize(&values, bits, Quantize::Fit)?.0)
            }
        }
    }
}

impl fmt::Display for Set {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Distribution(distribution) => distribution.fmt(f),
            Self::Airports => f.write_str(AIRPORTS_NAME),
        }
    }
}

impl FromStr for Set {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        if name == AIRPORTS_NAME {
            return Ok(Self::Airports);
        }
        name.parse().map(Self::Distribution).map_err(|_| {
            let names = Distribution::ALL.map(Distribution::name).join(", ");
            format!("there is no set \"{name}\"; there are {names}, {AIRPORTS_NAME}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_found_by_name_and_differ_by_seed() {
        for set in Set::usual() {
            assert_eq!(set.to_string().parse(), Ok(set));
            let points = |seed| set.points(500, 20, seed).expect("a set");
            assert_eq!((points(1).len(), points(1) == points(1), points(1) == points(2)), (500, true, false), "{set}");
        }
        assert!("spirals".parse::<Set>().is_err_and(|error| error.contains("spiral, ")));
        assert!(Set::Airports.points(1_000_000, 16, 1).is_ok_and(|points| points.len() > 28_000));
    }
}
