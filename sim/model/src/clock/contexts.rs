//! Which context sleeps, keeps its point, or has writes or locks to get rid of; the priority; the turn to be alone.

use super::attempts::Outcome;
use super::defect::Defect;
use super::wires::{Registers, Wires};

/// A bit per context.
pub(super) type Set = u32;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Contexts {
    /// No visit of it is out.
    pub asleep: Set,
    /// It tries its point again when it wakes.
    pub retrying: Set,
    /// Its commit or the release of its locks is due.
    pub busy: Set,
    /// It has had a point.
    pub began: Set,
    /// It has had a commit, so its hint is one.
    pub hinted: Set,
    /// The context that waits at foreign locks instead of giving up.
    pub priority_context: Option<usize>,
    /// How often it has met a foreign lock since it took the priority, up to `URGENT`.
    waits: u32,
    /// The context whose list has overflowed; nobody starts until it has inserted its point alone.
    pub solo: Option<usize>,
    /// Points that are in the mesh or known to be duplicates.
    pub finished: u32,
    /// Nothing is in flight and no lock is held, as it was known a clock ago, and nobody has started since.
    pub rest: bool,
}

/// L3: foreign locks that the holder of the priority meets before the others stop trying again.
const URGENT: u32 = 8;

impl Contexts {
    /// Contexts that fit a set.
    pub(super) const BITS: u32 = Set::BITS;

    pub(super) fn reset(&mut self, contexts: u32) {
        *self = Self { asleep: Set::MAX >> (Self::BITS - contexts), ..Self::default() };
    }

    /// Whether a context may try its point again. Contexts that fail again and again could keep the one that waits from its locks for
    /// ever, in step with it: when it has waited for long, only it tries again, and new points.
    pub(super) fn may_try_again(&self, context: usize) -> bool {
        self.waits < URGENT || self.priority_context.is_none_or(|holder| holder == context)
    }

    /// Nothing is in flight and no lock is held.
    fn all_rest(&self, contexts: u32) -> bool {
        self.asleep == Set::MAX >> (Self::BITS - contexts) && self.busy == 0
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, built: u32, defect: Option<Defect>) {
        if let Some(outcome) = &was.outcome {
            self.take_outcome(was, outcome, defect);
        }
        if let Some(context) = wires.start.map(|start| start.context) {
            self.asleep &= !(1 << context);
            self.retrying &= !(1 << context);
            self.began |= 1 << context;
        }
        if let Some(context) = wires.released {
            self.busy &= !(1 << context);
        }
        if let Some(job) = wires.committed {
            self.hinted |= 1 << job.context;
            self.finished += 1;
        }
        if wires.solo_ends {
            if self.priority_context == self.solo {
                self.priority_context = None;
            }
            if let Some(context) = self.solo.take() {
                self.retrying &= !(1 << context);
            }
            self.finished += 1;
        }
        if wires.seeds {
            self.finished += 3;
        }
        self.rest = was.contexts.all_rest(built) && wires.start.is_none();
        if was.command.clears {
            self.reset(built);
        }
    }

    fn take_outcome(&mut self, was: &Registers, outcome: &Outcome, defect: Option<Defect>) {
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
        if outcome.returns_priority && was.contexts.priority_context == Some(context) {
            self.priority_context = None;
        }
        // L2: the priority goes to who asks while it is free.
        if outcome.asks_for_priority
            && was.contexts.priority_context.is_none()
            && defect != Some(Defect::NobodyTakesPriority)
        {
            self.priority_context = Some(context);
            self.waits = 0;
        }
        if outcome.waits {
            self.waits = (self.waits + 1).min(URGENT);
        }
        if outcome.overflows && was.contexts.solo.is_none() {
            self.solo = Some(context);
        }
        self.finished += u32::from(outcome.duplicate);
    }
}
