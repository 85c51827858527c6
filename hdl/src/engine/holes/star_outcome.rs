//! The consequences of a visit of a star for its context: an entry of the ring, a lock for the log, the release of the
//! locks of an attempt that has failed, and what becomes of the item.
//!
//! 1. The record outside, which is locked, becomes an entry of the ring at the place of the visit (M3).
//! 2. An attempt that has failed releases its locks and tries again (M4). If its ring is too long for the list, its
//!    item ends instead, and `outcome.duplicate` says so.
//! 3. A move in place ends its item in the same way: its locks are released after its point is written (M12).
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{Entry, EntryWrite, LockWrite, Outcome, ReleaseJob, ReleaseRequest, Star, Turned, Visit};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct StarOutcome {
    /// The visit that completes with its record, and whether it is one of a star.
    pub visit: Signal<In, Visit>,
    pub turned: Signal<In, Turned>,
    pub is_star: Signal<In, Bit>,
    /// The star before and after the visit.
    pub held: Signal<In, Star>,
    pub after: Signal<In, Star>,
    /// The visit brings an entry of the ring; it waits for a lock; it aborts the attempt; the attempt has failed.
    pub settles: Signal<In, Bit>,
    pub waits: Signal<In, Bit>,
    pub aborts: Signal<In, Bit>,
    pub fails: Signal<In, Bit>,
    /// The visit ends a move in place.
    pub ends_in_place: Signal<In, Bit>,
    pub entry: Signal<Out, EntryWrite>,
    pub lock: Signal<Out, LockWrite>,
    pub releases: Signal<Out, ReleaseRequest>,
    pub outcome: Signal<Out, Outcome>,
    settled: Signal<Local, Entry>,
    locks: Signal<Local, ReleaseJob>,
    ends_item: Signal<Local, Bit>,
    ends: Signal<Local, Bit>,
}

impl Logic for StarOutcome {
    #[hdl_gen]
    fn update(&mut self) {
        self.settled.next.first_vertex = self.turned.val().v2;
        self.settled.next.outside_record = self.visit.val().record;
        self.settled.next.slot = self.turned.val().slot;
        self.settled.next.cavity_record = self.visit.val().cavity_record;
        self.settled.next.after = 0.into();
        self.entry.next.valid = self.settles.val();
        self.entry.next.context = self.visit.val().context;
        self.entry.next.place = self.visit.val().entry;
        self.entry.next.entry = self.settled.val();

        self.lock.next.valid = self.is_star.val() & self.turned.val().took;
        self.lock.next.context = self.visit.val().context;
        self.lock.next.place = self.held.val().logged;
        self.lock.next.id = self.visit.val().record;
        self.locks.next.context = self.visit.val().context;
        self.locks.next.locks = self.after.val().logged;
        self.ends.next = self.fails.val() | self.ends_in_place.val();
        self.releases.next.valid = self.ends.val();
        self.releases.next.job = self.locks.val();
        self.ends_item.next = (self.fails.val() & self.after.val().is_too_long) | self.ends_in_place.val();
        self.outcome.next.context = self.visit.val().context;
        self.outcome.next.sleeps = self.ends.val();
        self.outcome.next.will_retry = self.fails.val() & (!self.ends_item.val());
        self.outcome.next.hands_over = self.ends.val();
        self.outcome.next.asks_for_priority = self.aborts.val();
        self.outcome.next.waits = self.waits.val();
        self.outcome.next.returns_priority = self.ends_item.val();
        self.outcome.next.overflows = false;
        self.outcome.next.duplicate = self.ends_item.val();
        self.outcome.next.root_enable = false;
        self.outcome.next.root = 0.into();
    }
}
