//! The state of each context, a bit each.
//!
//! 1. A context whose list overflows asks for a solo insertion until that has ended. While any context asks, none
//!    starts, so each has its turn before a new point can bring another overflow.
//! 2. All flags of `outcome` come from one visit, and one that hands over also falls asleep. `outcome` never comes with
//!    `solo_ends`, because all visits then belong to the solo insertion. All other events may come together.
//!
//! Latency: 1 clock from an event to `contexts`.
//!
//! There are two contexts. Context 1 starts, aborts, starts again, and hands over a ring:
//! ```text
//! starts          ___/^^\________/^^\_______________________
//! sleeps          _________/^^\________/^^\_________________
//! will_retry      _________/^^\_____________________________
//! hands_over      _____________________/^^\_________________
//! commit_ends     ___________________________/^^\___________
//! released        _________________________________/^^\_____
//! asleep            3  3  1  1  3  3  1  1  3  3  3  3  3  3
//! retrying          0  0  0  0  2  2  0  0  0  0  0  0  0  0
//! busy              0  0  0  0  0  0  0  0  2  2  2  2  0  0
//! began             0  0  2  2  2  2  2  2  2  2  2  2  2  2
//! hinted            0  0  0  0  0  0  0  0  0  0  2  2  2  2
//! all_rest        ___/^^\________/^^\____________________/^^
//! ```

use super::fill_flags::FillFlags;
use crate::engine::types::{
    CommitJob, Committed, ContextId, ContextSet, ContextState, FillEnd, Outcome, Released, Start,
};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct ContextFlags {
    pub clock: Signal<In, Clock>,
    /// Reset and clear put all contexts to sleep, without a point.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// The contexts that are built, a constant.
    pub built_contexts: Signal<In, ContextSet>,
    /// The consequences of a completed visit for its context, a clock after the visit.
    pub outcome: Signal<In, Outcome>,
    /// A context that starts to walk at this edge.
    pub start: Signal<In, Start>,
    /// The last lock of a context is cleared at this edge; or the last write of its commit is requested.
    pub released: Signal<In, Released>,
    pub committed: Signal<In, Committed>,
    /// The solo insertion of this context has ended.
    pub solo_ends: Signal<In, Bit>,
    pub solo_context: Signal<In, ContextId>,
    /// The state of all contexts.
    pub contexts: Signal<Out, ContextState>,
    /// In a core with changes: an item ends with its hole, so that its context falls asleep and its locks become due.
    pub fill_end: Vec<Signal<In, FillEnd>>,
    fill: Vec<FillFlags>,
    state: DFF<ContextState>,
    job: Signal<Local, CommitJob>,
    sleeping: Signal<Local, ContextSet>,
    due: Signal<Local, ContextSet>,
    context_bit: Signal<Local, ContextSet>,
    starter_bit: Signal<Local, ContextSet>,
    released_bit: Signal<Local, ContextSet>,
    commit_bit: Signal<Local, ContextSet>,
    solo_bit: Signal<Local, ContextSet>,
    wide_context: Signal<Local, ContextSet>,
    wide_starter: Signal<Local, ContextSet>,
    wide_released: Signal<Local, ContextSet>,
    wide_commit: Signal<Local, ContextSet>,
    wide_solo: Signal<Local, ContextSet>,
    falls_asleep: Signal<Local, ContextSet>,
    tries: Signal<Local, ContextSet>,
    becomes_due: Signal<Local, ContextSet>,
    starting: Signal<Local, ContextSet>,
    freed: Signal<Local, ContextSet>,
    had_commit: Signal<Local, ContextSet>,
    solo_ended: Signal<Local, ContextSet>,
    overflowed: Signal<Local, ContextSet>,
    asking: Signal<Local, ContextSet>,
    one: Signal<Local, ContextSet>,
    none: Signal<Local, ContextSet>,
}

impl ContextFlags {
    /// The flags of a core with changes.
    pub fn with_changes() -> Self {
        Self { fill_end: vec![Signal::default()], fill: vec![FillFlags::default()], ..Self::default() }
    }
}

impl Logic for ContextFlags {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        self.one.next = 1.into();
        self.none.next = 0.into();
        self.contexts.next = self.state.q.val();
        self.sleeping.next = self.state.q.val().asleep;
        self.due.next = self.state.q.val().busy;
        self.job.next = self.committed.val().job;
        self.state.d.next.all_rest = (self.sleeping.val() == self.built_contexts.val())
            & (self.due.val() == self.none.val())
            & (!self.start.val().valid);

        // Contexts that are not built must never show here, or synthesis would build their flags.
        self.wide_context.next = bit_cast::<24, 5>(self.outcome.val().context);
        self.wide_starter.next = bit_cast::<24, 5>(self.start.val().context);
        self.wide_released.next = bit_cast::<24, 5>(self.released.val().context);
        self.wide_commit.next = bit_cast::<24, 5>(self.job.val().context);
        self.wide_solo.next = bit_cast::<24, 5>(self.solo_context.val());
        self.context_bit.next = self.one.val() << self.wide_context.val();
        self.starter_bit.next = self.one.val() << self.wide_starter.val();
        self.released_bit.next = self.one.val() << self.wide_released.val();
        self.commit_bit.next = self.one.val() << self.wide_commit.val();
        self.solo_bit.next = self.one.val() << self.wide_solo.val();
        self.falls_asleep.next = 0.into();
        self.tries.next = 0.into();
        self.becomes_due.next = 0.into();
        self.starting.next = 0.into();
        self.freed.next = 0.into();
        self.had_commit.next = 0.into();
        self.solo_ended.next = 0.into();
        self.overflowed.next = 0.into();
        if self.outcome.val().sleeps {
            self.falls_asleep.next = self.context_bit.val() & self.built_contexts.val();
        }
        if self.outcome.val().will_retry {
            self.tries.next = self.context_bit.val() & self.built_contexts.val();
        }
        if self.outcome.val().hands_over {
            self.becomes_due.next = self.context_bit.val() & self.built_contexts.val();
        }
        if self.outcome.val().overflows {
            self.overflowed.next = self.context_bit.val() & self.built_contexts.val();
        }
        if self.start.val().valid {
            self.starting.next = self.starter_bit.val() & self.built_contexts.val();
        }
        if self.released.val().valid {
            self.freed.next = self.released_bit.val();
        }
        if self.committed.val().valid {
            self.had_commit.next = self.commit_bit.val() & self.built_contexts.val();
        }
        if self.solo_ends.val() {
            self.solo_ended.next = self.solo_bit.val();
        }
        self.state.d.next.asleep = (self.sleeping.val() | self.falls_asleep.val()) & (!self.starting.val());
        self.state.d.next.retrying =
            (self.state.q.val().retrying | self.tries.val()) & (!(self.starting.val() | self.solo_ended.val()));
        self.state.d.next.busy = (self.due.val() | self.becomes_due.val()) & (!self.freed.val());
        for i in 0..self.fill.len() {
            self.fill[i].ending.next = self.fill_end[i].val();
            self.fill[i].asleep.next = (self.sleeping.val() | self.falls_asleep.val()) & (!self.starting.val());
            self.fill[i].busy.next = (self.due.val() | self.becomes_due.val()) & (!self.freed.val());
            self.state.d.next.asleep = self.fill[i].asleep_after.val();
            self.state.d.next.busy = self.fill[i].busy_after.val();
        }
        self.state.d.next.began = self.state.q.val().began | self.starting.val();
        self.state.d.next.hinted = self.state.q.val().hinted | self.had_commit.val();
        self.asking.next = (self.state.q.val().solo | self.overflowed.val()) & (!self.solo_ended.val());
        self.state.d.next.solo = self.asking.val();
        self.state.d.next.solo_valid = self.asking.val().any();

        if self.reset.val() | self.clears.val() {
            self.state.d.next.asleep = self.built_contexts.val();
            self.state.d.next.retrying = 0.into();
            self.state.d.next.busy = 0.into();
            self.state.d.next.began = 0.into();
            self.state.d.next.hinted = 0.into();
            self.state.d.next.solo = 0.into();
            self.state.d.next.solo_valid = false;
            self.state.d.next.all_rest = false;
        }
    }
}
