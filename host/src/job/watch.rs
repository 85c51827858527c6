//! Telling listeners of progress, and timing stages.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::options::{Options, Progress, Stage};
use crate::error::Error;

/// Tells the listener of progress. Fails with [`Error::Cancelled`] if the listener cancels the job.
pub(crate) fn tell(options: &Options<'_>, stage: Stage, done: usize, total: usize) -> Result<(), Error> {
    let Some(listener) = options.progress else {
        return Ok(());
    };
    if listener(Progress { stage, done, total }).is_break() {
        return Err(Error::Cancelled { stage: stage.name(), done, total });
    }
    Ok(())
}

/// Times the stages of a job.
#[derive(Debug)]
pub(crate) struct Stopwatch {
    since: Instant,
    pub(crate) stages: Vec<(&'static str, Duration)>,
}

impl Stopwatch {
    pub(crate) fn start() -> Self {
        Self { since: Instant::now(), stages: Vec::with_capacity(4) }
    }

    /// Starts anew after the first stage, which needs no second try: the times of all later stages are dropped.
    pub(crate) fn again(&mut self) {
        self.stages.truncate(1);
        self.since = Instant::now();
    }

    pub(crate) fn ended(&mut self, stage: Stage) {
        let now = Instant::now();
        self.stages.push((stage.name(), now - self.since));
        self.since = now;
    }
}

/// Hears of the progress of one job of a batch, and tells the progress of the whole batch.
pub(crate) struct PartListener<'a> {
    options: &'a Options<'a>,
    /// Points of the jobs before this one.
    before: usize,
    /// Points of all jobs.
    total: usize,
    /// Largest number of points that was told so far.
    most: Cell<usize>,
}

impl<'a> PartListener<'a> {
    pub(crate) fn new(options: &'a Options<'a>, before: usize, total: usize) -> Self {
        Self { options, before, total, most: Cell::new(before) }
    }

    /// Passes progress on. A job that is tried once more begins at 0 again, but the batch never goes back.
    pub(crate) fn hear(&self, progress: Progress) -> ControlFlow<()> {
        if progress.stage == Stage::Insert {
            self.most.set(self.most.get().max(self.before + progress.done));
        }
        let all = Progress { stage: Stage::Insert, done: self.most.get(), total: self.total };
        self.options.progress.map_or(ControlFlow::Continue(()), |listener| listener(all))
    }
}
