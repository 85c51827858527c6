//! What a visit adds to the lists of its context, and who gets the lists when the attempt is over.
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
    pub done: Signal<In, Bit>,
    pub token: Signal<In, Token>,
    pub turned: Signal<In, Turned>,
    /// The state of its attempt before and afterwards.
    pub attempt: Signal<In, Attempt>,
    pub after: Signal<In, Attempt>,
    /// The point of its context, and when it was taken.
    pub p: Signal<In, Bits<15>>,
    pub since: Signal<In, Bits<22>>,
    /// From `VisitCase`.
    pub is_root: Signal<In, Bit>,
    pub settles: Signal<In, Bit>,
    /// From `AttemptStep`.
    pub finds_inner: Signal<In, Bit>,
    pub succeeds: Signal<In, Bit>,
    /// A failed attempt is over; the root's visit is, with the root locked.
    pub fails: Signal<In, Bit>,
    pub stops_at_root: Signal<In, Bit>,
    /// A final edge of the boundary.
    pub entry_enable: Signal<Out, Bit>,
    pub entry_place: Signal<Out, Bits<6>>,
    pub entry: Signal<Out, Entry>,
    /// An inner triangle.
    pub inner_enable: Signal<Out, Bit>,
    pub inner_place: Signal<Out, Bits<6>>,
    pub inner_id: Signal<Out, Bits<15>>,
    /// A lock for the log.
    pub lock_enable: Signal<Out, Bit>,
    pub lock_place: Signal<Out, Bits<7>>,
    pub lock_id: Signal<Out, Bits<15>>,
    /// The ring goes to the commit.
    pub commit_enable: Signal<Out, Bit>,
    pub commit_job: Signal<Out, CommitJob>,
    /// The locks go to the release.
    pub release_enable: Signal<Out, Bit>,
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
