//! What a caller can choose for one job, and what it hears while the job runs.

use std::ops::ControlFlow;
use std::time::Duration;

use incircle_geometry::Order;

/// A part of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// The host removes duplicates and chooses the order.
    Order,
    /// The device takes points.
    Insert,
    /// The device hands out triangle records.
    Read,
    /// The host sorts the triangles into the canonical list.
    Assemble,
}

impl Stage {
    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Order => "order",
            Self::Insert => "insert",
            Self::Read => "read",
            Self::Assemble => "assemble",
        }
    }
}

/// How far a job is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The part of the job.
    pub stage: Stage,
    /// Points (records in [`Stage::Read`]) done in this part.
    pub done: usize,
    /// Points (records in [`Stage::Read`]) of this part.
    pub total: usize,
}

/// A listener: [`ControlFlow::Break`] cancels the job with [`Error::Cancelled`](crate::Error::Cancelled).
pub type ProgressListener<'a> = &'a dyn Fn(Progress) -> ControlFlow<()>;

/// Points of one `Insert` command unless chosen otherwise.
const INSERT_CHUNK: usize = 65_536;

/// Choices for one job; [`Options::default`] suits most.
///
/// ```
/// use incircle::{Options, Order};
///
/// let options = Options::default().order(Order::Hilbert).contexts(2);
/// assert_eq!((options.order, options.contexts), (Order::Hilbert, Some(2)));
/// ```
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Options<'a> {
    /// Time the device may take for the whole job. `None`: [`Options::default_timeout`].
    pub timeout: Option<Duration>,
    /// Order of insertion.
    pub order: Order,
    /// Called at the start of each stage and after every chunk.
    pub progress: Option<ProgressListener<'a>>,
    /// Contexts that work, that is insertions in flight at once: 1 to what
    /// [`Session::identity`](crate::Session::identity) says the device has. `None`: all of them. In a batch that is the
    /// most that may work, and a job has as many as pay. The mesh does not depend on it, the time does.
    pub contexts: Option<u32>,
    /// Points of one `Insert` command; at least 3 are sent. Progress and cancellation come between chunks.
    pub insert_chunk: usize,
}

impl<'a> Options<'a> {
    /// With another [`timeout`](Self::timeout).
    #[must_use]
    pub fn timeout(self, timeout: impl Into<Option<Duration>>) -> Self {
        Self { timeout: timeout.into(), ..self }
    }

    /// With another [`order`](Self::order).
    #[must_use]
    pub fn order(self, order: Order) -> Self {
        Self { order, ..self }
    }

    /// With a listener for [`progress`](Self::progress).
    #[must_use]
    pub fn progress(self, listener: ProgressListener<'a>) -> Self {
        Self { progress: Some(listener), ..self }
    }

    /// With another number of [`contexts`](Self::contexts).
    #[must_use]
    pub fn contexts(self, contexts: impl Into<Option<u32>>) -> Self {
        Self { contexts: contexts.into(), ..self }
    }

    /// With another [`insert_chunk`](Self::insert_chunk).
    #[must_use]
    pub fn insert_chunk(self, points: usize) -> Self {
        Self { insert_chunk: points, ..self }
    }

    /// The time a job of this many points may take when none is chosen: a minute and 2 ms per point.
    ///
    /// The simulated core with one context takes about 0.07 ms per uniform point: 120 clocks at two million a second.
    /// Choose more for a device that is much slower, such as a simulation that writes waveforms.
    pub fn default_timeout(points: usize) -> Duration {
        let milliseconds = u64::try_from(points).unwrap_or(u64::MAX).saturating_mul(2);
        Duration::from_secs(60).saturating_add(Duration::from_millis(milliseconds))
    }
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self { timeout: None, order: Order::default(), progress: None, contexts: None, insert_chunk: INSERT_CHUNK }
    }
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options")
            .field("timeout", &self.timeout)
            .field("order", &self.order)
            .field("progress", &self.progress.is_some())
            .field("contexts", &self.contexts)
            .field("insert_chunk", &self.insert_chunk)
            .finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn default_timeout_grows_with_the_points() {
        assert_eq!(Options::default_timeout(0), Duration::from_secs(60));
        assert_eq!(Options::default_timeout(500_000), Duration::from_secs(1060));
    }
}
