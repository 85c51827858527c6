//! The interface of the triangulators that are compared, and the result of one run.

use incircle::Point;

use super::error::PeerError;

/// One triangulation, as measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// Seconds of the whole call.
    pub(super) seconds: f64,
    /// Seconds that the processor spent on the calling thread, or on the other program.
    pub(super) busy: f64,
    /// Number of triangles found.
    pub(super) triangles: usize,
    /// Number of distinct points, if the contestant reports it.
    pub(super) distinct: Option<usize>,
    /// Share of the time that went into the ordering, if the contestant reports it.
    pub(super) order_share: Option<f64>,
}

/// A triangulator that takes part.
pub(super) trait Contestant {
    fn name(&self) -> &'static str;

    /// Triangulates the points. They are brought into the contestant's own form before the clock starts.
    fn run(&mut self, points: &[Point]) -> Result<Run, PeerError>;
}

/// A peer that is not installed, and the reason.
pub(super) struct Missing {
    pub(super) name: &'static str,
    pub(super) reason: String,
}
