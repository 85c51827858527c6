//! Who hears how far a job is, and how long its stages took.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::options::{Options, Progress, Stage};
use crate::error::Error;

/// Tells the listener, which may cancel.
pub(crate) fn tell(options: &Options<'_>, stage: Stage, done: usize, total: usize) -> Result<(), Error> {
    let Some(listener) = options.progress else {
        return Ok(());
    };
    if listener(Progress { stage, done, total }).is_break() {
        return Err(Error::Cancelled { stage: stage.name(), done, total });
    }
    Ok(())
}

/// Times stages.
#[derive(Debug)]
pub(crate) struct Stopwatch {
    since: Instant,
    pub(crate) stages: Vec<(&'static str, Duration)>,
}

impl Stopwatch {
    pub(crate) fn start() -> Self {
        Self { since: Instant::now(), stages: Vec::with_capacity(4) }
    }

    /// From now on, as if what came after the first stage had not been.
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

/// Hears of a job that goes by itself, and tells how far all jobs are.
pub(crate) struct PartListener<'a> {
    options: &'a Options<'a>,
    /// Points of the jobs before it, and of all.
    before: usize,
    total: usize,
    /// The most that was told.
    most: Cell<usize>,
}

impl<'a> PartListener<'a> {
    pub(crate) fn new(options: &'a Options<'a>, before: usize, total: usize) -> Self {
        Self { options, before, total, most: Cell::new(before) }
    }

    /// What a job that is done once more tells again is told once.
    pub(crate) fn hear(&self, progress: Progress) -> ControlFlow<()> {
        if progress.stage == Stage::Insert {
            self.most.set(self.most.get().max(self.before + progress.done));
        }
        let all = Progress { stage: Stage::Insert, done: self.most.get(), total: self.total };
        self.options.progress.map_or(ControlFlow::Continue(()), |listener| listener(all))
    }
}
