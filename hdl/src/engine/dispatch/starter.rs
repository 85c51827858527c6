//! Wakes sleeping contexts: a pointer goes round them, one a clock, and starts a walk where one is due.
//!
//! 1. A context starts if it sleeps and has a point to try again, no commit or release is due, and it has rested: contexts that try again
//!    start in every fourth round of the pointer only, which spreads them (L1), and not beside one that has waited for long (L3).
//! 2. Or if it sleeps and its next point has come. Until context 0 has taken vertex 16, no other context works, but in a batch (L8).
//!    A start that may find the queue taken, or the vertex memory's port, is made in the next clock. The pointer waits, and does so
//!    whenever a visit completes: what that asks for is known late.
//! 3. The walk of a new point starts at the star of the context's last commit, at the first record of its mesh if there is none.
//! 4. Who wants to be alone starts when everybody rests and the pointer has passed it.
//! 5. In the first round of the pointer nobody starts: `PlanTable` writes down what each context takes first.
//! 6. The pointer is two contexts ahead. In the clock after it has stood at a context, that one's next vertex is there, and it is
//!    decided whether it is due and where it would start; in the clock after that it starts, unless somebody else has the queue.
//!
//! Latency: 2 clocks from the pointer to `starts`.
//!
//! Of two contexts, 0 takes vertex 2 when that has come, the first round is over and the queue is free. It falls asleep, keeps its point,
//! and tries it again from record 9 in the next round that is a fourth one:
//! ```text
//! arrived           2  3  3  3  3  3  3  3  3  3  3  3  3  3  3  3
//! came            ___/^^\_________________________________________
//! is_done         ____________/^^^^^\_____________________________
//! is_blocked      ____________/^^\________________________________
//! asleep            3  3  3  3  3  3  2  2  3  3  3  3  3  2  2  2
//! keeping           0  0  0  0  0  0  0  0  1  1  1  1  1  0  0  0
//! owner             .  .  0  1  0  0  0  1  0  1  0  1  0  1  0  1
//! starts          _______________/^^\_________________/^^\________
//! takes           _______________/^^\_____________________________
//! taken_id          .  .  .  .  .  2  .  .  .  .  .  .  .  .  .  .
//! u                 .  .  .  .  .  0  .  .  .  .  .  .  9  .  .  .
//! ```
//!
//! Source: points dealt to contexts lie in the vertex memory, which is their queue.

use super::plan_table::PlanTable;
use crate::engine::types::{context_bits, Deal};
use crate::leaf::LutMemory;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Starts walks; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Starter {
    /// Reset and clear start at context 0.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// Contexts that work, and which points are theirs.
    pub deal: Signal<In, Deal>,
    /// Points that have come.
    pub arrived: Signal<In, Bits<15>>,
    /// One is being stored: the vertex memory's port is taken.
    pub came: Signal<In, Bit>,
    /// The first triangle stands.
    pub seeded: Signal<In, Bit>,
    /// See `ContextFlags`.
    pub asleep: Signal<In, Bits<24>>,
    pub keeping: Signal<In, Bits<24>>,
    pub busy: Signal<In, Bits<24>>,
    pub began: Signal<In, Bits<24>>,
    pub hinted: Signal<In, Bits<24>>,
    /// Somebody wants to be alone: nobody starts.
    pub solo_valid: Signal<In, Bit>,
    /// Nobody but this context may try again.
    pub is_urgent: Signal<In, Bit>,
    pub waiter: Signal<In, Bits<5>>,
    /// A visit completes; the queue may take the visits that follow it at this edge.
    pub is_done: Signal<In, Bit>,
    pub is_blocked: Signal<In, Bit>,
    /// Where a context goes on when it tries again.
    pub root_enable: Signal<In, Bit>,
    pub root_owner: Signal<In, Bits<5>>,
    pub root: Signal<In, Bits<15>>,
    /// Where its next walk starts.
    pub hint_enable: Signal<In, Bit>,
    pub hint_owner: Signal<In, Bits<5>>,
    pub hint: Signal<In, Bits<15>>,
    /// This context starts to walk at this record.
    pub starts: Signal<Out, Bit>,
    pub owner: Signal<Out, Bits<5>>,
    pub u: Signal<Out, Bits<15>>,
    /// With this new point.
    pub takes: Signal<Out, Bit>,
    pub taken_id: Signal<Out, Bits<15>>,
    /// No visit is out and no lock held; who wants to be alone, and is.
    pub all_rest: Signal<In, Bit>,
    pub solo_owner: Signal<In, Bits<5>>,
    pub solo_is_at_work: Signal<In, Bit>,
    /// It inserts its point alone, from `u` on.
    pub solo_starts: Signal<Out, Bit>,
    pub solo_p: Signal<Out, Bits<15>>,
    turn: DFF<Bits<5>>,
    /// `3 turn + 2`; two sums in a row would set the clock of the core.
    third: DFF<Bits<7>>,
    round: DFF<Bits<2>>,
    /// The pointer has gone round once.
    is_planned: DFF<Bit>,
    /// The context that the pointer has left last, the vertex that it would take, and the one it has; whether it would take its first in a
    /// batch, and what follows that.
    passed: DFF<Bits<5>>,
    passed_id: DFF<Bits<15>>,
    passed_point: DFF<Bits<15>>,
    passed_is_seed: DFF<Bit>,
    passed_dealt: DFF<Bits<7>>,
    /// The one before: the vertex that it would take, whether that is behind the first round, and the one after it; whether it is due, with its
    /// point or a new one, where it would start, and whether it wants to be alone.
    candidate: DFF<Bits<5>>,
    candidate_id: DFF<Bits<15>>,
    candidate_is_dealt: DFF<Bit>,
    candidate_plan: DFF<Bits<15>>,
    candidate_point: DFF<Bits<15>>,
    wants_again: DFF<Bit>,
    wants_new: DFF<Bit>,
    from: DFF<Bits<15>>,
    is_alone: DFF<Bit>,
    /// The first round is over, or there is none.
    all_work: DFF<Bit>,
    points: LutMemory<5, 15>,
    roots: LutMemory<5, 15>,
    hints: LutMemory<5, 15>,
    plans: PlanTable,
    contexts: Signal<Local, Bits<5>>,
    index: Signal<Local, Bits<5>>,
    is_asleep: Signal<Local, Bit>,
    tries_again: Signal<Local, Bit>,
    is_rested: Signal<Local, Bit>,
    may_try: Signal<Local, Bit>,
    may_work: Signal<Local, Bit>,
    is_there: Signal<Local, Bit>,
    is_barred: Signal<Local, Bit>,
    wants: Signal<Local, Bit>,
    lacks_port: Signal<Local, Bit>,
    begins: Signal<Local, Bit>,
    moves: Signal<Local, Bit>,
    is_taken: Signal<Local, Bit>,
    after_turn: Signal<Local, Bits<5>>,
    one_turn: Signal<Local, Bits<5>>,
    three: Signal<Local, Bits<7>>,
    first_context: Signal<Local, Bits<5>>,
    one_round: Signal<Local, Bits<2>>,
    resting_round: Signal<Local, Bits<2>>,
}

impl Starter {
    /// The starter of a configuration.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        let table = || LutMemory::new(bits, 15);
        Self { points: table(), plans: PlanTable::new(config), roots: table(), hints: table(), ..Self::default() }
    }
}

impl Logic for Starter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            turn,
            third,
            round,
            is_planned,
            passed,
            passed_id,
            passed_point,
            candidate,
            candidate_id
        );
        dff_setup!(self, clock, candidate_plan, candidate_point, wants_again, wants_new, from, is_alone, all_work);
        dff_setup!(self, clock, passed_is_seed, passed_dealt, candidate_is_dealt);
        clock!(self, clock, points, plans, roots, hints);
        self.one_turn.next = 1.into();
        self.three.next = 3.into();
        self.one_round.next = 1.into();
        self.resting_round.next = 0.into();
        self.first_context.next = 0.into();
        self.contexts.next = self.deal.val().contexts;

        // The context under the pointer: which vertex it would take.
        self.points.read_address.next = self.turn.q.val();
        self.plans.turn.next = self.turn.q.val();
        self.plans.third.next = self.third.q.val();
        self.plans.is_planned.next = self.is_planned.q.val();
        self.plans.taken.next = self.passed_id.q.val();
        self.plans.taker.next = self.passed.q.val();
        self.plans.took_seed.next = self.passed_is_seed.q.val();
        self.plans.taken_dealt.next = self.passed_dealt.q.val();
        self.plans.deal.next = self.deal.val();

        // The one before: is it due? If only one context works, it may be the one that starts at this edge; and a point that is inserted
        // alone is not to be tried again.
        self.index.next = self.passed.q.val();
        self.is_barred.next = self.solo_valid.val()
            | ((self.wants_again.q.val() | self.wants_new.q.val()) & (self.contexts.val() == self.one_turn.val()));
        self.is_asleep.next = self.asleep.val().get_bit(self.index.val().index()) & (!self.is_barred.val());
        self.tries_again.next = self.keeping.val().get_bit(self.index.val().index());
        // L1: who has failed rests until a fourth round. L3: and while another is urgent.
        self.is_rested.next =
            (!self.busy.val().get_bit(self.index.val().index())) & (self.round.q.val() == self.resting_round.val());
        self.may_try.next = (!self.is_urgent.val()) | (self.passed.q.val() == self.waiter.val());
        // L8: the first points are context 0's.
        self.may_work.next = self.all_work.q.val();
        if self.passed.q.val() == self.first_context.val() {
            self.may_work.next = self.seeded.val() | (!self.began.val().get_bit(0));
        }
        self.is_there.next = self.is_planned.q.val() & (self.passed_id.q.val() < self.arrived.val());
        self.roots.read_address.next = self.passed.q.val();
        self.hints.read_address.next = self.passed.q.val();

        // The one before that: does it start?
        self.wants.next = (self.wants_again.q.val() | self.wants_new.q.val()) & (!self.solo_valid.val());
        self.lacks_port.next = self.wants_new.q.val() & self.came.val();
        self.moves.next = !(self.wants.val() & (self.is_done.val() | self.lacks_port.val()));
        self.begins.next = self.wants.val() & (!self.is_blocked.val()) & (!self.lacks_port.val());
        self.is_taken.next = self.wants_new.q.val() & self.begins.val();
        self.starts.next = self.begins.val();
        self.takes.next = self.is_taken.val();
        self.owner.next = self.candidate.q.val();
        self.taken_id.next = self.candidate_id.q.val();
        self.u.next = self.from.q.val();
        self.solo_p.next = self.candidate_point.q.val();
        self.solo_starts.next =
            self.solo_valid.val() & self.all_rest.val() & (!self.solo_is_at_work.val()) & self.is_alone.q.val();

        // The tables.
        self.points.write_address.next = self.candidate.q.val();
        self.points.write_data.next = self.candidate_id.q.val();
        self.points.write_enable.next = self.is_taken.val();
        self.plans.takes.next = self.is_taken.val();
        self.plans.owner.next = self.candidate.q.val();
        self.plans.planned.next = self.candidate_plan.q.val();
        self.roots.write_address.next = self.root_owner.val();
        self.roots.write_data.next = self.root.val();
        self.roots.write_enable.next = self.root_enable.val();
        self.hints.write_address.next = self.hint_owner.val();
        self.hints.write_data.next = self.hint.val();
        self.hints.write_enable.next = self.hint_enable.val();

        // Before all work, nobody but context 0 takes anything.
        if self.is_taken.val() & self.candidate_is_dealt.q.val() {
            self.all_work.d.next = true;
        }
        self.after_turn.next = self.turn.q.val() + self.one_turn.val();
        if self.begins.val() {
            self.wants_again.d.next = false;
            self.wants_new.d.next = false;
        }
        if self.moves.val() {
            self.candidate.d.next = self.passed.q.val();
            self.candidate_id.d.next = self.passed_id.q.val();
            self.candidate_is_dealt.d.next = self.plans.taken_is_dealt.val();
            self.candidate_plan.d.next = self.plans.after_taken.val();
            self.candidate_point.d.next = self.passed_point.q.val();
            self.wants_again.d.next =
                self.is_asleep.val() & self.tries_again.val() & self.is_rested.val() & self.may_try.val();
            self.wants_new.d.next =
                self.is_asleep.val() & (!self.tries_again.val()) & self.is_there.val() & self.may_work.val();
            self.is_alone.d.next = self.passed.q.val() == self.solo_owner.val();
            self.from.d.next = self.plans.first_record.val();
            if self.hinted.val().get_bit(self.index.val().index()) {
                self.from.d.next = self.hints.read_data.val();
            }
            if self.tries_again.val() {
                self.from.d.next = self.roots.read_data.val();
            }
            self.passed.d.next = self.turn.q.val();
            self.passed_id.d.next = self.plans.due.val().id;
            self.passed_point.d.next = self.points.read_data.val();
            self.passed_is_seed.d.next = self.plans.due.val().is_seed;
            self.passed_dealt.d.next = self.plans.first_dealt.val();
            self.turn.d.next = self.after_turn.val();
            self.third.d.next = self.third.q.val() + self.three.val();
            if self.after_turn.val() == self.contexts.val() {
                self.turn.d.next = 0.into();
                self.third.d.next = 2.into();
                self.is_planned.d.next = true;
                self.round.d.next = self.round.q.val() + self.one_round.val();
            }
        }
        if self.reset.val() | self.clears.val() {
            self.turn.d.next = 0.into();
            self.third.d.next = 2.into();
            self.round.d.next = 0.into();
            self.is_planned.d.next = false;
            self.wants_again.d.next = false;
            self.wants_new.d.next = false;
            self.is_alone.d.next = false;
            self.all_work.d.next = self.deal.val().is_batch & (!self.reset.val());
        }
    }
}
