//! The event counters and the histogram of latencies.

use super::command_port::State as CommandState;
use super::commit::State as CommitState;
use super::pipeline::Pipeline;
use super::wires::{Registers, Wires};
use incircle_protocol::{latency_bucket, Counter, COUNTER_WORDS, LATENCY_BITS, LATENCY_BUCKETS};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counters {
    /// A count of clocks that wraps, for latencies.
    pub now: u32,
    insert_cycles: u64,
    wait_cycles: u64,
    read_cycles: u64,
    pub insertions: u32,
    pub duplicates: u32,
    walk_visits: u32,
    root_visits: u32,
    tests: u32,
    revisits: u32,
    cavity_triangles: u32,
    overflows: u32,
    flips: u32,
    aborts: u32,
    root_retries: u32,
    priorities_taken: u32,
    issue_cycles: u32,
    write_cycles: u32,
    commit_cycles: u32,
    release_cycles: u32,
    latency_min: u32,
    latency_max: u32,
}

impl Counters {
    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, pipeline: &Pipeline) {
        let awaits_point = was.command.state == CommandState::Points && was.command.count != 0 && wires.is_quiet;
        self.now = (self.now + 1) & ((1 << LATENCY_BITS) - 1);
        self.insert_cycles += u64::from(was.command.inserting);
        self.wait_cycles += u64::from(was.command.inserting && awaits_point);
        self.read_cycles += u64::from(was.command.reading);
        self.insertions += if wires.seeds { 3 } else { u32::from(wires.committed.is_some() || wires.solo_inserts) };
        self.flips += u32::from(was.solo.flips());
        self.issue_cycles += u32::from(pipeline.reads());
        self.write_cycles += u32::from(was.write.valid);
        self.commit_cycles += u32::from(was.commit.state != CommitState::Idle);
        self.release_cycles += u32::from(wires.clear.is_some() && was.command.inserting);
        self.tests += u32::from(was.solo.tests());
        self.duplicates += u32::from(wires.solo_ends && !wires.solo_inserts && !wires.changes_mesh);
        self.count_outcome(was, wires);
        if let Some(job) = wires.committed {
            let latency = was.counters.latency_since(job.since);
            let is_first = self.latency_max == 0;
            self.latency_min = if is_first { latency } else { self.latency_min.min(latency) };
            self.latency_max = self.latency_max.max(latency);
        }
        if was.command.clears {
            *self = Self { now: self.now, ..Self::default() };
        }
    }

    fn count_outcome(&mut self, was: &Registers, wires: &Wires) {
        let takes = was.outcome.is_some_and(|outcome| was.contexts.takes_priority(&outcome, was.command.jobs));
        self.priorities_taken += u32::from(takes);
        let (Some(done), Some(outcome)) = (&wires.done, &wires.outcome) else {
            return;
        };
        let kind = (done.visit.rotates, done.visit.locks);
        self.walk_visits += u32::from(kind == (false, false) && !outcome.looks);
        self.root_visits += u32::from(kind == (false, true));
        self.tests += u32::from(kind == (true, true) && !wires.deletes);
        self.revisits += u32::from(outcome.revisits);
        self.duplicates += u32::from(outcome.duplicate && !wires.changes_mesh);
        self.overflows += u32::from(outcome.overflows);
        self.aborts += u32::from(outcome.aborts);
        self.root_retries += u32::from(outcome.root_changed);
        self.cavity_triangles += outcome.commit.map_or(0, |_| outcome.attempt.map_or(0, |attempt| attempt.count - 2));
    }

    /// Number of clocks since `since`.
    pub(super) fn latency_since(&self, since: u32) -> u32 {
        self.now.wrapping_sub(since) & ((1 << LATENCY_BITS) - 1)
    }

    /// The payload of the answer to `Counters`.
    pub(super) fn words(&self, refused: u32) -> [u32; COUNTER_WORDS] {
        let mut words = [0; COUNTER_WORDS];
        for (counter, value) in [
            (Counter::InsertCycles, self.insert_cycles),
            (Counter::WaitCycles, self.wait_cycles),
            (Counter::ReadCycles, self.read_cycles),
        ] {
            words[counter as usize] = value as u32;
            words[counter as usize + 1] = (value >> 32) as u32;
        }
        for (counter, value) in [
            (Counter::Insertions, self.insertions),
            (Counter::Duplicates, self.duplicates),
            (Counter::Refused, refused),
            (Counter::WalkVisits, self.walk_visits),
            (Counter::Tests, self.tests),
            (Counter::CavityTriangles, self.cavity_triangles),
            (Counter::Overflows, self.overflows),
            (Counter::Flips, self.flips),
            (Counter::RootVisits, self.root_visits),
            (Counter::Revisits, self.revisits),
            (Counter::Aborts, self.aborts),
            (Counter::RootRetries, self.root_retries),
            (Counter::PrioritiesTaken, self.priorities_taken),
            (Counter::IssueCycles, self.issue_cycles),
            (Counter::WriteCycles, self.write_cycles),
            (Counter::CommitCycles, self.commit_cycles),
            (Counter::ReleaseCycles, self.release_cycles),
            (Counter::LatencyMin, self.latency_min),
            (Counter::LatencyMax, self.latency_max),
        ] {
            words[counter as usize] = value;
        }
        words
    }
}

/// The numbers of insertions by latency; see [`latency_bucket`].
#[derive(Clone, Debug)]
pub(super) struct Latencies {
    pub buckets: [u32; LATENCY_BUCKETS],
    /// The next bucket that is cleared, after a reset and after `Clear`.
    sweep: Option<usize>,
}

impl Latencies {
    pub(super) fn new() -> Self {
        Self { buckets: [0; LATENCY_BUCKETS], sweep: Some(0) }
    }

    /// Whether the buckets are being cleared.
    pub(super) fn sweeps(&self) -> bool {
        self.sweep.is_some()
    }

    pub(super) fn reset(&mut self) {
        self.sweep = Some(0);
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires) {
        if let Some(job) = wires.committed {
            self.buckets[latency_bucket(was.counters.latency_since(job.since))] += 1;
        }
        if let Some(bucket) = self.sweep {
            self.buckets[bucket] = 0;
            self.sweep = Some(bucket + 1).filter(|&bucket| bucket < LATENCY_BUCKETS);
        }
        if was.command.clears {
            self.sweep = Some(0);
        }
    }
}
