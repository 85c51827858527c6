//! What the contexts of the living engine share.

use super::answers::Answers;
use super::commit::Committer;
use super::counts::RunCounts;
use super::defect::LivingDefect;
use super::release::Releaser;
use crate::mesh::free::FreeRecords;
use incircle_protocol::{triangle_capacity, Config, RunKind};
use std::collections::VecDeque;

#[derive(Clone, Debug)]
pub(super) struct Shared {
    pub config: Config,
    pub defect: Option<LivingDefect>,
    pub now: u64,
    pub kind: RunKind,
    /// Whether each item has a part in the answer, as those of a run have, and the points of an `Insert` have not.
    pub replies: bool,
    /// The context that waits at foreign locks where all others abort.
    pub priority: Option<usize>,
    /// Contexts that wait for a place in the queue of visits.
    pub ready: VecDeque<usize>,
    /// Contexts that wait for their solo insertion.
    pub solo: VecDeque<usize>,
    pub free: FreeRecords,
    /// Ids from here on have had no record yet.
    pub records: u32,
    /// For each vertex, whether it is in the mesh.
    pub is_vertex: Vec<bool>,
    /// Number of vertices.
    pub vertices: u32,
    /// One more than the highest vertex that has been used.
    pub arrived: u32,
    pub duplicates: u32,
    pub refused: u32,
    /// The record at which the first context was when it ended its first item.
    pub first_hint: Option<u32>,
    /// Number of items that have begun and have no part yet.
    pub begun: u32,
    pub answers: Answers,
    pub commit: Committer,
    pub release: Releaser,
    pub counts: RunCounts,
}

impl Shared {
    pub(super) fn new(config: Config, defect: Option<LivingDefect>) -> Self {
        Self {
            config,
            defect,
            now: 0,
            kind: RunKind::Locate,
            replies: true,
            priority: None,
            ready: VecDeque::new(),
            solo: VecDeque::new(),
            free: FreeRecords::default(),
            records: 0,
            is_vertex: vec![false; config.points as usize],
            vertices: 0,
            arrived: 0,
            duplicates: 0,
            refused: 0,
            first_hint: None,
            begun: 0,
            answers: Answers::default(),
            commit: Committer::default(),
            release: Releaser::default(),
            counts: RunCounts::default(),
        }
    }

    /// Whether the model lacks this rule.
    pub(super) fn lacks(&self, rule: LivingDefect) -> bool {
        self.defect == Some(rule)
    }

    /// An id for a record beyond those that an insertion replaces.
    pub(super) fn new_record(&mut self) -> u32 {
        let are_all_used = self.records >= triangle_capacity(self.config.points);
        self.free.take(are_all_used).unwrap_or_else(|| {
            self.records += 1;
            self.records - 1
        })
    }

    /// Whether another item may begin: there is room for its part.
    pub(super) fn may_begin(&self) -> bool {
        self.solo.is_empty() && (!self.replies || self.answers.has_room(self.begun + 1, self.kind.part_words()))
    }

    /// Makes a context wait for a place in the queue of visits.
    pub(super) fn wake(&mut self, context: usize) {
        if !self.ready.contains(&context) {
            self.ready.push_back(context);
        }
    }

    /// The clock in which a context that has aborted so often is ready again. Contexts rest for different times, so
    /// that they do not meet again and again.
    pub(super) fn end_of_rest(&self, context: usize, aborts: u32) -> u64 {
        let is_first = self.priority == Some(context);
        self.now + if is_first { 4 } else { 8 + (7 * context as u64 + 5 * u64::from(aborts)) % 32 }
    }
}
