//! The completion of visits: what each visit asks for next, and the attempt of every context.
//!
//! Hardware twin: the block `Attempts`.
//!
//! A completing visit belongs to one context, and the state of that context's attempt is read, changed and written back
//! in the same clock. Nothing else changes that state, so two visits can never interfere.

use super::attempt::Attempt;
use super::commit_job::CommitJob;
use super::defect::Defect;
use super::memory::{Entry, Memory};
use super::outcome::{Around, Outcome};
use super::release_job::ReleaseJob;
use super::visit::{Bundle, Completion};
use super::wires::Wires;

impl Outcome {
    pub(super) fn of(done: &Completion, around: &Around) -> Self {
        let out = Self { context: done.visit.context, ..Self::default() };
        match (done.visit.rotates, done.visit.locks) {
            (false, false) => out.walk(done, around),
            (false, true) => out.root(done, around),
            _ => out.test(done, around),
        }
    }

    fn walk(mut self, done: &Completion, around: &Around) -> Self {
        let context = done.visit.context;
        if !around.was.seeder.seeded {
            self.looks = true;
            self.sleeps = true;
            return self;
        }
        // L7: the record was not written yet, or was being written.
        if done.again {
            return self.again(done);
        }
        // L10: the first record on the walk that conflicts with the point is the root, whether it holds the point or
        // not.
        let ends = match around.defect {
            Some(Defect::WalksToTheEnd) => done.located,
            _ => done.conflict,
        };
        if done.falls_onto_corner {
            self.duplicate = true;
            self.returns_priority = true;
            self.sleeps = true;
        } else if !ends || done.is_free {
            self.push = Some(Bundle::look(context, done.walk_next));
        } else if around.is_busy(context) {
            return self.again(done);
        } else {
            self.push = Some(Bundle::root(context, done.visit.record));
        }
        self
    }

    /// L5: the root visit reads the root under its lock, because what the walk saw may not be true any more.
    fn root(mut self, done: &Completion, around: &Around) -> Self {
        let record = done.visit.record;
        let trusts = around.defect == Some(Defect::TrustsTheWalk);
        let (conflict, on_corner) = (done.conflict || trusts, done.falls_onto_corner && !trusts);
        if done.foreign {
            return self.foreign_root(done, around);
        }
        self.lock = Some((0, record));
        if conflict && !on_corner {
            self.push = Some(Bundle::tests(done));
            self.attempt = Some(Attempt { outstanding: 3, count: 3, logged: 1, ..Attempt::default() });
            self.root = Some(record);
            return self;
        }
        self.release = Some(ReleaseJob { context: self.context, locks: 1 });
        if on_corner {
            self.duplicate = true;
            self.returns_priority = true;
            self.sleeps = true;
            self.root = Some(record);
            return self;
        }
        self.root_changed = true;
        self.abort(done.walk_next)
    }

    fn test(mut self, done: &Completion, around: &Around) -> Self {
        let mut state = around.attempt;
        if !self.takes_lock(done, around, &mut state) {
        } else if !done.conflict {
            let Completion { visit, record, slot, .. } = *done;
            self.entry = Some((
                visit.entry,
                Entry {
                    first_vertex: record.v[2],
                    outside_record: visit.record,
                    slot,
                    cavity_record: visit.cavity_record,
                    after: visit.after,
                },
            ));
        } else if state.count == around.config.ring {
            state.drains = true;
            self.overflows = true;
            // No other context works beside the solo insertion that follows.
            self.returns_priority = true;
        } else {
            self.split(done, &mut state);
        }
        // L1: the locks are released when all visits of the attempt have completed.
        let ends = match around.defect {
            Some(Defect::ReleasesBeforeDrained) => state.outstanding == 0 && !around.attempt.drains || self.aborts,
            _ => state.outstanding == 0,
        };
        if ends {
            self.end(&state, around);
        }
        self.attempt = Some(state);
        self
    }

    fn split(&mut self, done: &Completion, state: &mut Attempt) {
        let y = state.count as usize;
        self.push = Some(Bundle::split(done, y));
        state.count += 1;
        state.outstanding += 2;
        if state.passes_last_edge(done.visit.cavity_entry) {
            self.inner = Some((state.inners, done.visit.cavity_record));
            state.inners += 1;
        }
    }

    /// Ends an attempt, whose last visit has completed.
    fn end(&mut self, state: &Attempt, around: &Around) {
        self.sleeps = true;
        if state.drains {
            self.will_retry = true;
            self.release = Some(ReleaseJob { context: self.context, locks: state.logged });
        } else {
            self.returns_priority = true;
            self.commit = Some(CommitJob {
                context: self.context,
                vertex: around.vertex,
                inners: state.inners,
                locks: state.logged,
                since: around.since,
            });
        }
    }
}

/// The state of every context. Each field is a small memory with a word for each context.
#[derive(Clone, Debug)]
pub(super) struct Tables {
    pub attempts: Vec<Attempt>,
    /// The record at which a context starts to walk: the root of its last attempt, or the record to which its walk goes
    /// on if that root has changed.
    pub root: Vec<u32>,
}

impl Tables {
    pub(super) fn new(contexts: u32) -> Self {
        let contexts = contexts as usize;
        Self { attempts: vec![Attempt::default(); contexts], root: vec![0; contexts] }
    }

    pub(super) fn clock(&mut self, wires: &Wires, memory: &mut Memory) {
        let Some(outcome) = &wires.outcome else {
            return;
        };
        let context = outcome.context;
        if let Some(attempt) = outcome.attempt {
            self.attempts[context] = attempt;
        }
        if let Some(root) = outcome.root {
            self.root[context] = root;
        }
        if let Some((place, entry)) = outcome.entry {
            memory.entries[context][place] = entry;
        }
        if let Some((place, id)) = outcome.inner {
            memory.inner[context][place as usize] = id;
        }
        if let Some((place, id)) = outcome.lock {
            memory.lock_log[context][place as usize] = id;
        }
    }
}
