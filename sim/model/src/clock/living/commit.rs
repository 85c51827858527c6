//! The commits: the writes of each attempt, one in a clock, one attempt after the other.

use super::defect::LivingDefect;
use super::item::Part;
use crate::clock::memory::Write;
use crate::predicate::Point;
use std::collections::VecDeque;

/// Number of clocks from the end of an attempt to its first write, if no other commit is under way: the ring is read
/// from its list.
const LATENCY: u64 = 6;

/// A step of a commit.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    Write(Write),
    /// The mark of a record that becomes free.
    Free(Write),
    /// The point of a vertex is written, which takes no write of a record.
    Point,
}

/// The writes of an attempt.
#[derive(Clone, Debug)]
pub(super) struct Job {
    pub context: usize,
    pub steps: VecDeque<Step>,
    pub locks: Vec<u32>,
    /// The part of the answer that is given after the last write.
    pub part: Option<Part>,
    /// Whether the item has ended.
    pub ends: bool,
    pub since: u64,
    /// The point of a vertex, which is written with the first step.
    pub point: Option<(u32, Point)>,
    starts: u64,
}

impl Job {
    pub(super) fn new(context: usize, since: u64) -> Self {
        Self {
            context,
            steps: VecDeque::new(),
            locks: Vec::new(),
            part: None,
            ends: false,
            since,
            point: None,
            starts: 0,
        }
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Committer {
    jobs: VecDeque<Job>,
}

/// What a clock of the committer did.
#[derive(Clone, Debug, Default)]
pub(super) struct Committed {
    /// The write that reaches the port in the next clock.
    pub write: Option<Write>,
    /// The record that has become free.
    pub freed: Option<u32>,
    /// The point that is written at this edge.
    pub point: Option<(u32, Point)>,
    /// The job whose last step this was.
    pub ended: Option<Job>,
}

impl Committer {
    /// Takes a job. `more` clocks pass beside those of the usual latency.
    pub(super) fn push(&mut self, job: Job, now: u64, more: u64) {
        self.jobs.push_back(Job { starts: now + LATENCY + more, ..job });
    }

    pub(super) fn is_idle(&self) -> bool {
        self.jobs.is_empty()
    }

    pub(super) fn clock(&mut self, now: u64, defect: Option<LivingDefect>) -> Committed {
        let mut done = Committed::default();
        let Some(job) = self.jobs.front_mut().filter(|job| job.starts <= now) else {
            return done;
        };
        done.point = job.point.take();
        match job.steps.pop_front() {
            Some(Step::Write(write)) => done.write = Some(write),
            Some(Step::Free(mark)) => {
                // M8: a walk that stands there must find its way on.
                done.write = Some(mark).filter(|_| defect != Some(LivingDefect::LeavesNoMark));
                done.freed = Some(mark.id);
            }
            Some(Step::Point) | None => {}
        }
        if job.steps.is_empty() {
            done.ended = self.jobs.pop_front();
        }
        done
    }
}
