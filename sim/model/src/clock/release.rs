//! Releases the locks of committed and aborted attempts, one in each clock. After a reset it clears the whole lock
//! memory.
//!
//! Hardware twin: the block `Release`.

use super::defect::Defect;
use super::memory::Memory;
use super::release_job::ReleaseJob;
use super::wires::Wires;
use incircle_protocol::{triangle_capacity, Config};
use std::collections::VecDeque;

/// A lock on its way from the log.
#[derive(Clone, Copy, Debug)]
struct Fetch {
    context: usize,
    id: u32,
    is_last: bool,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Release {
    /// Locks of commits, which go first, and locks of aborted attempts.
    after_commit: VecDeque<ReleaseJob>,
    after_failure: VecDeque<ReleaseJob>,
    /// The current job, and the next place in its log.
    at_work: Option<(ReleaseJob, u32)>,
    /// The log memory and its output register.
    fetched: [Option<Fetch>; 2],
    clear: Option<Fetch>,
    /// The next lock of the sweep after reset.
    sweep: Option<u32>,
    /// The lock that the sweep clears in this clock.
    swept: Option<u32>,
}

impl Release {
    pub(super) fn reset(&mut self) {
        *self = Self { sweep: Some(0), ..Self::default() };
    }

    /// Whether the lock memory is being cleared after reset.
    pub(super) fn sweeps(&self) -> bool {
        self.sweep.is_some()
    }

    /// The lock that is cleared in this clock.
    pub(super) fn clear(&self) -> Option<u32> {
        self.clear.map(|fetch| fetch.id).or(self.swept)
    }

    /// The context whose last lock is cleared in this clock.
    pub(super) fn released(&self) -> Option<usize> {
        self.clear.filter(|fetch| fetch.is_last).map(|fetch| fetch.context)
    }

    pub(super) fn clock(&mut self, wires: &Wires, memory: &mut Memory, config: Config, defect: Option<Defect>) {
        if let Some(id) = self.clear() {
            memory.locks[id as usize] = false;
        }
        self.clear = self.fetched[1];
        self.fetched = [self.fetch(memory), self.fetched[0]];
        if self.at_work.is_none() {
            let next = self.after_commit.pop_front().or_else(|| self.after_failure.pop_front());
            self.at_work = next.map(|job| (job, 0));
        }
        self.swept = self.sweep;
        self.sweep = self.sweep.map(|id| id + 1).filter(|&id| id < triangle_capacity(config.points));
        // L4: the locks of a ring are due for release when its last record is written.
        let committed = if defect == Some(Defect::ReleasesBeforeWritten) {
            wires.outcome.and_then(|outcome| outcome.commit)
        } else {
            wires.committed
        };
        self.after_commit.extend(committed.map(|job| ReleaseJob { context: job.context, locks: job.locks }));
        // M6: so are those of a deletion.
        let erased = if defect == Some(Defect::ReleasesBeforeWritten) {
            wires.fill_end.filter(|end| !end.is_flat).map(|end| ReleaseJob { context: end.context, locks: end.locks })
        } else {
            wires.erased.map(|job| ReleaseJob { context: job.context, locks: job.locks })
        };
        self.after_commit.extend(erased);
        self.after_failure.extend(wires.outcome.and_then(|outcome| outcome.release));
        self.after_failure.extend(wires.fill_end.and_then(|end| end.release()));
    }

    fn fetch(&mut self, memory: &Memory) -> Option<Fetch> {
        let (job, index) = self.at_work?;
        let is_last = index + 1 == job.locks;
        self.at_work = (!is_last).then_some((job, index + 1));
        Some(Fetch { context: job.context, id: memory.lock_log[job.context][index as usize], is_last })
    }
}
