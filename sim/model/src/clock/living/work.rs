//! The work of a context in a clock: what it asks for, how its item begins and ends, and how its attempt aborts.

use super::commit::Job;
use super::context::{Context, Next};
use super::defect::LivingDefect;
use super::item::Part;
use super::pipeline::Flight;
use super::shared::Shared;
use super::visit::{Ask, Bundle, Visit};
use crate::clock::memory::Memory;
use incircle_protocol::{Located, Outcome, RunKind};

/// A context, with what it shares and what it asks for in this clock.
pub(super) struct Work<'a> {
    pub x: usize,
    pub cx: &'a mut Context,
    pub sh: &'a mut Shared,
    pub memory: &'a Memory,
    pub asked: Bundle,
}

impl Work<'_> {
    pub(super) fn ask(&mut self, ask: Ask, record: u32) {
        self.asked.add(Visit::new(self.x, ask, record));
    }

    /// Asks for a visit that is part of the attempt, across an edge.
    pub(super) fn ask_across(&mut self, ask: Ask, record: u32, from: u32) {
        self.cx.in_flight += 1;
        self.asked.add(Visit::across(self.x, ask, record, from));
    }

    /// Takes the next step of a context whose turn it is.
    pub(super) fn go_on(&mut self) {
        match std::mem::take(&mut self.cx.next) {
            Next::Item => self.begin(),
            Next::Walk(record) => self.ask(Ask::Walk, record),
            Next::Root(record) => self.ask(Ask::Root, record),
        }
    }

    /// Begins the next item, if there is one. An item that is refused at once ends here.
    fn begin(&mut self) {
        if self.cx.items.is_empty() || self.cx.item.is_some() {
            return;
        }
        if !self.sh.may_begin() {
            return self.sh.wake(self.x);
        }
        let Some(item) = self.cx.items.pop_front() else {
            return;
        };
        self.sh.begun += 1;
        self.cx.item = Some(item);
        (self.cx.since, self.cx.aborts) = (self.sh.now, 0);
        self.cx.sight.vertex = item.vertex;
        let near = self.cx.near.into_iter().flatten().next();
        self.cx.near = [None; 2];
        let is_known = self.sh.is_vertex.get(item.vertex as usize).copied();
        let refusal = match (self.sh.kind, is_known) {
            (RunKind::InsertAs, None) => Some(Outcome::Full),
            (RunKind::InsertAs, Some(true)) => Some(Outcome::InUse),
            (RunKind::Delete | RunKind::Move, None | Some(false)) => Some(Outcome::Missing),
            _ => None,
        };
        if let Some(outcome) = refusal {
            return self.end(outcome, item.vertex);
        }
        let sight = &mut self.cx.sight;
        (sight.place, sight.to) = (item.point, item.point);
        self.cx.inserts = self.sh.kind == RunKind::InsertAs;
        if self.cx.inserts {
            self.sh.is_vertex[item.vertex as usize] = true;
        } else if self.sh.kind.is_change() {
            sight.place = self.memory.vertex(item.vertex);
            if self.sh.kind == RunKind::Delete {
                sight.to = sight.place;
            }
        }
        match near {
            Some(root) => self.reach(root),
            None => self.ask(Ask::Walk, self.cx.hint),
        }
    }

    /// Gives the part of an item that ends without a commit, and begins the next one.
    pub(super) fn end(&mut self, outcome: Outcome, vertex: u32) {
        self.end_with(outcome, &Located { vertices: [vertex, 0, 0], weights: [0; 3] });
    }

    /// As [`end`](Self::end), with all words of the part.
    pub(super) fn end_with(&mut self, outcome: Outcome, located: &Located) {
        let Some(item) = self.cx.item.take() else {
            return;
        };
        self.sh.begun -= 1;
        self.sh.counts.latencies.push((self.sh.now - self.cx.since) as u32);
        if self.sh.replies {
            let part = Part::new(self.sh.kind, item.number, outcome, located);
            self.sh.answers.extend(part.words());
        } else {
            self.sh.duplicates += u32::from(outcome == Outcome::Duplicate);
        }
        self.rest();
    }

    /// Leaves the item to the commit of this job, which gives its part, and begins the next one.
    pub(super) fn hand_over(&mut self, job: Job) {
        self.hand_over_later(job, 0);
    }

    /// As [`hand_over`](Self::hand_over), with a commit that begins so many clocks later.
    pub(super) fn hand_over_later(&mut self, mut job: Job, clocks: u64) {
        if let Some(item) = self.cx.item.take() {
            job.ends = true;
            job.part = Some(Part::of_vertex(self.sh.kind, item.number, Outcome::Done, item.vertex));
        }
        self.commit(job, clocks);
        self.rest();
    }

    /// Passes a job with the locks of the attempt to the committer.
    pub(super) fn commit(&mut self, mut job: Job, clocks: u64) {
        job.locks = std::mem::take(&mut self.cx.log);
        if self.sh.lacks(LivingDefect::AnswersBeforeWritten) {
            if let Some(part) = job.part.take() {
                self.sh.answers.extend(part.words());
            }
        }
        // M6: the locks belong to the writes.
        if self.sh.lacks(LivingDefect::ReleasesBeforeWritten) {
            self.cx.log = std::mem::take(&mut job.locks);
            self.release();
        }
        self.cx.due += 1;
        self.return_priority();
        self.sh.commit.push(job, self.sh.now, clocks);
    }

    /// Ends the item of the context, which takes the next one in this clock if it may.
    fn rest(&mut self) {
        self.return_priority();
        self.cx.next = Next::Item;
        if self.x == 0 && self.sh.first_hint.is_none() {
            self.sh.first_hint = Some(self.cx.hint);
        }
        if self.asked.is_empty() && !self.cx.items.is_empty() && self.sh.ready.is_empty() {
            self.begin();
        } else {
            self.sh.wake(self.x);
        }
    }

    pub(super) fn return_priority(&mut self) {
        if self.sh.priority == Some(self.x) {
            self.sh.priority = None;
        }
    }

    /// A walk has found the root of an attempt, which is visited under its lock.
    pub(super) fn reach(&mut self, root: u32) {
        // M1: the locks and lists of the last attempt are in use until its locks are released.
        if self.cx.due == 0 || self.sh.lacks(LivingDefect::OpensWhileBusy) {
            self.ask(Ask::Root, root);
        } else {
            self.cx.held_root = Some(root);
        }
    }

    /// Takes note of a visit of the attempt that has completed. Returns whether the visit counts: no visit does while
    /// the attempt drains, and one at a foreign lock makes it drain, or is made again by the context with the priority.
    pub(super) fn counts(&mut self, flight: &Flight) -> bool {
        self.cx.in_flight -= 1;
        if flight.took {
            self.cx.log.push(flight.visit.record);
        }
        if self.cx.drains {
            return false;
        }
        if flight.torn || flight.foreign && self.sh.priority == Some(self.x) {
            self.sh.counts.waits += u64::from(flight.foreign);
            self.cx.in_flight += 1;
            self.asked.add(flight.visit);
            return false;
        }
        if flight.foreign {
            self.abort();
        }
        !flight.foreign
    }

    /// M4: the attempt aborts. Its visits in flight complete first.
    pub(super) fn abort(&mut self) {
        self.cx.drains = true;
        self.note_abort();
        if self.sh.lacks(LivingDefect::ReleasesBeforeDrained) {
            self.release();
        }
    }

    /// M5: the first context to abort takes the priority.
    pub(super) fn note_abort(&mut self) {
        self.sh.counts.aborts += 1;
        self.cx.aborts += 1;
        if self.sh.priority.is_none() && !self.sh.lacks(LivingDefect::NobodyTakesPriority) {
            self.sh.priority = Some(self.x);
        }
    }

    /// Passes the locks of the attempt to the release.
    pub(super) fn release(&mut self) {
        let locks = std::mem::take(&mut self.cx.log);
        if !locks.is_empty() {
            self.cx.due += 1;
            self.sh.release.push(self.x, locks, false);
        }
    }

    /// Ends an attempt that has drained: the context tries again later, from its root, unless its list is too short.
    pub(super) fn end_drained(&mut self) {
        self.cx.drains = false;
        if self.sh.lacks(LivingDefect::ReleasesBeforeDrained) {
            // The release has passed: nothing clears the locks that visits in flight took after it.
            self.cx.log.clear();
        }
        self.release();
        if std::mem::take(&mut self.cx.overflows) {
            if self.cx.inserts {
                // No other context works beside the solo insertion that follows.
                self.return_priority();
                self.sh.solo.push_back(self.x);
            } else {
                let vertex = self.cx.sight.vertex;
                self.end(Outcome::ManyNeighbors, vertex);
            }
            return;
        }
        self.cx.next = Next::Walk(self.cx.root);
        if self.cx.due == 0 {
            self.cx.rests_until = Some(self.sh.end_of_rest(self.x, self.cx.aborts));
        } else {
            self.cx.will_rest = true;
        }
    }
}
