//! Progress of a batch while one of its jobs goes by itself.

use std::cell::Cell;
use std::ops::ControlFlow;

use crate::options::{Options, Progress, Stage};

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
