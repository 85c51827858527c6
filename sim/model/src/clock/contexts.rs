//! The flags of the contexts: asleep, retrying, with a commit or release due, or asking for a solo insertion; and the
//! priority of each team.
//!
//! Hardware twins: the blocks `ContextFlags` and `Priorities`.

use super::defect::Defect;
use super::outcome::Outcome;
use super::wires::{Registers, Wires};

/// A set of contexts, with one bit for each.
pub(super) type Set = u32;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Contexts {
    /// Contexts without a visit in flight.
    pub asleep: Set,
    /// Contexts that try their point again when they wake.
    pub retrying: Set,
    /// Contexts whose commit, or release of locks, is due.
    pub busy: Set,
    /// Contexts that have had a point.
    pub began: Set,
    /// Contexts that have had a commit, so that they have a root at which the next walk can start.
    pub hinted: Set,
    /// Contexts that hold the priority of their team: they wait at foreign locks instead of aborting.
    pub holders: Set,
    /// For each team, the number of foreign locks that the context with the priority has met since it took the
    /// priority, up to `URGENT`.
    waits: [u8; Self::BITS as usize],
    /// Contexts whose list has overflowed. No context starts until the solo insertion of each of their points has
    /// ended.
    pub solo: Set,
    /// Number of points that are in the mesh or known to be duplicates.
    pub finished: u32,
    /// Whether, as known a clock ago, nothing was in flight and no lock was held, and no context has started since.
    pub rest: bool,
}

/// L3: number of foreign locks that the context with the priority meets before the others of its team stop retrying.
const URGENT: u8 = 8;

/// The team of a context, which works on the job of that number.
pub(super) fn team_of(context: usize, jobs: u32) -> usize {
    context % jobs as usize
}

/// The contexts of a team.
fn members(team: usize, jobs: u32) -> Set {
    (team..Contexts::BITS as usize).step_by(jobs as usize).fold(0, |members, context| members | 1 << context)
}

impl Contexts {
    /// Largest number of contexts in a set.
    pub(super) const BITS: u32 = Set::BITS;

    pub(super) fn reset(&mut self, contexts: u32) {
        *self = Self { asleep: Set::MAX >> (Self::BITS - contexts), ..Self::default() };
    }

    /// Whether a context may try its point again. Contexts that abort and retry in step with the context that holds
    /// the priority of their team could keep that one from its locks for ever. When it has waited for long, no other
    /// context of the team retries; new points still start.
    pub(super) fn may_try_again(&self, context: usize, jobs: u32) -> bool {
        let others = self.holders & members(team_of(context, jobs), jobs) & !(1 << context);
        others == 0 || self.waits[team_of(context, jobs)] < URGENT
    }

    /// Whether a visit makes its context take the priority of its team.
    pub(super) fn takes_priority(&self, outcome: &Outcome, jobs: u32) -> bool {
        outcome.asks_for_priority && self.holders & members(team_of(outcome.context, jobs), jobs) == 0
    }

    /// Whether nothing is in flight and no lock is held.
    fn all_rest(&self, contexts: u32) -> bool {
        self.asleep == Set::MAX >> (Self::BITS - contexts) && self.busy == 0
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, built: u32, defect: Option<Defect>) {
        if let Some(outcome) = &was.outcome {
            self.take_outcome(was, outcome, defect);
        }
        let launched = wires.launch.map(|launch| launch.context);
        if let Some(context) = wires.start.map(|start| start.context).or(launched) {
            self.asleep &= !(1 << context);
            self.retrying &= !(1 << context);
            self.began |= 1 << context;
        }
        if let Some(end) = wires.fill_end {
            self.asleep |= 1 << end.context;
            self.busy |= 1 << end.context;
            self.holders &= !(1 << end.context);
        }
        if let Some(context) = wires.released {
            self.busy &= !(1 << context);
        }
        if let Some(job) = wires.committed {
            self.hinted |= 1 << job.context;
            self.finished += 1;
        }
        if wires.solo_ends {
            self.solo &= !(1 << was.solo.context());
            self.retrying &= !(1 << was.solo.context());
            self.finished += 1;
        }
        if wires.seeds {
            self.finished += 3;
        }
        self.rest = was.contexts.all_rest(built) && wires.start.is_none() && launched.is_none();
        if was.command.clears {
            self.reset(built);
        }
    }

    pub(super) fn take_outcome(&mut self, was: &Registers, outcome: &Outcome, defect: Option<Defect>) {
        let context = outcome.context;
        let bit = 1 << context;
        if outcome.sleeps {
            self.asleep |= bit;
        }
        if outcome.will_retry {
            self.retrying |= bit;
        }
        if outcome.commit.is_some() || outcome.release.is_some() {
            self.busy |= bit;
        }
        if outcome.returns_priority {
            self.holders &= !bit;
        }
        // L2: the priority of a team goes to the first of its contexts that asks while the priority is free.
        let jobs = if defect == Some(Defect::OnePriority) { 1 } else { was.command.jobs };
        let waits = &mut self.waits[team_of(context, jobs)];
        if was.contexts.takes_priority(outcome, jobs) && defect != Some(Defect::NobodyTakesPriority) {
            self.holders |= bit;
            *waits = 0;
        }
        if outcome.waits {
            *waits = (*waits + 1).min(URGENT);
        }
        if outcome.overflows {
            self.solo |= bit;
        }
        self.finished += u32::from(outcome.duplicate);
    }
}
