//! Wakes sleeping contexts: a pointer goes round them, a context a clock, and starts a walk where one is due.

use super::attempts::Tables;
use super::memory::Memory;
use super::pipeline::Bundle;
use super::wires::Wires;
use super::{Defect, Registers};
use incircle_protocol::FIRST_ROUND;

/// Rounds of the pointer per round in which contexts that backed off may try again.
const BACK_OFF_ROUNDS: u32 = 4;

/// The context under the pointer and the point it would take.
#[derive(Clone, Copy, Debug, Default)]
struct Candidate {
    context: usize,
    /// The vertex it would take.
    id: u32,
    /// That has arrived.
    is_there: bool,
}

/// A walk that starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    pub context: usize,
    /// The vertex taken; `None` if the context tries its point again.
    pub id: Option<u32>,
    pub push: Bundle,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Starter {
    turn: usize,
    round: u32,
    candidate: Candidate,
    /// The first round is over: all contexts work.
    pub all_work: bool,
}

impl Starter {
    /// The pointer has just passed this context: its root and its point are at hand.
    pub(super) fn is_at(&self, context: usize) -> bool {
        self.candidate.context == context
    }

    /// The walk that starts at this edge, if nothing stands in its way.
    pub(super) fn wants(
        &self,
        was: &Registers,
        tables: &Tables,
        memory: &Memory,
        defect: Option<Defect>,
    ) -> Option<Start> {
        let Candidate { context, id, is_there } = self.candidate;
        let bit = 1 << context;
        let flags = &was.contexts;
        if flags.asleep & bit == 0 || flags.solo.is_some() {
            return None;
        }
        if flags.keeps & bit != 0 {
            let rested = self.round == 0 || defect == Some(Defect::NeverBacksOff);
            let may = flags.may_try_again(context) || defect == Some(Defect::NobodyYields);
            let ready = flags.busy & bit == 0 && rested && may;
            return ready.then(|| Start { context, id: None, push: Bundle::look(context, tables.root[context]) });
        }
        let works = match context {
            0 => was.seeder.seeded || flags.began & 1 == 0,
            _ => self.all_work || (defect == Some(Defect::AllFromTheStart) && was.seeder.seeded),
        };
        let ready = is_there && works;
        let start = if flags.hinted & bit != 0 { memory.hint[context] } else { 0 };
        ready.then(|| Start { context, id: Some(id), push: Bundle::look(context, start) })
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, memory: &mut Memory) {
        if let Some(Start { context, id: Some(id), .. }) = wires.start {
            memory.point_id[context] = id;
            memory.position[context] = memory.vertex(id);
            memory.since[context] = was.counters.now;
            self.all_work |= context == 0 && id >= FIRST_ROUND;
        }
        if !wires.start_is_blocked {
            let context = was.starter.turn;
            let id = next_id(was, context, memory);
            self.candidate = Candidate { context, id, is_there: id < was.command.arrived };
            self.turn += 1;
            if self.turn as u32 == was.command.contexts {
                self.turn = 0;
                self.round = (self.round + 1) % BACK_OFF_ROUNDS;
            }
        }
        if was.command.clears {
            *self = Self::default();
        }
    }
}

/// The vertex a context takes next: of the first round all go to context 0, then they are dealt out in turn.
fn next_id(was: &Registers, context: usize, memory: &Memory) -> u32 {
    let began = was.contexts.began & 1 << context != 0;
    let id = memory.point_id[context];
    match (began, context) {
        (false, 0) => 2,
        (false, _) => FIRST_ROUND + context as u32,
        (true, _) if id < FIRST_ROUND => id + 1,
        (true, _) => id + was.command.contexts,
    }
}
