//! What takes part in the comparison, and what one triangulation took.

use incircle::Point;

use super::error::PeerError;

/// One triangulation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// Seconds of the whole call.
    pub(super) seconds: f64,
    /// Those of them that the processor spent on the calling thread, or on the other program.
    pub(super) busy: f64,
    /// Triangles found.
    pub(super) triangles: usize,
    /// Distinct points, if it tells.
    pub(super) distinct: Option<usize>,
    /// The part of the time that went into the ordering, if it tells.
    pub(super) order_share: Option<f64>,
}

/// Something that triangulates.
pub(super) trait Contestant {
    fn name(&self) -> &'static str;

    /// Triangulates the points, brought into its own form before the clock starts.
    fn run(&mut self, points: &[Point]) -> Result<Run, PeerError>;
}

/// A peer that is not there, and why.
pub(super) struct Missing {
    pub(super) name: &'static str,
    pub(super) reason: String,
}
