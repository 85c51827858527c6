//! Hands points to contexts, and knows when all are finished or nothing is any more.
//!
//! 1. What becomes of a context is noted a clock after its visit completes: from then on it may start, and is asked whether it waits.
//!
//! Latency: see the blocks.

use super::context_flags::ContextFlags;
use super::progress::Progress;
use super::starter::Starter;
use super::watchdog::Watchdog;
use crate::engine::types::Deal;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Contexts at work; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Dispatcher {
    /// Reset and clear put all contexts to sleep.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// Contexts that are built, clocks without a finished point: constants.
    pub all: Signal<In, Bits<24>>,
    pub patience: Signal<In, Bits<22>>,
    /// Contexts that work, and which points are theirs; points that have come; one is being stored.
    pub deal: Signal<In, Deal>,
    pub arrived: Signal<In, Bits<15>>,
    pub came: Signal<In, Bit>,
    /// The first triangle, see `Seeder`.
    pub seeded: Signal<In, Bit>,
    pub has_no_start: Signal<In, Bit>,
    pub seeds: Signal<In, Bit>,
    pub owner: Signal<In, Bits<5>>,
    pub sleeps: Signal<In, Bit>,
    /// It tries again.
    pub keeps: Signal<In, Bit>,
    /// A commit or a release of it is due.
    pub hands_over: Signal<In, Bit>,
    /// It wants the waiting token.
    pub asks_to_wait: Signal<In, Bit>,
    /// It meets a foreign lock with it.
    pub waits: Signal<In, Bit>,
    /// It needs it no more.
    pub stops_waiting: Signal<In, Bit>,
    pub overflows: Signal<In, Bit>,
    /// Its point is a duplicate.
    pub duplicate: Signal<In, Bit>,
    pub root_enable: Signal<In, Bit>,
    pub root: Signal<In, Bits<15>>,
    /// A visit completes; it may ask for others: the queue is not free for a start.
    pub is_done: Signal<In, Bit>,
    pub may_ask: Signal<In, Bit>,
    /// A commit is finished.
    pub commit_ends: Signal<In, Bit>,
    pub commit_owner: Signal<In, Bits<5>>,
    pub hint: Signal<In, Bits<15>>,
    /// The last lock of a context is released.
    pub released: Signal<In, Bit>,
    pub released_owner: Signal<In, Bits<5>>,
    /// The insertion alone.
    pub solo_is_at_work: Signal<In, Bit>,
    pub solo_ends: Signal<In, Bit>,
    /// A context starts to walk at a record.
    pub starts: Signal<Out, Bit>,
    pub starter: Signal<Out, Bits<5>>,
    pub u: Signal<Out, Bits<15>>,
    /// With this new point.
    pub takes: Signal<Out, Bit>,
    pub taken_id: Signal<Out, Bits<15>>,
    /// The point's coordinates stand on the vertex memory's port, 2 clocks later.
    pub position_enable: Signal<Out, Bit>,
    pub position_owner: Signal<Out, Bits<5>>,
    /// See `ContextFlags`.
    pub busy: Signal<Out, Bits<24>>,
    pub waiter_valid: Signal<Out, Bit>,
    pub waiter: Signal<Out, Bits<5>>,
    /// A context inserts its point alone, from `u` on.
    pub solo_starts: Signal<Out, Bit>,
    pub solo_owner: Signal<Out, Bits<5>>,
    pub solo_p: Signal<Out, Bits<15>>,
    /// Event: the waiting token is taken.
    pub takes_token: Signal<Out, Bit>,
    /// Every point is finished; nothing is finished any more.
    pub is_quiet: Signal<Out, Bit>,
    pub stuck: Signal<Out, Bit>,
    found_owner: DFF<Bits<5>>,
    found_sleeps: DFF<Bit>,
    found_keeps: DFF<Bit>,
    found_hands_over: DFF<Bit>,
    found_asks: DFF<Bit>,
    found_waits: DFF<Bit>,
    found_stops: DFF<Bit>,
    found_overflows: DFF<Bit>,
    found_duplicate: DFF<Bit>,
    found_root_enable: DFF<Bit>,
    found_root: DFF<Bits<15>>,
    taken1: DFF<Bit>,
    taken2: DFF<Bit>,
    taker1: DFF<Bits<5>>,
    taker2: DFF<Bits<5>>,
    flags: ContextFlags,
    start: Starter,
    progress: Progress,
    watchdog: Watchdog,
}

impl Dispatcher {
    /// The dispatcher of a configuration.
    pub fn new(config: Config) -> Self {
        Self { start: Starter::new(config), ..Self::default() }
    }
}

impl Logic for Dispatcher {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, found_owner, found_sleeps, found_keeps, found_hands_over, found_asks, found_waits);
        dff_setup!(self, clock, found_stops, found_overflows, found_duplicate, found_root_enable, found_root);
        dff_setup!(self, clock, taken1, taken2, taker1, taker2);
        clock!(self, clock, flags, start, progress, watchdog);

        // What a visit leads to is known late: it is noted in the next clock.
        self.found_owner.d.next = self.owner.val();
        self.found_sleeps.d.next = self.sleeps.val() & (!self.reset.val());
        self.found_keeps.d.next = self.keeps.val() & (!self.reset.val());
        self.found_hands_over.d.next = self.hands_over.val() & (!self.reset.val());
        self.found_asks.d.next = self.asks_to_wait.val() & (!self.reset.val());
        self.found_waits.d.next = self.waits.val() & (!self.reset.val());
        self.found_stops.d.next = self.stops_waiting.val() & (!self.reset.val());
        self.found_overflows.d.next = self.overflows.val() & (!self.reset.val());
        self.found_duplicate.d.next = self.duplicate.val() & (!self.reset.val());
        self.found_root_enable.d.next = self.root_enable.val();
        self.found_root.d.next = self.root.val();
        self.flags.reset.next = self.reset.val();
        self.start.reset.next = self.reset.val();
        self.progress.reset.next = self.reset.val();
        self.watchdog.reset.next = self.reset.val();
        self.flags.clears.next = self.clears.val();
        self.start.clears.next = self.clears.val();
        self.progress.clears.next = self.clears.val();

        // What each context is at.
        self.flags.all.next = self.all.val();
        self.flags.owner.next = self.found_owner.q.val();
        self.flags.sleeps.next = self.found_sleeps.q.val();
        self.flags.keeps.next = self.found_keeps.q.val();
        self.flags.hands_over.next = self.found_hands_over.q.val();
        self.flags.asks_to_wait.next = self.found_asks.q.val();
        self.flags.waits.next = self.found_waits.q.val();
        self.flags.stops_waiting.next = self.found_stops.q.val();
        self.flags.overflows.next = self.found_overflows.q.val();
        self.flags.starts.next = self.start.starts.val();
        self.flags.starter.next = self.start.owner.val();
        self.flags.released.next = self.released.val();
        self.flags.released_owner.next = self.released_owner.val();
        self.flags.commit_ends.next = self.commit_ends.val();
        self.flags.commit_owner.next = self.commit_owner.val();
        self.flags.solo_ends.next = self.solo_ends.val();
        self.busy.next = self.flags.busy.val();
        self.waiter_valid.next = self.flags.waiter_valid.val();
        self.waiter.next = self.flags.waiter.val();
        self.solo_owner.next = self.flags.solo_owner.val();
        self.takes_token.next = self.flags.takes_token.val();

        // Who starts.
        self.start.deal.next = self.deal.val();
        self.start.arrived.next = self.arrived.val();
        self.start.came.next = self.came.val();
        self.start.seeded.next = self.seeded.val();
        self.start.asleep.next = self.flags.asleep.val();
        self.start.keeping.next = self.flags.keeping.val();
        self.start.busy.next = self.flags.busy.val();
        self.start.began.next = self.flags.began.val();
        self.start.hinted.next = self.flags.hinted.val();
        self.start.is_urgent.next = self.flags.is_urgent.val();
        self.start.waiter.next = self.flags.waiter.val();
        self.start.solo_valid.next = self.flags.solo_valid.val();
        self.start.solo_owner.next = self.flags.solo_owner.val();
        self.start.solo_is_at_work.next = self.solo_is_at_work.val();
        self.start.all_rest.next = self.flags.all_rest.val();
        self.start.is_done.next = self.is_done.val();
        self.start.is_blocked.next = self.may_ask.val();
        self.start.root_enable.next = self.found_root_enable.q.val();
        self.start.root_owner.next = self.found_owner.q.val();
        self.start.root.next = self.found_root.q.val();
        self.start.hint_enable.next = self.commit_ends.val();
        self.start.hint_owner.next = self.commit_owner.val();
        self.start.hint.next = self.hint.val();
        self.starts.next = self.start.starts.val();
        self.starter.next = self.start.owner.val();
        self.u.next = self.start.u.val();
        self.takes.next = self.start.takes.val();
        self.taken_id.next = self.start.taken_id.val();

        // The coordinates of a point that is taken come 2 clocks later.
        self.taken1.d.next = self.start.takes.val() & (!self.reset.val());
        self.taken2.d.next = self.taken1.q.val() & (!self.reset.val());
        self.taker1.d.next = self.start.owner.val();
        self.taker2.d.next = self.taker1.q.val();
        self.position_enable.next = self.taken2.q.val();
        self.position_owner.next = self.taker2.q.val();
        self.solo_starts.next = self.start.solo_starts.val();
        self.solo_p.next = self.start.solo_p.val();

        // What is finished.
        self.progress.arrived.next = self.arrived.val();
        self.progress.seeds.next = self.seeds.val();
        self.progress.commit_ends.next = self.commit_ends.val();
        self.progress.solo_ends.next = self.solo_ends.val();
        self.progress.duplicate.next = self.found_duplicate.q.val();
        self.progress.has_no_start.next = self.has_no_start.val();
        self.progress.all_rest.next = self.flags.all_rest.val();
        self.is_quiet.next = self.progress.is_quiet.val();
        self.watchdog.patience.next = self.patience.val();
        self.watchdog.finishes.next = self.progress.finishes.val();
        self.watchdog.is_quiet.next = self.progress.is_quiet.val();
        self.stuck.next = self.watchdog.stuck.val();
    }
}
