//! Says whether the context that the pointer has just left is due for a retry, due with a new point, or not due yet.
//!
//! 1. A context that is asleep and keeps its point is due when it has rested, no commit or release of it is due, and no
//!    other context of its team has waited for long.
//! 2. A context that is asleep and has no point is due when its next point has come and it may work.
//! 3. No context is due while one asks for a solo insertion: that one keeps its point, which must not be tried again
//!    meanwhile. If only one context works, it may be the context that starts at this edge, and is not due then.
//!
//! Latency: none, the block is combinational.

use super::next_point::Passed;
use crate::engine::types::{ContextId, ContextSet, ContextState, VertexId};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct DueCheck {
    /// The state of all contexts.
    pub contexts: Signal<In, ContextState>,
    /// The context that the pointer has left, with its next vertex.
    pub passed: Signal<In, Passed>,
    /// The number of points that have come.
    pub arrived: Signal<In, VertexId>,
    /// Every first triangle is in the mesh.
    pub seeded: Signal<In, Bit>,
    /// The pointer has gone round once; and its present round is one in which retries start (`rests_over`).
    pub is_planned: Signal<In, Bit>,
    pub rests_over: Signal<In, Bit>,
    /// The team of the context is open, see [`OpenTeams`](super::OpenTeams); no other context of the team has waited
    /// for long.
    pub is_open: Signal<In, Bit>,
    pub may_retry: Signal<In, Bit>,
    /// The only context that works may be the one that starts at this edge.
    pub may_be_starting: Signal<In, Bit>,
    /// The context is due for a retry; or it is due with a new point (`wants_new`).
    pub wants_again: Signal<Out, Bit>,
    pub wants_new: Signal<Out, Bit>,
    /// The next walk of the context starts at its last root: the start is a retry, due or not, or the context has had a
    /// commit.
    pub has_root: Signal<Out, Bit>,
    index: Signal<Local, ContextId>,
    asleep: Signal<Local, ContextSet>,
    retrying: Signal<Local, ContextSet>,
    busy: Signal<Local, ContextSet>,
    hinted: Signal<Local, ContextSet>,
    is_asleep: Signal<Local, Bit>,
    will_retry: Signal<Local, Bit>,
    is_rested: Signal<Local, Bit>,
    may_work: Signal<Local, Bit>,
    is_there: Signal<Local, Bit>,
    is_barred: Signal<Local, Bit>,
}

impl Logic for DueCheck {
    #[hdl_gen]
    fn update(&mut self) {
        self.index.next = self.passed.val().context;
        self.asleep.next = self.contexts.val().asleep;
        self.retrying.next = self.contexts.val().retrying;
        self.busy.next = self.contexts.val().busy;
        self.hinted.next = self.contexts.val().hinted;
        self.is_barred.next = self.contexts.val().solo_valid | self.may_be_starting.val();
        self.is_asleep.next = self.asleep.val().get_bit(self.index.val().index()) & (!self.is_barred.val());
        self.will_retry.next = self.retrying.val().get_bit(self.index.val().index());

        // L1: a retry waits for every fourth round, so that aborted contexts do not meet at the same locks again at
        // once. L3: while a context with the priority has waited for long, no other of its team may retry.
        self.is_rested.next = (!self.busy.val().get_bit(self.index.val().index())) & self.rests_over.val();
        self.wants_again.next =
            self.is_asleep.val() & self.will_retry.val() & self.is_rested.val() & self.may_retry.val();

        // L8: a mesh of few triangles has no room for many insertions, so the first points of a job go to the first
        // context of its team alone.
        self.may_work.next = self.is_open.val();
        if self.passed.val().is_first {
            self.may_work.next = self.seeded.val() | self.passed.val().is_seed;
        }
        self.is_there.next = self.is_planned.val() & (self.passed.val().id < self.arrived.val());
        self.wants_new.next =
            self.is_asleep.val() & (!self.will_retry.val()) & self.is_there.val() & self.may_work.val();
        self.has_root.next = self.will_retry.val() | self.hinted.val().get_bit(self.index.val().index());
    }
}
