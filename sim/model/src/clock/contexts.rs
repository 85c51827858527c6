//! Which context sleeps, keeps its point, or has writes or locks to get rid of; the waiting token; the turn to be alone.

use super::attempts::Outcome;
use super::wires::Wires;
use super::{Defect, Registers};

/// A bit per context.
pub(super) type Set = u32;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Contexts {
    /// No visit of it is out.
    pub asleep: Set,
    /// It tries its point again when it wakes.
    pub keeps: Set,
    /// Its commit or the release of its locks is due.
    pub busy: Set,
    /// It has had a point.
    pub began: Set,
    /// It has had a commit, so its hint is one.
    pub hinted: Set,
    /// The context that waits at foreign locks instead of giving up.
    pub waiter: Option<usize>,
    /// It has met one, and others that gave up do not start again before it sleeps: they could take the same lock in turns for ever.
    pub held_up: bool,
    /// The context whose list has overflowed; nobody starts until it has inserted its point alone.
    pub solo: Option<usize>,
    /// Points that are in the mesh or known to be duplicates.
    pub finished: u32,
}

impl Contexts {
    /// Contexts that fit a set.
    pub(super) const BITS: u32 = Set::BITS;

    pub(super) fn reset(&mut self, contexts: u32) {
        *self = Self { asleep: Set::MAX >> (Self::BITS - contexts), ..Self::default() };
    }

    /// Nothing is in flight and no lock is held.
    pub(super) fn all_rest(&self, contexts: u32) -> bool {
        self.asleep == Set::MAX >> (Self::BITS - contexts) && self.busy == 0
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, built: u32, defect: Option<Defect>) {
        if let Some(outcome) = &wires.outcome {
            self.take_outcome(was, outcome, defect);
        }
        if let Some(context) = wires.start.map(|start| start.context) {
            self.asleep &= !(1 << context);
            self.keeps &= !(1 << context);
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
            if self.waiter == self.solo {
                self.waiter = None;
            }
            if let Some(context) = self.solo.take() {
                self.keeps &= !(1 << context);
            }
            self.finished += 1;
        }
        if wires.seeds {
            self.finished = 3;
        }
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
        if outcome.keeps {
            self.keeps |= bit;
        }
        if outcome.commit.is_some() || outcome.release.is_some() {
            self.busy |= bit;
        }
        if outcome.stops_waiting && was.contexts.waiter == Some(context) {
            self.waiter = None;
        }
        if outcome.asks_to_wait && was.contexts.waiter.is_none() && defect != Some(Defect::NobodyWaits) {
            self.waiter = Some(context);
        }
        if outcome.is_held_up {
            self.held_up = defect != Some(Defect::NobodyYields);
        } else if outcome.sleeps && was.contexts.waiter == Some(context) {
            self.held_up = false;
        }
        if outcome.overflows && was.contexts.solo.is_none() {
            self.solo = Some(context);
        }
        self.finished += u32::from(outcome.duplicate);
    }
}
