//! Joins the effects of visits of deletions with those of the attempts.
//!
//! 1. A test that the fill asks for enters the queue if no completed visit may ask for visits and no context would
//!    start without an item. Items that begin wait for tests. A root counts as a visit that may ask, whatever it finds.
//! 2. An item ends with its hole if the completed visit ends no attempt and no item at the same edge, and cannot end a
//!    star.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{
    CommitJob, Committed, FillEnd, Follow, LockWrite, Outcome, ReleaseJob, ReleaseRequest, Write,
};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct HoleMerge {
    /// The completed visit is one of a deletion; or a root that opens a star.
    pub is_done: Signal<In, Bit>,
    pub opens_star: Signal<In, Bit>,
    /// The effects of the attempts, and those of the deletions.
    pub attempt_is_done: Signal<In, Bit>,
    pub follow: Signal<In, Follow>,
    pub hole_follow: Signal<In, Follow>,
    pub outcome: Signal<In, Outcome>,
    pub hole_outcome: Signal<In, Outcome>,
    pub lock: Signal<In, LockWrite>,
    pub hole_lock: Signal<In, LockWrite>,
    pub commits: Signal<In, Bit>,
    pub attempt_release: Signal<In, ReleaseRequest>,
    pub hole_release: Signal<In, ReleaseRequest>,
    /// The completed visit may end a star or a move in place; known sooner than `hole_release`.
    pub may_settle: Signal<In, Bit>,
    pub write: Signal<In, Write>,
    pub hole_write: Signal<In, Write>,
    /// The fill asks for a test; a context starts without an item if the queue is free; an item would end with its
    /// hole.
    pub asks: Signal<In, Bit>,
    pub wishes: Signal<In, Bit>,
    pub ending: Signal<In, FillEnd>,
    /// The last write of a deletion is requested.
    pub erased: Signal<In, Committed>,
    pub merged_is_done: Signal<Out, Bit>,
    pub may_ask: Signal<Out, Bit>,
    pub merged_follow: Signal<Out, Follow>,
    pub merged_outcome: Signal<Out, Outcome>,
    pub merged_lock: Signal<Out, LockWrite>,
    pub merged_release: Signal<Out, ReleaseRequest>,
    pub merged_write: Signal<Out, Write>,
    pub is_done_now: Signal<Out, Bit>,
    pub aborts: Signal<Out, Bit>,
    pub revisits: Signal<Out, Bit>,
    pub pushes: Signal<Out, Bit>,
    pub may_end: Signal<Out, Bit>,
    pub ends: Signal<Out, Bit>,
    pub granted: Signal<Out, FillEnd>,
    pub erases: Signal<Out, Bit>,
    pub erased_locks: Signal<Out, ReleaseRequest>,
    asks_or_may: Signal<Local, Bit>,
    is_taken: Signal<Local, Bit>,
    ends_now: Signal<Local, Bit>,
    job: Signal<Local, CommitJob>,
    locks: Signal<Local, ReleaseJob>,
    flat_locks: Signal<Local, ReleaseJob>,
}

impl Logic for HoleMerge {
    #[hdl_gen]
    fn update(&mut self) {
        self.merged_is_done.next = self.attempt_is_done.val() | self.is_done.val();
        self.is_done_now.next = self.is_done.val();
        self.asks_or_may.next = self.follow.val().may_ask | self.hole_follow.val().may_ask;
        self.may_ask.next = self.asks_or_may.val();
        self.merged_follow.next = self.follow.val();
        self.merged_outcome.next = self.outcome.val();
        self.merged_lock.next = self.lock.val();
        self.merged_write.next = self.write.val();
        if self.is_done.val() | self.opens_star.val() {
            self.merged_follow.next = self.hole_follow.val();
        }
        self.merged_follow.next.may_ask = self.asks_or_may.val();
        if self.is_done.val() {
            self.merged_outcome.next = self.hole_outcome.val();
            self.merged_lock.next = self.hole_lock.val();
        }
        if self.hole_write.val().valid {
            self.merged_write.next = self.hole_write.val();
        }
        self.aborts.next = self.hole_outcome.val().asks_for_priority;
        self.revisits.next = self.hole_outcome.val().waits;

        self.pushes.next = self.asks.val() & (!self.asks_or_may.val()) & (!self.wishes.val());
        self.is_taken.next = self.attempt_release.val().valid
            | self.may_settle.val()
            | self.commits.val()
            | self.outcome.val().duplicate;
        self.may_end.next = !self.is_taken.val();
        self.ends_now.next = self.ending.val().valid & (!self.is_taken.val());
        self.ends.next = self.ends_now.val();
        self.granted.next = self.ending.val();
        self.granted.next.valid = self.ends_now.val();
        self.flat_locks.next.context = self.ending.val().context;
        self.flat_locks.next.locks = self.ending.val().locks;
        self.merged_release.next = self.attempt_release.val();
        if self.hole_release.val().valid {
            self.merged_release.next = self.hole_release.val();
        }
        if self.ends_now.val() & self.ending.val().is_flat {
            self.merged_release.next.valid = true;
            self.merged_release.next.job = self.flat_locks.val();
        }

        self.job.next = self.erased.val().job;
        self.locks.next.context = self.job.val().context;
        self.locks.next.locks = self.job.val().locks;
        self.erases.next = self.erased.val().valid;
        self.erased_locks.next.valid = self.erased.val().valid;
        self.erased_locks.next.job = self.locks.val();
    }
}
