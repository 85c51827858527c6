//! What does the work behind a session.

use incircle_protocol::Identity;

use crate::error::Error;
use crate::job::{Options, Solution};
use crate::limit::Limit;
use incircle_geometry::Point;

/// What does the work: the engine in this process, or a device that takes commands.
pub(crate) trait Backend {
    /// Name in reports.
    fn name(&self) -> String;

    /// Finds out who it is, and believes only what can be.
    fn greet(&mut self, limit: Limit) -> Result<Identity, Error>;

    /// How many times slower than real it is.
    fn slow(&self) -> u32 {
        1
    }

    /// Clocks since it was made, where they are counted.
    fn clocks(&self) -> Option<u64> {
        None
    }

    /// Does one job, of which a listener hears how far it is.
    fn triangulate(&mut self, points: Vec<Point>, terms: Terms<'_>) -> Result<Solution, Error>;

    /// Does those of many jobs that go together.
    fn triangulate_together(&mut self, jobs: Vec<Vec<Point>>, terms: Terms<'_>) -> Result<Together, Error>;
}

/// On what terms a job is done. Its points, and the number of contexts, have been checked.
#[derive(Clone, Copy)]
pub(crate) struct Terms<'t> {
    pub(crate) identity: Identity,
    /// Contexts that work.
    pub(crate) contexts: u32,
    pub(crate) limit: Limit,
    pub(crate) options: &'t Options<'t>,
}

/// What has become of many jobs.
pub(crate) struct Together {
    /// Those that are done, in the order of the caller.
    pub(crate) solutions: Vec<Option<Solution>>,
    /// Those that must go one by one.
    pub(crate) left: Vec<JobLeft>,
}

/// A job that must go by itself.
pub(crate) struct JobLeft {
    /// Its place in the list of the caller.
    pub(crate) job: usize,
    pub(crate) points: Vec<Point>,
    /// Contexts that work on it.
    pub(crate) contexts: u32,
}
