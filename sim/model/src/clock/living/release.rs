//! Releases the locks of attempts, one in each clock; those of commits go first.

use std::collections::VecDeque;

/// Number of clocks from a job's turn to the clear of its first lock: the log is read.
const LATENCY: u32 = 3;

/// The locks of an attempt, at least one.
#[derive(Clone, Debug)]
struct ReleaseJob {
    context: usize,
    locks: VecDeque<u32>,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Releaser {
    after_commit: VecDeque<ReleaseJob>,
    after_failure: VecDeque<ReleaseJob>,
    current: Option<ReleaseJob>,
    /// Number of clocks until the first lock of the current job is cleared, after a time without work.
    wait: u32,
}

impl Releaser {
    pub(super) fn push(&mut self, context: usize, locks: Vec<u32>, commits: bool) {
        let job = ReleaseJob { context, locks: locks.into() };
        if commits {
            self.after_commit.push_back(job);
        } else {
            self.after_failure.push_back(job);
        }
    }

    pub(super) fn is_idle(&self) -> bool {
        self.current.is_none() && self.after_commit.is_empty() && self.after_failure.is_empty()
    }

    /// The lock that is cleared at this edge.
    pub(super) fn cleared(&self) -> Option<u32> {
        self.current.as_ref().filter(|_| self.wait == 0)?.locks.front().copied()
    }

    /// Simulates one edge, and returns the context whose last lock is cleared.
    pub(super) fn clock(&mut self) -> Option<usize> {
        let mut released = None;
        if self.cleared().is_some() {
            let job = self.current.as_mut()?;
            job.locks.pop_front();
            if job.locks.is_empty() {
                released = Some(job.context);
                self.current = None;
            }
        }
        self.wait = self.wait.saturating_sub(1);
        if self.current.is_none() {
            self.current = self.after_commit.pop_front().or_else(|| self.after_failure.pop_front());
            // Between two jobs the log is read ahead.
            self.wait = if released.is_some() { 0 } else { LATENCY };
        }
        released
    }
}
