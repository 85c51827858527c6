//! The sets and timers that the benchmarks of single jobs and of batches share.

use std::time::Instant;

use incircle::Point;
use incircle_testkit::Distribution;

use super::generate::make;
use crate::arguments::BenchArguments;
use crate::failure::{failure_of, Failure};
use crate::interrupt;

/// The back end that is measured without `--backend`.
pub(super) const DEFAULT_BACKEND: &str = "model";

/// Runs of a set in software, of which the fastest counts. Cycles are the same in every run, so a core
/// runs each set once.
pub(super) const SOFTWARE_RUNS: usize = 3;

/// Clock frequency for times in MHz, if none is chosen or known.
pub(super) const DEFAULT_MHZ: f64 = 125.0;

/// The sets of the arguments, or else those of the literature and the lattice.
pub(super) fn sets_of(arguments: &BenchArguments) -> Vec<Distribution> {
    if arguments.sets.is_empty() {
        Distribution::LITERATURE.into_iter().chain([Distribution::Lattice]).collect()
    } else {
        arguments.sets.clone()
    }
}

/// The points of a set, including duplicates.
pub(super) fn points_of(set: Distribution, n: u32, seed: u64, coord_bits: u32) -> Result<Vec<Point>, Failure> {
    let points = make(set, n, coord_bits, seed)?;
    Ok(points.into_iter().map(Point::from).collect())
}

/// Makes a library call; returns its result and the seconds that it took.
pub(super) fn timed<T>(call: impl FnOnce() -> Result<T, incircle::Error>) -> Result<(T, f64), Failure> {
    let since = Instant::now();
    let result = interrupt::working(call);
    let seconds = since.elapsed().as_secs_f64();
    // The check comes first, because an interrupt may surface as any error.
    interrupt::check()?;
    Ok((result.map_err(|error| failure_of(&error))?, seconds))
}
