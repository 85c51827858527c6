//! The choices of a caller for a job, and the progress that a listener hears.

use std::ops::ControlFlow;
use std::time::Duration;

use incircle_geometry::Order;

/// A stage of a job, in the order in which they run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// The host removes duplicates and puts the points in order.
    Order,
    /// The device inserts points. For a set in parts, this stage includes reading.
    Insert,
    /// The host reads the records of the finished mesh from the device.
    Read,
    /// The host sorts the triangles into the canonical list. For a set in parts, it joins the parts before.
    Assemble,
}

impl Stage {
    /// The name of the stage in reports and errors, such as `insert`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Order => "order",
            Self::Insert => "insert",
            Self::Read => "read",
            Self::Assemble => "assemble",
        }
    }
}

/// The progress of a job: `done` of `total` items in a stage.
///
/// The items are records in [`Stage::Read`] and points in all other stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Stage that is running.
    pub stage: Stage,
    /// Items of this stage that are done.
    pub done: usize,
    /// Items of this stage in all.
    pub total: usize,
}

/// A function that hears of progress and can cancel the job.
///
/// [`ControlFlow::Continue`] lets the job go on; [`ControlFlow::Break`] ends it with
/// [`Error::Cancelled`](crate::Error::Cancelled), after which the session can be used again.
///
/// ```
/// use std::ops::ControlFlow;
/// use incircle::{Device, ErrorKind, Options, Progress, Stage};
///
/// let stop_before_read = |progress: Progress| match progress.stage {
///     Stage::Read => ControlFlow::Break(()),
///     _ => ControlFlow::Continue(()),
/// };
/// let mut device = Device::open("model")?;
/// let mut session = device.session()?;
/// let options = Options::default().progress(&stop_before_read);
/// let error = session.triangulate_with(&[(0, 0), (4, 0), (0, 4)], &options).expect_err("it was cancelled");
/// assert_eq!(error.kind(), ErrorKind::Cancelled);
/// assert_eq!(session.triangulate(&[(0, 0), (4, 0), (0, 4)])?.mesh.triangles.len(), 1);
/// # Ok::<(), incircle::Error>(())
/// ```
pub type ProgressListener<'a> = &'a dyn Fn(Progress) -> ControlFlow<()>;

/// Points of one `Insert` command unless the caller chooses another number.
const INSERT_CHUNK: usize = 65_536;

/// Choices for a job or a batch. [`Options::default`] suits most.
///
/// No choice changes the mesh: the order and the number of contexts decide how long the job takes, and the others how
/// the caller can watch and end it.
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
    /// Time limit for the whole job. `None` stands for [`Options::default_timeout`], stretched for a simulated device.
    pub timeout: Option<Duration>,
    /// Order of insertion, for devices that insert points one after another; the CPU triangulator has an order of its
    /// own.
    pub order: Order,
    /// Listener that is called at the start of each stage and after every chunk.
    pub progress: Option<ProgressListener<'a>>,
    /// Contexts that work, which is the number of insertions in flight at once: from 1 to the contexts of the device,
    /// see [`Session::identity`](crate::Session::identity). `None` stands for all of them. In a batch this is an upper
    /// bound, and each job gets as many as make it faster.
    pub contexts: Option<u32>,
    /// Points of one `Insert` command, 65,536 by default; fewer than 3 count as 3. Progress is reported, and
    /// cancellation noticed, between chunks.
    pub insert_chunk: usize,
}

impl<'a> Options<'a> {
    /// Sets the time limit, [`timeout`](Self::timeout).
    #[must_use]
    pub fn timeout(self, timeout: impl Into<Option<Duration>>) -> Self {
        Self { timeout: timeout.into(), ..self }
    }

    /// Sets the [`order`](Self::order) of insertion.
    #[must_use]
    pub fn order(self, order: Order) -> Self {
        Self { order, ..self }
    }

    /// Sets the listener for [`progress`](Self::progress).
    #[must_use]
    pub fn progress(self, listener: ProgressListener<'a>) -> Self {
        Self { progress: Some(listener), ..self }
    }

    /// Sets the number of [`contexts`](Self::contexts) that work.
    #[must_use]
    pub fn contexts(self, contexts: impl Into<Option<u32>>) -> Self {
        Self { contexts: contexts.into(), ..self }
    }

    /// Sets the number of points of one `Insert` command, [`insert_chunk`](Self::insert_chunk).
    #[must_use]
    pub fn insert_chunk(self, points: usize) -> Self {
        Self { insert_chunk: points, ..self }
    }

    /// The time limit of a job of this many points unless the caller sets one: a minute and 2 ms per point.
    ///
    /// The limit is generous: the simulated core with one context takes about 0.08 ms per uniform point, which are 156
    /// clocks at about two million clocks a second. Choose more for a device that is much slower, such as a simulation
    /// that writes waveforms.
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
