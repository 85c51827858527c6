//! What each context is at, a bit each; who holds the waiting token, and who wants to be alone.
//!
//! 1. One waiting token: whoever gives up while it is free takes it, and keeps it until its point is in (L2). Nobody else ever waits
//!    while it holds locks. But others that fail again and again could keep it from its locks for ever, in step with it: when it has met
//!    8 foreign locks, nobody else tries again until its point is in (L3). New points may start: they finish, or fail and then rest, so
//!    something is always finished in the end.
//! 2. The first to overflow is alone first; another that overflows meanwhile tries again later.
//! 3. `sleeps` to `overflows` are of one visit: who asks for the token neither waits nor gives it back. None of them comes with `solo_ends`,
//!    because then all visits are the insertion alone's. All other events may come together. Who hands over falls asleep with it.
//!
//! Latency: 1 clock.
//!
//! Of two contexts, 1 starts, gives up and takes the token, starts again, and hands over a ring:
//! ```text
//! starts          ___/^^\________/^^\_______________________
//! sleeps          _________/^^\________/^^\_________________
//! keeps           _________/^^\_____________________________
//! asks_to_wait    _________/^^\_____________________________
//! stops_waiting   _____________________/^^\_________________
//! hands_over      _____________________/^^\_________________
//! commit_ends     ___________________________/^^\___________
//! released        _________________________________/^^\_____
//! asleep            3  3  1  1  3  3  1  1  3  3  3  3  3  3
//! keeping           0  0  0  0  2  2  0  0  0  0  0  0  0  0
//! busy              0  0  0  0  0  0  0  0  2  2  2  2  0  0
//! began             0  0  2  2  2  2  2  2  2  2  2  2  2  2
//! hinted            0  0  0  0  0  0  0  0  0  0  2  2  2  2
//! waiter_valid    ____________/^^^^^^^^^^^\_________________
//! all_rest        ___/^^\________/^^\____________________/^^
//! ```

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What each context is at; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct ContextFlags {
    /// Reset and clear put all contexts to sleep, without a point.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// The contexts that are built, a constant.
    pub all: Signal<In, Bits<24>>,
    /// The context that the next eight are about.
    pub owner: Signal<In, Bits<5>>,
    /// No visit of it is out any more; it will try its point again.
    pub sleeps: Signal<In, Bit>,
    pub keeps: Signal<In, Bit>,
    /// A commit or a release of it is due.
    pub hands_over: Signal<In, Bit>,
    /// It wants the waiting token; meets a foreign lock with it; needs it no more.
    pub asks_to_wait: Signal<In, Bit>,
    pub waits: Signal<In, Bit>,
    pub stops_waiting: Signal<In, Bit>,
    /// Its list has overflowed.
    pub overflows: Signal<In, Bit>,
    /// A context starts to walk at this edge.
    pub starts: Signal<In, Bit>,
    pub starter: Signal<In, Bits<5>>,
    /// The last lock of a context is released.
    pub released: Signal<In, Bit>,
    pub released_owner: Signal<In, Bits<5>>,
    /// A commit is finished.
    pub commit_ends: Signal<In, Bit>,
    pub commit_owner: Signal<In, Bits<5>>,
    /// The insertion alone is over.
    pub solo_ends: Signal<In, Bit>,
    /// No visit out; trying again; commit or release due; has had a point; has had a commit.
    pub asleep: Signal<Out, Bits<24>>,
    pub keeping: Signal<Out, Bits<24>>,
    pub busy: Signal<Out, Bits<24>>,
    pub began: Signal<Out, Bits<24>>,
    pub hinted: Signal<Out, Bits<24>>,
    /// Who waits at foreign locks instead of giving up.
    pub waiter_valid: Signal<Out, Bit>,
    pub waiter: Signal<Out, Bits<5>>,
    /// It has waited for long: nobody else may try again.
    pub is_urgent: Signal<Out, Bit>,
    /// Who wants to be alone: nobody starts.
    pub solo_valid: Signal<Out, Bit>,
    pub solo_owner: Signal<Out, Bits<5>>,
    /// No visit is out and no lock held; said a clock after it has come true.
    pub all_rest: Signal<Out, Bit>,
    /// Event: the waiting token is taken.
    pub takes_token: Signal<Out, Bit>,
    sleeping: DFF<Bits<24>>,
    trying: DFF<Bits<24>>,
    due: DFF<Bits<24>>,
    had_point: DFF<Bits<24>>,
    had_commit: DFF<Bits<24>>,
    token_is_held: DFF<Bit>,
    token_holder: DFF<Bits<5>>,
    waited: DFF<Bits<4>>,
    wants_alone: DFF<Bit>,
    alone: DFF<Bits<5>>,
    rests: DFF<Bit>,
    owner_bit: Signal<Local, Bits<24>>,
    starter_bit: Signal<Local, Bits<24>>,
    released_bit: Signal<Local, Bits<24>>,
    commit_bit: Signal<Local, Bits<24>>,
    solo_bit: Signal<Local, Bits<24>>,
    wide_owner: Signal<Local, Bits<24>>,
    wide_starter: Signal<Local, Bits<24>>,
    wide_released: Signal<Local, Bits<24>>,
    wide_commit: Signal<Local, Bits<24>>,
    wide_solo: Signal<Local, Bits<24>>,
    falls_asleep: Signal<Local, Bits<24>>,
    tries: Signal<Local, Bits<24>>,
    becomes_due: Signal<Local, Bits<24>>,
    starting: Signal<Local, Bits<24>>,
    freed: Signal<Local, Bits<24>>,
    committed: Signal<Local, Bits<24>>,
    alone_ended: Signal<Local, Bits<24>>,
    takes: Signal<Local, Bit>,
    is_holder: Signal<Local, Bit>,
    has_waited_long: Signal<Local, Bit>,
    one_wait: Signal<Local, Bits<4>>,
    one: Signal<Local, Bits<24>>,
    none: Signal<Local, Bits<24>>,
}

impl Logic for ContextFlags {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, sleeping, trying, due, had_point, had_commit);
        dff_setup!(self, clock, token_is_held, token_holder, waited, wants_alone, alone, rests);
        self.one.next = 1.into();
        self.none.next = 0.into();
        self.one_wait.next = 1.into();
        self.asleep.next = self.sleeping.q.val();
        self.keeping.next = self.trying.q.val();
        self.busy.next = self.due.q.val();
        self.began.next = self.had_point.q.val();
        self.hinted.next = self.had_commit.q.val();
        self.waiter_valid.next = self.token_is_held.q.val();
        self.waiter.next = self.token_holder.q.val();
        self.solo_valid.next = self.wants_alone.q.val();
        self.solo_owner.next = self.alone.q.val();
        self.all_rest.next = self.rests.q.val();
        self.rests.d.next =
            (self.sleeping.q.val() == self.all.val()) & (self.due.q.val() == self.none.val()) & (!self.starts.val());

        // Each context as a bit. Those that are not built never show, or their flags would be built.
        self.wide_owner.next = bit_cast::<24, 5>(self.owner.val());
        self.wide_starter.next = bit_cast::<24, 5>(self.starter.val());
        self.wide_released.next = bit_cast::<24, 5>(self.released_owner.val());
        self.wide_commit.next = bit_cast::<24, 5>(self.commit_owner.val());
        self.wide_solo.next = bit_cast::<24, 5>(self.alone.q.val());
        self.owner_bit.next = self.one.val() << self.wide_owner.val();
        self.starter_bit.next = self.one.val() << self.wide_starter.val();
        self.released_bit.next = self.one.val() << self.wide_released.val();
        self.commit_bit.next = self.one.val() << self.wide_commit.val();
        self.solo_bit.next = self.one.val() << self.wide_solo.val();
        self.falls_asleep.next = 0.into();
        self.tries.next = 0.into();
        self.becomes_due.next = 0.into();
        self.starting.next = 0.into();
        self.freed.next = 0.into();
        self.committed.next = 0.into();
        self.alone_ended.next = 0.into();
        if self.sleeps.val() {
            self.falls_asleep.next = self.owner_bit.val() & self.all.val();
        }
        if self.keeps.val() {
            self.tries.next = self.owner_bit.val() & self.all.val();
        }
        if self.hands_over.val() {
            self.becomes_due.next = self.owner_bit.val() & self.all.val();
        }
        if self.starts.val() {
            self.starting.next = self.starter_bit.val() & self.all.val();
        }
        if self.released.val() {
            self.freed.next = self.released_bit.val();
        }
        if self.commit_ends.val() {
            self.committed.next = self.commit_bit.val() & self.all.val();
        }
        if self.solo_ends.val() {
            self.alone_ended.next = self.solo_bit.val();
        }
        self.sleeping.d.next = (self.sleeping.q.val() | self.falls_asleep.val()) & (!self.starting.val());
        self.trying.d.next =
            (self.trying.q.val() | self.tries.val()) & (!(self.starting.val() | self.alone_ended.val()));
        self.due.d.next = (self.due.q.val() | self.becomes_due.val()) & (!self.freed.val());
        self.had_point.d.next = self.had_point.q.val() | self.starting.val();
        self.had_commit.d.next = self.had_commit.q.val() | self.committed.val();

        // L2: the waiting token goes to who asks while it is free. And the wish to be alone.
        self.takes.next = self.asks_to_wait.val() & (!self.token_is_held.q.val());
        self.takes_token.next = self.takes.val();
        self.is_holder.next = (self.stops_waiting.val() & (self.token_holder.q.val() == self.owner.val()))
            | (self.solo_ends.val() & (self.token_holder.q.val() == self.alone.q.val()));
        if self.takes.val() {
            self.token_is_held.d.next = true;
            self.token_holder.d.next = self.owner.val();
        }
        // L3: who has met 8 foreign locks with the token keeps all others from trying again.
        self.has_waited_long.next = self.waited.q.val().get_bit(3);
        self.is_urgent.next = self.token_is_held.q.val() & self.has_waited_long.val();
        if self.waits.val() & (!self.has_waited_long.val()) {
            self.waited.d.next = self.waited.q.val() + self.one_wait.val();
        }
        if self.takes.val() {
            self.waited.d.next = 0.into();
        }
        if self.is_holder.val() {
            self.token_is_held.d.next = false;
        }
        if self.overflows.val() & (!self.wants_alone.q.val()) {
            self.wants_alone.d.next = true;
            self.alone.d.next = self.owner.val();
        }
        if self.solo_ends.val() {
            self.wants_alone.d.next = false;
        }

        if self.reset.val() | self.clears.val() {
            self.sleeping.d.next = self.all.val();
            self.trying.d.next = 0.into();
            self.due.d.next = 0.into();
            self.had_point.d.next = 0.into();
            self.had_commit.d.next = 0.into();
            self.token_is_held.d.next = false;
            self.wants_alone.d.next = false;
            self.rests.d.next = false;
        }
    }
}
