//! The visits of questions on their way through the pipeline. During a run of questions no record changes, so a visit
//! carries no record: it is read when the visit completes.
//!
//! Hardware twin: the block `VisitPipeline`.

use std::collections::VecDeque;

/// Number of clocks from the issue register to the completion register.
const STAGES: usize = 16;

/// The purpose of a visit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Aim {
    /// A step of a walk.
    Walk,
    /// The search along the hull, with the end of the hull edge of the ghost triangle that was visited before.
    Hull { end: u32 },
    /// A chain round the nearest vertex, to the left or to the right.
    Around { left: bool, parity: bool },
    /// A record with the nearest vertex, once more.
    Look,
}

/// A visit of a question.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit {
    pub context: usize,
    pub record: u32,
    /// The record from which a visit of a chain came.
    pub from: u32,
    pub aim: Aim,
}

impl Visit {
    pub(super) fn walk(context: usize, record: u32) -> Self {
        Self { context, record, from: record, aim: Aim::Walk }
    }
}

/// Up to two visits that enter the queue in one clock.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bundle([Option<Visit>; 2]);

impl Bundle {
    pub(super) fn one(visit: Visit) -> Self {
        Self([Some(visit), None])
    }

    pub(super) fn add(&mut self, visit: Visit) {
        if let Some(place) = self.0.iter_mut().find(|place| place.is_none()) {
            *place = Some(visit);
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0[0].is_none()
    }
}

/// The visits in flight.
#[derive(Clone, Debug)]
pub(super) struct Visits {
    entering: Bundle,
    queue: VecDeque<Visit>,
    issued: Option<Visit>,
    /// The oldest first, with `None` for clocks without a visit.
    stages: VecDeque<Option<Visit>>,
}

impl Visits {
    pub(super) fn new() -> Self {
        Self {
            entering: Bundle::default(),
            queue: VecDeque::new(),
            issued: None,
            stages: VecDeque::from(vec![None; STAGES]),
        }
    }

    /// The visit that completes in this clock.
    pub(super) fn completion(&self) -> Option<Visit> {
        self.stages.front().copied().flatten()
    }

    /// Simulates one edge, at which these visits are asked for.
    pub(super) fn clock(&mut self, asked: Bundle) {
        self.stages.pop_front();
        self.stages.push_back(self.issued);
        self.queue.extend(self.entering.0.into_iter().flatten());
        self.issued = self.queue.pop_front();
        self.entering = asked;
    }
}
