//! The ends of commits and releases, and the beginning of solo insertions, which wait for them.

use incircle_protocol::Outcome;

use super::commit::{Committed, Job, Step};
use super::context::Next;
use super::defect::LivingDefect;
use super::solo::Solo;
use super::visit::Bundle;
use super::work::Work;
use super::LivingEngine;
use crate::clock::memory::Memory;

impl LivingEngine {
    /// Takes note of a step of the committer.
    pub(super) fn note(&mut self, committed: Committed, memory: &mut Memory) {
        if let Some((vertex, point)) = committed.point {
            memory.set_vertex(vertex, point);
        }
        if let Some(id) = committed.freed {
            self.sh.free.put(id);
        }
        if let Some(job) = committed.ended {
            self.end_job(job);
        }
    }

    /// Ends a job whose last step is written: its part is given, and its locks are due for release.
    fn end_job(&mut self, job: Job) {
        let x = job.context;
        if job.ends {
            self.sh.begun -= 1;
            self.sh.counts.latencies.push((self.sh.now - job.since) as u32);
            if let Some(part) = job.part.filter(|_| self.sh.replies) {
                self.sh.answers.extend(part.words());
            }
        }
        // M6: the locks are due for release when the last record is written.
        if job.locks.is_empty() {
            self.note_release(x);
        } else {
            self.sh.release.push(x, job.locks, true);
        }
        if self.solo_runs && self.sh.solo.front() == Some(&x) {
            self.solo_runs = false;
            self.sh.solo.pop_front();
        }
    }

    /// The last lock of an attempt has been cleared.
    pub(super) fn note_release(&mut self, x: usize) {
        let context = &mut self.contexts[x];
        context.due -= 1;
        if context.due > 0 {
            return;
        }
        if let Some(root) = context.held_root.take() {
            context.next = Next::Root(root);
            self.sh.wake(x);
        } else if std::mem::take(&mut context.will_rest) {
            context.rests_until = Some(self.sh.end_of_rest(x, context.aborts));
        }
    }

    /// Begins the solo insertion of the first context that waits for one, when no other works.
    pub(super) fn begin_solo(&mut self, memory: &Memory) {
        // M13: flips take no locks.
        let rests = self.pipeline.is_empty() && self.sh.commit.is_idle() && self.sh.release.is_idle();
        let may = rests || self.sh.defect == Some(LivingDefect::SoloBesideOthers);
        let Some(&x) = self.sh.solo.front().filter(|_| may && !self.solo_runs) else {
            return;
        };
        self.sh.counts.solos += 1;
        let context = &mut self.contexts[x];
        let sight = context.sight;
        let mut solo = Solo::new(memory, sight);
        match solo.find(context.root) {
            Err(other) => {
                self.sh.solo.pop_front();
                self.sh.is_vertex[sight.vertex as usize] = false;
                // The next item begins in another clock.
                self.sh.wake(x);
                let mut work = Work { x, cx: context, sh: &mut self.sh, memory, asked: Bundle::default() };
                work.end(Outcome::Duplicate, other);
            }
            Ok(root) => {
                let ids = [self.sh.new_record(), self.sh.new_record()];
                solo.insert(root, ids);
                let mut job = Job::new(x, context.since);
                job.steps = solo.writes.iter().map(|&write| Step::Write(write)).collect();
                job.point = Some((sight.vertex, sight.to));
                let clocks = solo.clocks();
                let mut work = Work { x, cx: context, sh: &mut self.sh, memory, asked: Bundle::default() };
                work.note_vertex();
                work.hand_over_later(job, clocks);
                self.solo_runs = true;
            }
        }
    }
}
