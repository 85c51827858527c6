//! A line through the times of jobs of several sizes: `t = c + m n`.

use std::fmt;

use serde_json::{json, Value};

/// A line through times of jobs, by least squares.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Seconds of a job without points.
    pub constant: f64,
    /// Additional seconds for each point.
    pub slope: f64,
    /// Points and seconds of each job.
    pub jobs: Vec<(usize, f64)>,
}

impl Fit {
    /// Fits the line; `None` unless there are jobs of at least two sizes.
    pub fn of(jobs: Vec<(usize, f64)>) -> Option<Self> {
        let count = jobs.len() as f64;
        let mean = |value: fn(&(usize, f64)) -> f64| jobs.iter().map(value).sum::<f64>() / count;
        let (points, seconds) = (mean(|job| job.0 as f64), mean(|job| job.1));
        let moments = jobs.iter().map(|&(n, t)| (n as f64 - points, t - seconds));
        let (square, mixed) = moments.fold((0.0, 0.0), |(square, mixed), (n, t)| (square + n * n, mixed + n * t));
        let slope = mixed / square;
        slope.is_finite().then_some(Self { constant: seconds - slope * points, slope, jobs })
    }

    /// The line as a JSON object.
    pub fn to_json(&self) -> Value {
        let jobs: Vec<_> = self.jobs.iter().map(|&(n, seconds)| json!({ "distinct": n, "seconds": seconds })).collect();
        json!({ "constant": self.constant, "per_point": self.slope, "jobs": jobs })
    }
}

impl fmt::Display for Fit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { constant, slope, jobs } = self;
        let sizes = jobs.iter().map(|(n, _)| n.to_string()).collect::<Vec<_>>().join(", ");
        write!(f, "t = {:.2} ms + {:.3} us * n, from n = {sizes}", constant * 1e3, slope * 1e6)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_again() {
        let jobs = [100, 200, 400].map(|n| (n, 0.01 + 2e-5 * n as f64));
        let fit = Fit::of(jobs.to_vec()).expect("three sizes");
        assert!((fit.constant - 0.01).abs() < 1e-12 && (fit.slope - 2e-5).abs() < 1e-15, "{fit:?}");
        assert_eq!(fit.to_string(), "t = 10.00 ms + 20.000 us * n, from n = 100, 200, 400");
        for jobs in [vec![], vec![(5, 1.0)], vec![(5, 1.0), (5, 2.0)]] {
            assert_eq!(Fit::of(jobs), None);
        }
    }
}
