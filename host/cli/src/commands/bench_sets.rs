//! What the benchmarks of one job and of many have in common.

use std::time::Instant;

use incircle::Point;
use incircle_testkit::Distribution;

use super::generate::make;
use crate::arguments::BenchArguments;
use crate::failure::{failure_of, Failure};
use crate::interrupt;

/// The back end that is measured unless another is asked for.
pub(super) const DEFAULT_BACKEND: &str = "model";

/// Runs of a set in software, of which the fastest counts. Cycles are the same in every run, so one is enough for a
/// core.
pub(super) const SOFTWARE_RUNS: usize = 3;

/// Clock frequency for which times are told unless chosen or known.
pub(super) const DEFAULT_MHZ: f64 = 125.0;

/// The sets asked for, or else those of the literature and the lattice.
pub(super) fn sets_of(arguments: &BenchArguments) -> Vec<Distribution> {
    if arguments.sets.is_empty() {
        Distribution::LITERATURE.into_iter().chain([Distribution::Lattice]).collect()
    } else {
        arguments.sets.clone()
    }
}

/// The points of a set, without duplicates taken out.
pub(super) fn points_of(set: Distribution, n: u32, seed: u64, coord_bits: u32) -> Result<Vec<Point>, Failure> {
    let points = make(set, n, coord_bits, seed)?;
    Ok(points.into_iter().map(Point::from).collect())
}

/// What a library call gives, and how many seconds it took.
pub(super) fn timed<T>(call: impl FnOnce() -> Result<T, incircle::Error>) -> Result<(T, f64), Failure> {
    let since = Instant::now();
    let result = interrupt::working(call);
    let seconds = since.elapsed().as_secs_f64();
    // Comes first, because an interrupt may show as any error.
    interrupt::check()?;
    Ok((result.map_err(|error| failure_of(&error))?, seconds))
}
