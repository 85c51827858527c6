//! Contour lines of a surface, as GeoJSON.

use std::io::{self, Write};

use incircle::interpolate::Surface;

use crate::failure::Failure;
use crate::number::Coordinate;
use crate::step::Step;

/// The most levels of a run.
const MOST_LEVELS: i64 = 10_000;

/// A surface, its points in the numbers of the file, and their values.
pub struct Lines<'a> {
    /// The surface.
    pub surface: &'a Surface,
    /// The points in the numbers of the file.
    pub points: &'a [[f64; 2]],
    /// The value of each point.
    pub values: &'a [f64],
}

impl Lines<'_> {
    /// All multiples of a step between the lowest value and the highest.
    ///
    /// # Errors
    /// The step is no positive decimal, or there are too many levels.
    pub fn levels(&self, step: &str) -> Result<Vec<f64>, Failure> {
        let step = Step::read("--contours", step, "10")?;
        let values = self.values.iter().copied();
        let (low, high) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
        let [first, last] = step.multiples(low, high, "values")?;
        if last - first >= MOST_LEVELS {
            return Err(step.refuse(&format!("gives {} levels, more than {MOST_LEVELS}", last - first + 1)));
        }
        Ok((first..=last).map(|level| step.times(level)).collect())
    }

    /// Writes a feature for each line, with its level as the property `value`, and returns their number. A closed line
    /// ends where it begins.
    pub fn write(&self, levels: &[f64], out: &mut dyn Write) -> io::Result<usize> {
        write!(out, "{{\"type\":\"FeatureCollection\",\"features\":[")?;
        let mut count = 0;
        for &level in levels {
            for line in self.surface.contours(level) {
                let mut places: Vec<[f64; 2]> =
                    line.crossings.iter().map(|crossing| crossing.place(self.points)).collect();
                places.extend(places.first().copied().filter(|_| line.is_closed));
                // Crossings at one corner are one place.
                places.dedup();
                if places.len() < 2 {
                    continue;
                }
                let texts: Vec<String> = places
                    .iter()
                    .map(|[x, y]| format!("[{},{}]", Coordinate::Double(*x), Coordinate::Double(*y)))
                    .collect();
                let comma = if count == 0 { "" } else { "," };
                write!(
                    out,
                    "{comma}\n{{\"type\":\"Feature\",\"properties\":{{\"value\":{}}},\
                     \"geometry\":{{\"type\":\"LineString\",\"coordinates\":[{}]}}}}",
                    Coordinate::Double(level),
                    texts.join(",")
                )?;
                count += 1;
            }
        }
        writeln!(out, "\n]}}")?;
        Ok(count)
    }
}
