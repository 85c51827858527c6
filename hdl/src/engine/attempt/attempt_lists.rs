//! Adds what a visit has found to the lists of its context, and hands the lists over when the attempt is over: a
//! complete ring to the commit, the locks of an aborted attempt to the release.
//!
//! 1. An entry stands in the place of its own number. Inner records and locks stand in the order in which they came,
//!    the lock of the root first.
//! 2. The job of an attempt also counts a lock that its last visit took. Otherwise that lock would stay set.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{
    Attempt, Case, Clocks, CommitJob, CommitRequest, Completion, Entry, EntryWrite, InnerWrite, LockWrite, ReleaseJob,
    ReleaseRequest, RingCount, Step, Turned, VertexId, Visit,
};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct AttemptLists {
    /// The visit that completes in this clock.
    pub completion: Signal<In, Completion>,
    /// The state of the attempt before and after the visit.
    pub attempt: Signal<In, Attempt>,
    pub after: Signal<In, Attempt>,
    /// The point of the context, and the clock count when the context took it.
    pub vertex: Signal<In, VertexId>,
    pub since: Signal<In, Clocks>,
    /// The case of the visit, and the step of its attempt.
    pub found: Signal<In, Case>,
    pub step: Signal<In, Step>,
    /// An aborted attempt is over; or a root visit that locked the root ends the attempt (`stops_at_root`).
    pub fails: Signal<In, Bit>,
    pub stops_at_root: Signal<In, Bit>,
    /// Additions to the lists of the context: a final entry, an inner record, a lock.
    pub entry: Signal<Out, EntryWrite>,
    pub inner: Signal<Out, InnerWrite>,
    pub lock: Signal<Out, LockWrite>,
    /// The ring goes to the commit; or the locks go to the release.
    pub commit: Signal<Out, CommitRequest>,
    pub releases: Signal<Out, ReleaseRequest>,
    visit: Signal<Local, Visit>,
    turned: Signal<Local, Turned>,
    inners: Signal<Local, RingCount>,
    boundary: Signal<Local, Entry>,
    ring: Signal<Local, CommitJob>,
    locks: Signal<Local, ReleaseJob>,
}

impl Logic for AttemptLists {
    #[hdl_gen]
    fn update(&mut self) {
        self.visit.next = self.completion.val().visit;
        self.turned.next = self.completion.val().turned;
        self.inners.next = self.attempt.val().inners;
        self.boundary.next.first_vertex = self.turned.val().v2;
        self.boundary.next.outside_record = self.visit.val().record;
        self.boundary.next.slot = self.turned.val().slot;
        self.boundary.next.cavity_record = self.visit.val().cavity_record;
        self.boundary.next.after = self.visit.val().after;
        self.entry.next.valid = self.found.val().settles;
        self.entry.next.context = self.visit.val().context;
        self.entry.next.place = self.visit.val().entry;
        self.entry.next.entry = self.boundary.val();

        self.inner.next.valid = self.step.val().finds_inner;
        self.inner.next.context = self.visit.val().context;
        self.inner.next.place = self.inners.val().get_bits::<6>(0);
        self.inner.next.id = self.visit.val().cavity_record;

        self.lock.next.valid = self.found.val().is_done & self.turned.val().took;
        self.lock.next.context = self.visit.val().context;
        self.lock.next.place = self.attempt.val().logged;
        self.lock.next.id = self.visit.val().record;
        if self.found.val().is_root {
            self.lock.next.place = 0.into();
        }

        self.ring.next.context = self.visit.val().context;
        self.ring.next.vertex = self.vertex.val();
        self.ring.next.inners = self.inners.val();
        self.ring.next.locks = self.after.val().logged;
        self.ring.next.since = self.since.val();
        self.commit.next.valid = self.step.val().succeeds;
        self.commit.next.job = self.ring.val();

        self.locks.next.context = self.visit.val().context;
        self.locks.next.locks = self.after.val().logged;
        if self.stops_at_root.val() {
            self.locks.next.locks = 1.into();
        }
        self.releases.next.valid = self.fails.val() | self.stops_at_root.val();
        self.releases.next.job = self.locks.val();
    }
}
