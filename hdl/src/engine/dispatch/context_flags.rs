//! The state of each context, a bit each; and which context holds the priority or asks for a solo insertion.
//!
//! 1. There is one priority. A context that aborts while the priority is free takes it, and keeps it until its point is
//!    finished (L2). No other context ever waits while it holds locks. But contexts that abort and retry in step with
//!    the waiting one could keep its locks taken for ever. So when the waiting context has met 8 foreign locks, no
//!    other context retries until its point is finished (L3). New points may start: they are finished, or abort and
//!    then rest, so some point is always finished in the end.
//! 2. One context at a time asks for a solo insertion. Another one whose list overflows meanwhile retries later.
//! 3. All flags of `outcome` come from one visit. A visit that asks for the priority neither waits nor returns it, and
//!    one that hands over also falls asleep. `outcome` never comes with `solo_ends`, because all visits then belong to
//!    the solo insertion. All other events may come together.
//!
//! Latency: 1 clock from an event to `contexts`.
//!
//! There are two contexts. Context 1 starts, aborts and takes the priority, starts again, and hands over a ring:
//! ```text
//! starts            ___/^^\________/^^\_______________________
//! sleeps            _________/^^\________/^^\_________________
//! will_retry        _________/^^\_____________________________
//! asks_for_priority _________/^^\_____________________________
//! returns_priority  _____________________/^^\_________________
//! hands_over        _____________________/^^\_________________
//! commit_ends       ___________________________/^^\___________
//! released          _________________________________/^^\_____
//! asleep              3  3  1  1  3  3  1  1  3  3  3  3  3  3
//! retrying            0  0  0  0  2  2  0  0  0  0  0  0  0  0
//! busy                0  0  0  0  0  0  0  0  2  2  2  2  0  0
//! began               0  0  2  2  2  2  2  2  2  2  2  2  2  2
//! hinted              0  0  0  0  0  0  0  0  0  0  2  2  2  2
//! priority_is_held  ____________/^^^^^^^^^^^\_________________
//! all_rest          ___/^^\________/^^\____________________/^^
//! ```

use crate::engine::types::{CommitJob, Committed, ContextSet, ContextState, Outcome, Released, Start};
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
    /// A solo insertion has ended.
    pub solo_ends: Signal<In, Bit>,
    /// The state of all contexts.
    pub contexts: Signal<Out, ContextState>,
    /// The priority is taken at this edge, for the counters.
    pub takes_priority: Signal<Out, Bit>,
    state: DFF<ContextState>,
    waited: DFF<Bits<4>>,
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
    takes: Signal<Local, Bit>,
    is_holder: Signal<Local, Bit>,
    has_waited_long: Signal<Local, Bit>,
    one_wait: Signal<Local, Bits<4>>,
    one: Signal<Local, ContextSet>,
    none: Signal<Local, ContextSet>,
}

impl Logic for ContextFlags {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, waited);
        self.one.next = 1.into();
        self.none.next = 0.into();
        self.one_wait.next = 1.into();
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
        self.wide_solo.next = bit_cast::<24, 5>(self.state.q.val().solo_context);
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
        if self.outcome.val().sleeps {
            self.falls_asleep.next = self.context_bit.val() & self.built_contexts.val();
        }
        if self.outcome.val().will_retry {
            self.tries.next = self.context_bit.val() & self.built_contexts.val();
        }
        if self.outcome.val().hands_over {
            self.becomes_due.next = self.context_bit.val() & self.built_contexts.val();
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
        self.state.d.next.began = self.state.q.val().began | self.starting.val();
        self.state.d.next.hinted = self.state.q.val().hinted | self.had_commit.val();

        // L2: the first context to ask gets the priority; if two could wait, each could wait for the other.
        self.takes.next = self.outcome.val().asks_for_priority & (!self.state.q.val().priority_is_held);
        self.takes_priority.next = self.takes.val();
        self.is_holder.next = (self.outcome.val().returns_priority
            & (self.state.q.val().priority_context == self.outcome.val().context))
            | (self.solo_ends.val() & (self.state.q.val().priority_context == self.state.q.val().solo_context));
        if self.takes.val() {
            self.state.d.next.priority_is_held = true;
            self.state.d.next.priority_context = self.outcome.val().context;
        }
        // L3: after 8 foreign locks the context with the priority has waited long, and no other may retry.
        self.has_waited_long.next = self.waited.q.val().get_bit(3);
        self.contexts.next.is_urgent = self.state.q.val().priority_is_held & self.has_waited_long.val();
        if self.outcome.val().waits & (!self.has_waited_long.val()) {
            self.waited.d.next = self.waited.q.val() + self.one_wait.val();
        }
        if self.takes.val() {
            self.waited.d.next = 0.into();
        }
        if self.is_holder.val() {
            self.state.d.next.priority_is_held = false;
        }
        if self.outcome.val().overflows & (!self.state.q.val().solo_valid) {
            self.state.d.next.solo_valid = true;
            self.state.d.next.solo_context = self.outcome.val().context;
        }
        if self.solo_ends.val() {
            self.state.d.next.solo_valid = false;
        }

        if self.reset.val() | self.clears.val() {
            self.state.d.next.asleep = self.built_contexts.val();
            self.state.d.next.retrying = 0.into();
            self.state.d.next.busy = 0.into();
            self.state.d.next.began = 0.into();
            self.state.d.next.hinted = 0.into();
            self.state.d.next.priority_is_held = false;
            self.state.d.next.solo_valid = false;
            self.state.d.next.all_rest = false;
        }
    }
}
