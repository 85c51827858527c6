//! What a visit adds to the lists of its context, and who gets the lists when the attempt is over.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `done`, `token`, `turned` | in | | the visit that completes |
//! | `attempt`, `after` | in | Attempt | the state of its attempt before and afterwards |
//! | `p`, `since` | in | 15, 22 | the point of its context, and when it was taken |
//! | `is_root`, `settles` | in | 1 | from `VisitCase` |
//! | `finds_inner`, `succeeds` | in | 1 | from `AttemptStep` |
//! | `fails`, `stops_at_root` | in | 1 | a failed attempt is over; the root's visit is, with the root locked |
//! | `entry_enable`, `entry_place`, `entry` | out | 1, 6, Entry | a final edge of the boundary |
//! | `inner_enable`, `inner_place`, `inner_id` | out | 1, 6, 15 | an inner triangle |
//! | `lock_enable`, `lock_place`, `lock_id` | out | 1, 7, 15 | a lock for the log |
//! | `commit_enable`, `commit_job` | out | 1, CommitJob | the ring goes to the commit |
//! | `release_enable`, `release_job` | out | 1, ReleaseJob | the locks go to the release |
//!
//! 1. An edge stands at its own place; inner triangles and locks stand in the order in which they came, the root's lock first.
//! 2. A lock taken by an attempt's last visit counts in its job.
//!
//! Latency: none (combinational).

use crate::engine::types::{Attempt, CommitJob, Entry, ReleaseJob, Token, Turned};
use rust_hdl_core::prelude::*;

/// The lists of an attempt; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct AttemptLists {
    /// A visit completes.
    pub done: Signal<In, Bit>,
    /// The visit.
    pub token: Signal<In, Token>,
    /// Its record.
    pub turned: Signal<In, Turned>,
    /// The state before.
    pub attempt: Signal<In, Attempt>,
    /// The state afterwards.
    pub after: Signal<In, Attempt>,
    /// The point.
    pub p: Signal<In, Bits<15>>,
    /// When it was taken.
    pub since: Signal<In, Bits<22>>,
    /// The visit is a root's.
    pub is_root: Signal<In, Bit>,
    /// An edge is final.
    pub settles: Signal<In, Bit>,
    /// A triangle is an inner one.
    pub finds_inner: Signal<In, Bit>,
    /// The ring is finished.
    pub succeeds: Signal<In, Bit>,
    /// A failed attempt is over.
    pub fails: Signal<In, Bit>,
    /// The root is locked in vain.
    pub stops_at_root: Signal<In, Bit>,
    /// An edge is final.
    pub entry_enable: Signal<Out, Bit>,
    /// Its place.
    pub entry_place: Signal<Out, Bits<6>>,
    /// The edge.
    pub entry: Signal<Out, Entry>,
    /// An inner triangle.
    pub inner_enable: Signal<Out, Bit>,
    /// Its place.
    pub inner_place: Signal<Out, Bits<6>>,
    /// Its id.
    pub inner_id: Signal<Out, Bits<15>>,
    /// A lock was taken.
    pub lock_enable: Signal<Out, Bit>,
    /// Its place in the log.
    pub lock_place: Signal<Out, Bits<7>>,
    /// The record.
    pub lock_id: Signal<Out, Bits<15>>,
    /// A ring is finished.
    pub commit_enable: Signal<Out, Bit>,
    /// The ring.
    pub commit_job: Signal<Out, CommitJob>,
    /// Locks are to be released.
    pub release_enable: Signal<Out, Bit>,
    /// The locks.
    pub release_job: Signal<Out, ReleaseJob>,
    inners: Signal<Local, Bits<7>>,
}

impl Logic for AttemptLists {
    #[hdl_gen]
    fn update(&mut self) {
        self.inners.next = self.attempt.val().inners;
        self.entry_enable.next = self.settles.val();
        self.entry_place.next = self.token.val().x;
        self.entry.next.a = self.turned.val().v2;
        self.entry.next.u = self.token.val().u;
        self.entry.next.slot = self.turned.val().slot;
        self.entry.next.f = self.token.val().f;
        self.entry.next.after = self.token.val().after;

        self.inner_enable.next = self.finds_inner.val();
        self.inner_place.next = self.inners.val().get_bits::<6>(0);
        self.inner_id.next = self.token.val().f;

        self.lock_enable.next = self.done.val() & self.turned.val().took;
        self.lock_place.next = self.attempt.val().logged;
        self.lock_id.next = self.token.val().u;
        if self.is_root.val() {
            self.lock_place.next = 0.into();
        }

        self.commit_enable.next = self.succeeds.val();
        self.commit_job.next.owner = self.token.val().owner;
        self.commit_job.next.p = self.p.val();
        self.commit_job.next.inners = self.inners.val();
        self.commit_job.next.locks = self.after.val().logged;
        self.commit_job.next.since = self.since.val();

        self.release_enable.next = self.fails.val() | self.stops_at_root.val();
        self.release_job.next.owner = self.token.val().owner;
        self.release_job.next.locks = self.after.val().logged;
        if self.stops_at_root.val() {
            self.release_job.next.locks = 1.into();
        }
    }
}
