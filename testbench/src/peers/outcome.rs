//! What a comparison measures.

use super::contestant::Run;
use super::points::Set;

/// What all repetitions of one set gave.
pub(super) struct Outcome {
    pub(super) set: Set,
    pub(super) bits: u32,
    pub(super) cold: bool,
    /// Points of a repetition; distinct ones of the last.
    pub(super) points: usize,
    pub(super) distinct: usize,
    /// The share of the ordering in our time, one thread.
    pub(super) order_share: Vec<f64>,
    pub(super) names: Vec<&'static str>,
    /// For each contestant, its run in each repetition.
    pub(super) runs: Vec<Vec<Run>>,
}
