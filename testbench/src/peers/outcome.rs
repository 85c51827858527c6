//! The result of a comparison.

use super::contestant::Run;
use super::points::Set;

/// Results of all repetitions of one set.
pub(super) struct Outcome {
    pub(super) set: Set,
    pub(super) bits: u32,
    pub(super) cold: bool,
    /// Number of points of a repetition, and of distinct points in the last one.
    pub(super) points: usize,
    pub(super) distinct: usize,
    /// Share of the ordering in the time of our back end on one thread.
    pub(super) order_share: Vec<f64>,
    pub(super) names: Vec<&'static str>,
    /// For each contestant, its run in each repetition.
    pub(super) runs: Vec<Vec<Run>>,
}
