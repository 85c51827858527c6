//! The first pass over the inputs: their lattice, their digests, and a sample from which the cuts are made.

use std::path::{Path, PathBuf};

use incircle::Point;

use super::digest::{scattered, Digest};
use super::ground::{Extent, Ground};
use super::inputs::{changed, each_piece};
use super::manifest::InputFile;
use crate::arguments::ReadArguments;
use crate::failure::Failure;
use crate::points::{Coordinates, Unit};

/// The most points of a set: each index fits 32 bits, and two values stay free.
const MOST_POINTS: u64 = u32::MAX as u64 - 1;

/// The result of the first pass.
pub struct Survey {
    /// The lattice of all points.
    pub ground: Ground,
    /// The inputs, in the order in which their points are numbered.
    pub inputs: Vec<InputFile>,
    /// The number of all points.
    pub points: u64,
    /// Some of the points, or all of a small set.
    pub sample: Vec<Point>,
}

/// Reads all inputs. The sample has at most `most` points, which take 16 bytes each, and 8 for their numbers.
pub fn survey(paths: &[PathBuf], read: &ReadArguments, most: usize, quiet: bool) -> Result<Survey, Failure> {
    let (mut extent, mut sample, mut inputs, mut points) = (Extent::default(), Sample::new(most), Vec::new(), 0);
    for path in paths {
        let mut digest = Digest::default();
        each_piece(path, read, quiet, &mut |piece| {
            extent.add(piece).map_err(|failure| failure.in_file(crate::path::name(path)))?;
            sample.add(points + digest.points(), piece);
            digest.add(piece);
            check_count(points + digest.points())
        })?;
        points += digest.points();
        inputs.push(InputFile { path: path.clone(), points: digest.points(), digest: digest.value() });
    }
    let ground = extent.ground()?;
    let sample = sample.points(&ground).ok_or_else(|| changed(Path::new("the set")))?;
    Ok(Survey { ground, inputs, points, sample })
}

fn check_count(points: u64) -> Result<(), Failure> {
    if points <= MOST_POINTS {
        return Ok(());
    }
    Err(Failure::input(format!("the inputs have more than {MOST_POINTS} points, which is the most of one set")))
}

/// Points, each with the number made of its index.
type Kept<C> = Vec<(u64, [C; 2])>;

/// A sample whose points are chosen by their indices alone, so that the same inputs give the same tiles.
struct Sample {
    most: usize,
    /// A point is in the sample if the number made of its index is at most this.
    limit: u64,
    kept: usize,
    /// The kept points of each kind of numbers, with the numbers of their indices.
    steps: Vec<(Unit, Kept<i64>)>,
    doubles: Kept<f64>,
}

impl Sample {
    fn new(most: usize) -> Self {
        Self { most, limit: u64::MAX, kept: 0, steps: Vec::new(), doubles: Vec::new() }
    }

    /// Adds a piece whose first point has the index `first`.
    fn add(&mut self, first: u64, piece: &Coordinates) {
        match piece {
            Coordinates::Steps { steps, unit } => {
                let place = self.steps.iter().position(|(known, _)| known == unit).unwrap_or_else(|| {
                    self.steps.push((*unit, Vec::new()));
                    self.steps.len() - 1
                });
                for (index, &point) in (first..).zip(steps) {
                    let number = scattered(index);
                    if number <= self.limit {
                        self.steps[place].1.push((number, point));
                        self.count();
                    }
                }
            }
            Coordinates::Doubles(points) => {
                for (index, &point) in (first..).zip(points) {
                    let number = scattered(index);
                    if number <= self.limit {
                        self.doubles.push((number, point));
                        self.count();
                    }
                }
            }
        }
    }

    /// Counts a new point, and drops about half of a sample that has become too large.
    fn count(&mut self) {
        self.kept += 1;
        while self.kept > self.most {
            self.limit /= 2;
            let limit = self.limit;
            self.steps.iter_mut().for_each(|(_, list)| list.retain(|(number, _)| *number <= limit));
            self.doubles.retain(|(number, _)| *number <= limit);
            self.kept = self.doubles.len() + self.steps.iter().map(|(_, list)| list.len()).sum::<usize>();
        }
    }

    fn points(self, ground: &Ground) -> Option<Vec<Point>> {
        let mut points = Vec::with_capacity(self.kept);
        for (unit, list) in self.steps {
            let steps = list.into_iter().map(|(_, point)| point).collect();
            ground.lay(&Coordinates::Steps { steps, unit }, &mut points)?;
        }
        let doubles = self.doubles.into_iter().map(|(_, point)| point).collect();
        ground.lay(&Coordinates::Doubles(doubles), &mut points)?;
        Some(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_stays_small_and_is_spread_over_the_set() {
        let mut sample = Sample::new(1000);
        for first in (0i64..100_000).step_by(1000) {
            let steps = (first..first + 1000).map(|index| [index, index]).collect();
            sample.add(first.cast_unsigned(), &Coordinates::Steps { steps, unit: Unit::of_digits(0) });
        }
        let ground = Ground { length: super::super::ground::Length::Decimal(0), offset: [0; 2], bits: 17 };
        let points = sample.points(&ground).expect("whole numbers");
        assert!((300..=1000).contains(&points.len()), "{}", points.len());
        let low = points.iter().filter(|point| point.x < 50_000).count();
        assert!((points.len() * 2 / 5..points.len() * 3 / 5).contains(&low), "{low} of {}", points.len());
    }
}
