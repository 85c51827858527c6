//! The state of the core at a clock, for pictures and tests: contexts, visits, locks and records.
//!
//! Nothing here changes the model, and the model does not use it.

use super::visit::{Bundle, Visit};
use super::ClockModel;
use crate::mesh::Record;

/// The work of a context at a clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    /// The context has no point.
    Idle,
    /// A visit of a walk is in flight.
    Walk,
    /// The root visit is in flight: it takes the lock of the root.
    Root,
    /// Tests are in flight, and the cavity grows.
    Cavity,
    /// The attempt aborts, and its visits in flight complete first.
    Drain,
    /// The attempt has ended without a commit, and the context rests until its retry.
    Rest,
    /// The context waits for its solo insertion, or works at it.
    Solo,
}

impl Activity {
    /// All activities, in the order of their discriminants.
    pub const ALL: [Self; 7] = [Self::Idle, Self::Walk, Self::Root, Self::Cavity, Self::Drain, Self::Rest, Self::Solo];
}

/// A context at a clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContextView {
    /// The work on the point of the context.
    pub activity: Activity,
    /// The vertex that the context inserts, if it has one.
    pub vertex: Option<u32>,
    /// Whether the commit or the release of the last attempt is due, which still has its locks. The next walk may
    /// be under way by then.
    pub is_ending: bool,
    /// Whether the context holds the priority of its team.
    pub has_priority: bool,
}

/// A visit in flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VisitView {
    /// The context that made the visit.
    pub context: u32,
    /// Id of the record that is visited.
    pub record: u32,
    /// Whether the visit takes the lock of the record, as root visits and tests do.
    pub locks: bool,
}

impl ClockModel {
    /// All contexts, in the order of their numbers. O(contexts + visits in flight).
    pub fn contexts(&self) -> Vec<ContextView> {
        let roots = self.visits_in_flight().filter(Visit::is_root).fold(0, |set, visit| set | 1 << visit.context);
        (0..self.config.contexts as usize).map(|context| self.context(context, roots & 1 << context != 0)).collect()
    }

    fn context(&self, context: usize, visits_root: bool) -> ContextView {
        // The flags take note of a completed visit a clock after the attempt did.
        let mut flags = self.registers.contexts;
        if let Some(outcome) = &self.registers.outcome {
            flags.take_outcome(&self.registers, outcome, self.defect);
        }
        let has = |set: u32| set & 1 << context != 0;
        let attempt = &self.tables.attempts[context];
        let activity = match () {
            () if has(flags.solo) => Activity::Solo,
            () if has(flags.asleep) && has(flags.retrying) => Activity::Rest,
            () if has(flags.asleep) => Activity::Idle,
            () if attempt.outstanding > 0 && attempt.drains => Activity::Drain,
            () if attempt.outstanding > 0 => Activity::Cavity,
            () if visits_root => Activity::Root,
            () => Activity::Walk,
        };
        let vertex = (activity != Activity::Idle).then(|| self.memory.point_id[context]);
        ContextView { activity, vertex, is_ending: has(flags.busy), has_priority: has(flags.holders) }
    }

    /// All visits in flight, in the order in which they complete.
    pub fn visits(&self) -> impl Iterator<Item = VisitView> + '_ {
        self.visits_in_flight().map(|visit| VisitView {
            context: visit.context as u32,
            record: visit.record,
            locks: visit.locks,
        })
    }

    fn visits_in_flight(&self) -> impl Iterator<Item = Visit> + '_ {
        let entering = self.registers.push.iter().flat_map(Bundle::visits);
        self.pipeline.visits().chain(entering)
    }

    /// The context that holds the lock of this record, if one does.
    pub fn lock_holder(&self, record: u32) -> Option<u32> {
        self.memory.lock_holder(record).map(|context| context as u32)
    }

    /// The record of this id as it stands in the memory. In the clocks in which a commit writes it, its neighbours may
    /// name records that do not name it yet.
    pub fn record(&self, id: u32) -> Record {
        self.memory.record(id)
    }

    /// Number of records in the mesh. Greater ids may have been written already by a commit that has not ended.
    pub fn records(&self) -> u32 {
        self.registers.commit.records
    }

    /// Number of points that are in the mesh or known to be duplicates.
    pub fn finished_points(&self) -> u32 {
        self.registers.contexts.finished
    }
}
