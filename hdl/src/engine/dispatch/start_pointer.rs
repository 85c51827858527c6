//! The pointer that goes round the contexts at work, one a clock.
//!
//! 1. The pointer stands still without `moves`. Reset and clear bring it back to context 0, before its first round.
//! 2. In every fourth round retries may start.
//! 3. Member `m` of team `g` is context `m jobs + g`, so the number of the team goes round the jobs meanwhile.
//!
//! Latency: 1 clock; the outputs are registers.

use super::next_point::{Planned, Pointer};
use crate::engine::types::{ContextId, Deal};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct StartPointer {
    pub clock: Signal<In, Clock>,
    /// The pointer goes back to context 0.
    pub restarts: Signal<In, Bit>,
    /// The numbers of contexts that work and of jobs.
    pub deal: Signal<In, Deal>,
    /// The pointer moves to the next context at this edge.
    pub moves: Signal<In, Bit>,
    /// The context under the pointer.
    pub pointer: Signal<Out, Pointer>,
    /// The pointer has gone round once (`is_planned`), or is in its first round (`planned`).
    pub is_planned: Signal<Out, Bit>,
    pub planned: Signal<Out, Planned>,
    /// The present round is one in which retries may start.
    pub rests_over: Signal<Out, Bit>,
    /// The sum `3 turn + 2` goes along with `turn`, because two sums in a row would limit the clock of the core.
    place: DFF<Pointer>,
    round: DFF<Bits<2>>,
    was_round: DFF<Bit>,
    after_turn: Signal<Local, ContextId>,
    after_team: Signal<Local, ContextId>,
    one_team: Signal<Local, ContextId>,
    one_turn: Signal<Local, ContextId>,
    three: Signal<Local, Bits<7>>,
    one_round: Signal<Local, Bits<2>>,
    resting_round: Signal<Local, Bits<2>>,
}

impl Logic for StartPointer {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, place, round, was_round);
        self.one_turn.next = 1.into();
        self.one_team.next = 1.into();
        self.three.next = 3.into();
        self.one_round.next = 1.into();
        self.resting_round.next = 0.into();
        self.pointer.next = self.place.q.val();
        self.is_planned.next = self.was_round.q.val();
        self.planned.next.valid = !self.was_round.q.val();
        self.planned.next.context = self.place.q.val().turn;
        self.planned.next.team = self.place.q.val().team;
        self.rests_over.next = self.round.q.val() == self.resting_round.val();
        self.after_turn.next = self.place.q.val().turn + self.one_turn.val();
        self.after_team.next = self.place.q.val().team + self.one_team.val();
        if self.moves.val() {
            self.place.d.next.turn = self.after_turn.val();
            self.place.d.next.third = self.place.q.val().third + self.three.val();
            self.place.d.next.team = self.after_team.val();
            if self.after_team.val() == self.deal.val().jobs {
                self.place.d.next.team = 0.into();
                self.place.d.next.is_first = false;
            }
            if self.after_turn.val() == self.deal.val().contexts {
                self.place.d.next.turn = 0.into();
                self.place.d.next.third = 2.into();
                self.place.d.next.is_first = true;
                self.was_round.d.next = true;
                self.round.d.next = self.round.q.val() + self.one_round.val();
            }
        }
        if self.restarts.val() {
            self.place.d.next.turn = 0.into();
            self.place.d.next.third = 2.into();
            self.place.d.next.team = 0.into();
            self.place.d.next.is_first = true;
            self.round.d.next = 0.into();
            self.was_round.d.next = false;
        }
    }
}
