//! The contexts and what their visits lead to: who starts, what follows a visit, stars written, locks released.
//!
//! Latency: see the blocks.

use super::attempt::Attempts;
use super::commit::CommitPath;
use super::dispatch::Dispatcher;
use super::types::{Bundle, Deal, Events, Token, Turned, Verdict, Write};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// Insertions in flight; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Insertions {
    /// Reset drops everything at work; clear forgets the mesh.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// Parameters, constants.
    pub ring: Signal<In, Bits<7>>,
    pub last_id: Signal<In, Bits<15>>,
    pub all: Signal<In, Bits<24>>,
    pub patience: Signal<In, Bits<22>>,
    /// Contexts that work, and which points are theirs; points that have come; one is being stored; the time.
    pub deal: Signal<In, Deal>,
    pub arrived: Signal<In, Bits<15>>,
    pub came: Signal<In, Bit>,
    pub now: Signal<In, Bits<22>>,
    pub early_done: Signal<In, Bit>,
    pub early_token: Signal<In, Token>,
    pub early_turned: Signal<In, Turned>,
    pub token: Signal<In, Token>,
    pub turned: Signal<In, Turned>,
    pub verdict: Signal<In, Verdict>,
    /// The first triangle, see `Seeder`.
    pub seeded: Signal<In, Bit>,
    pub has_no_start: Signal<In, Bit>,
    pub seeds: Signal<In, Bit>,
    /// The insertion alone.
    pub solo_is_at_work: Signal<In, Bit>,
    pub solo_ends: Signal<In, Bit>,
    pub solo_inserts: Signal<In, Bit>,
    /// The visit that completes asks for others; it may; they.
    pub asks: Signal<Out, Bit>,
    pub may_ask: Signal<Out, Bit>,
    pub follows: Signal<Out, Bundle>,
    /// A context starts to walk at this record, while nobody may ask.
    pub starts: Signal<Out, Bit>,
    pub starter: Signal<Out, Bits<5>>,
    pub u: Signal<Out, Bits<15>>,
    /// The visit that completes is the look at the first three points.
    pub looks: Signal<Out, Bit>,
    /// A point to fetch; its context, when it has come.
    pub fetch_id: Signal<Out, Bits<15>>,
    pub position_enable: Signal<Out, Bit>,
    pub position_owner: Signal<Out, Bits<5>>,
    /// An insertion alone starts, from `u` on.
    pub solo_starts: Signal<Out, Bit>,
    pub solo_owner: Signal<Out, Bits<5>>,
    pub solo_p: Signal<Out, Bits<15>>,
    /// A record or a link; records from this id on are not written yet; the next new id.
    pub write: Signal<Out, Write>,
    pub records: Signal<Out, Bits<15>>,
    pub fresh: Signal<Out, Bits<15>>,
    /// A lock to clear; the lock memory is being cleared after reset.
    pub clear_enable: Signal<Out, Bit>,
    pub clear_id: Signal<Out, Bits<15>>,
    pub sweeps: Signal<Out, Bit>,
    /// Every point is finished; nothing is finished any more.
    pub is_quiet: Signal<Out, Bit>,
    pub stuck: Signal<Out, Bit>,
    /// What happens at this edge, but for what others know.
    pub events: Signal<Out, Events>,
    dispatcher: Dispatcher,
    attempts: Attempts,
    commits: CommitPath,
}

impl Insertions {
    /// The insertions of a configuration.
    pub fn new(config: Config) -> Self {
        Self {
            dispatcher: Dispatcher::new(config),
            attempts: Attempts::new(config),
            commits: CommitPath::new(config),
            ..Self::default()
        }
    }
}

impl Logic for Insertions {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, dispatcher, attempts, commits);
        self.dispatcher.reset.next = self.reset.val();
        self.dispatcher.clears.next = self.clears.val();
        self.commits.reset.next = self.reset.val();
        self.commits.clears.next = self.clears.val();

        // A visit completes.
        self.attempts.ring.next = self.ring.val();
        self.attempts.early_done.next = self.early_done.val();
        self.attempts.early_token.next = self.early_token.val();
        self.attempts.early_turned.next = self.early_turned.val();
        self.attempts.token.next = self.token.val();
        self.attempts.turned.next = self.turned.val();
        self.attempts.verdict.next = self.verdict.val();
        self.attempts.seeded.next = self.seeded.val();
        self.attempts.now.next = self.now.val();
        self.attempts.busy.next = self.dispatcher.busy.val();
        self.attempts.waiter_valid.next = self.dispatcher.waiter_valid.val();
        self.attempts.waiter.next = self.dispatcher.waiter.val();
        self.attempts.takes.next = self.dispatcher.takes.val();
        self.attempts.taken_id.next = self.dispatcher.taken_id.val();
        self.attempts.taker.next = self.dispatcher.starter.val();
        self.looks.next = self.attempts.looks.val();
        self.asks.next = self.attempts.asks.val();
        self.may_ask.next = self.attempts.may_ask.val();
        self.follows.next = self.attempts.bundle.val();

        // Who starts, and what is finished.
        self.dispatcher.all.next = self.all.val();
        self.dispatcher.patience.next = self.patience.val();
        self.dispatcher.deal.next = self.deal.val();
        self.dispatcher.arrived.next = self.arrived.val();
        self.dispatcher.came.next = self.came.val();
        self.dispatcher.seeded.next = self.seeded.val();
        self.dispatcher.has_no_start.next = self.has_no_start.val();
        self.dispatcher.seeds.next = self.seeds.val();
        self.dispatcher.solo_is_at_work.next = self.solo_is_at_work.val();
        self.dispatcher.solo_ends.next = self.solo_ends.val();
        self.dispatcher.owner.next = self.attempts.owner.val();
        self.dispatcher.sleeps.next = self.attempts.sleeps.val();
        self.dispatcher.keeps.next = self.attempts.keeps.val();
        self.dispatcher.asks_to_wait.next = self.attempts.asks_to_wait.val();
        self.dispatcher.waits.next = self.attempts.waits.val();
        self.dispatcher.stops_waiting.next = self.attempts.stops_waiting.val();
        self.dispatcher.overflows.next = self.attempts.overflows.val();
        self.dispatcher.duplicate.next = self.attempts.duplicate.val();
        self.dispatcher.root_enable.next = self.attempts.root_enable.val();
        self.dispatcher.root.next = self.attempts.root.val();
        self.dispatcher.hands_over.next = self.attempts.commit_enable.val() | self.attempts.release_enable.val();
        self.dispatcher.is_done.next = self.attempts.is_done.val();
        self.dispatcher.may_ask.next = self.attempts.may_ask.val();
        self.dispatcher.commit_ends.next = self.commits.ends.val();
        self.dispatcher.commit_owner.next = self.commits.job.val().owner;
        self.dispatcher.hint.next = self.commits.hint.val();
        self.dispatcher.released.next = self.commits.released.val();
        self.dispatcher.released_owner.next = self.commits.released_owner.val();
        self.starts.next = self.dispatcher.starts.val();
        self.starter.next = self.dispatcher.starter.val();
        self.u.next = self.dispatcher.u.val();
        self.fetch_id.next = self.dispatcher.taken_id.val();
        self.position_enable.next = self.dispatcher.position_enable.val();
        self.position_owner.next = self.dispatcher.position_owner.val();
        self.solo_starts.next = self.dispatcher.solo_starts.val();
        self.solo_owner.next = self.dispatcher.solo_owner.val();
        self.solo_p.next = self.dispatcher.solo_p.val();
        self.is_quiet.next = self.dispatcher.is_quiet.val();
        self.stuck.next = self.dispatcher.stuck.val();

        // The star and the locks.
        self.commits.last_id.next = self.last_id.val();
        self.commits.seeds.next = self.seeds.val();
        self.commits.solo_inserts.next = self.solo_inserts.val();
        self.commits.owner.next = self.attempts.owner.val();
        self.commits.entry_enable.next = self.attempts.entry_enable.val();
        self.commits.entry_place.next = self.attempts.entry_place.val();
        self.commits.entry.next = self.attempts.entry.val();
        self.commits.inner_enable.next = self.attempts.inner_enable.val();
        self.commits.inner_place.next = self.attempts.inner_place.val();
        self.commits.inner_id.next = self.attempts.inner_id.val();
        self.commits.lock_enable.next = self.attempts.lock_enable.val();
        self.commits.lock_place.next = self.attempts.lock_place.val();
        self.commits.lock_id.next = self.attempts.lock_id.val();
        self.commits.commit_enable.next = self.attempts.commit_enable.val();
        self.commits.commit_job.next = self.attempts.commit_job.val();
        self.commits.release_enable.next = self.attempts.release_enable.val();
        self.commits.release_job.next = self.attempts.release_job.val();
        self.write.next = self.commits.write.val();
        self.records.next = self.commits.records.val();
        self.fresh.next = self.commits.fresh.val();
        self.clear_enable.next = self.commits.clear_enable.val();
        self.clear_id.next = self.commits.clear_id.val();
        self.sweeps.next = self.commits.sweeps.val();

        // For the counters; the rest is filled in where it is known.
        self.events.next.seeds = self.seeds.val();
        self.events.next.commit_ends = self.commits.ends.val();
        self.events.next.since = self.commits.job.val().since;
        self.events.next.duplicate = self.attempts.duplicate.val();
        self.events.next.walk_visit = self.attempts.walk_visit.val();
        self.events.next.root_visit = self.attempts.root_visit.val();
        self.events.next.test = self.attempts.test.val();
        self.events.next.revisit = self.attempts.revisit.val();
        self.events.next.overflow = self.attempts.overflows.val();
        self.events.next.gives_up = self.attempts.gives_up.val();
        self.events.next.root_retry = self.attempts.retries.val();
        self.events.next.takes_token = self.dispatcher.takes_token.val();
        self.events.next.cavity_ends = self.attempts.commit_enable.val();
        self.events.next.cavity_triangles = self.attempts.cavity_triangles.val();
        self.events.next.is_committing = self.commits.is_at_work.val();
        self.events.next.is_releasing = self.commits.clear_enable.val();
        self.events.next.solo_inserts = self.solo_inserts.val();
        self.events.next.solo_duplicate = self.solo_ends.val() & (!self.solo_inserts.val());
        self.events.next.solo_test = false;
        self.events.next.flip = false;
        self.events.next.is_issuing = false;
        self.events.next.is_writing = false;
    }
}
