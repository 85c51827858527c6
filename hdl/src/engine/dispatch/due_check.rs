//! Whether the context that the pointer has left is due: with the point that it has, with a new one, or not yet.
//!
//! 1. A context that sleeps and keeps its point is due when it has rested, no commit or release of it is due, and nobody else is urgent.
//! 2. A context that sleeps and keeps nothing is due when its next point has come and it may work.
//! 3. Nobody is due while somebody wants to be alone: that one's point is not to be tried again. Where only one context works, it may be
//!    the one that starts at this edge, and is not due then.
//!
//! Latency: none (combinational).

use super::next_point::Passed;
use crate::engine::types::{ContextId, ContextSet, ContextState, VertexId};
use rust_hdl_core::prelude::*;

/// The check; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct DueCheck {
    pub contexts: Signal<In, ContextState>,
    pub passed: Signal<In, Passed>,
    /// Points that have come.
    pub arrived: Signal<In, VertexId>,
    /// The first triangle stands.
    pub seeded: Signal<In, Bit>,
    /// The pointer has gone round once; it is in a round in which contexts that try again start.
    pub is_planned: Signal<In, Bit>,
    pub rests_over: Signal<In, Bit>,
    /// The first round of points is over, or there is none.
    pub all_work: Signal<In, Bit>,
    /// The only context that works may be the one that starts at this edge.
    pub may_be_starting: Signal<In, Bit>,
    /// Due with its point; with a new one.
    pub wants_again: Signal<Out, Bit>,
    pub wants_new: Signal<Out, Bit>,
    /// It tries its point again, due or not; it has had a commit.
    pub tries_again: Signal<Out, Bit>,
    pub is_hinted: Signal<Out, Bit>,
    index: Signal<Local, ContextId>,
    asleep: Signal<Local, ContextSet>,
    retrying: Signal<Local, ContextSet>,
    busy: Signal<Local, ContextSet>,
    began: Signal<Local, ContextSet>,
    hinted: Signal<Local, ContextSet>,
    is_asleep: Signal<Local, Bit>,
    will_retry: Signal<Local, Bit>,
    is_rested: Signal<Local, Bit>,
    may_try: Signal<Local, Bit>,
    may_work: Signal<Local, Bit>,
    is_there: Signal<Local, Bit>,
    is_barred: Signal<Local, Bit>,
    first_context: Signal<Local, ContextId>,
}

impl Logic for DueCheck {
    #[hdl_gen]
    fn update(&mut self) {
        self.first_context.next = 0.into();
        self.index.next = self.passed.val().context;
        self.asleep.next = self.contexts.val().asleep;
        self.retrying.next = self.contexts.val().retrying;
        self.busy.next = self.contexts.val().busy;
        self.began.next = self.contexts.val().began;
        self.hinted.next = self.contexts.val().hinted;
        self.is_barred.next = self.contexts.val().solo_valid | self.may_be_starting.val();
        self.is_asleep.next = self.asleep.val().get_bit(self.index.val().index()) & (!self.is_barred.val());
        self.will_retry.next = self.retrying.val().get_bit(self.index.val().index());

        // L1: who has failed rests until a fourth round. L3: and while another is urgent.
        self.is_rested.next = (!self.busy.val().get_bit(self.index.val().index())) & self.rests_over.val();
        self.may_try.next =
            (!self.contexts.val().is_urgent) | (self.passed.val().context == self.contexts.val().priority_context);
        self.wants_again.next =
            self.is_asleep.val() & self.will_retry.val() & self.is_rested.val() & self.may_try.val();

        // L8: the first points are context 0's.
        self.may_work.next = self.all_work.val();
        if self.passed.val().context == self.first_context.val() {
            self.may_work.next = self.seeded.val() | (!self.began.val().get_bit(0));
        }
        self.is_there.next = self.is_planned.val() & (self.passed.val().id < self.arrived.val());
        self.wants_new.next =
            self.is_asleep.val() & (!self.will_retry.val()) & self.is_there.val() & self.may_work.val();
        self.tries_again.next = self.will_retry.val();
        self.is_hinted.next = self.hinted.val().get_bit(self.index.val().index());
    }
}
