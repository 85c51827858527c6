//! Wakes sleeping contexts: a pointer visits one context in each clock, round and round, and starts a walk
//! if one is due.
//!
//! Hardware twin: the block `Starter`.

use super::attempts::Tables;
use super::defect::Defect;
use super::memory::Memory;
use super::pipeline::Bundle;
use super::wires::{Registers, Wires};
use incircle_protocol::FIRST_ROUND;

/// Contexts that have aborted may try again in one of this many rounds of the pointer.
const REST_ROUNDS: u32 = 4;

/// The context that the pointer left last, and the vertex that it would take.
#[derive(Clone, Copy, Debug, Default)]
struct Passed {
    context: usize,
    id: u32,
}

/// The context before that one, and the decision about it.
#[derive(Clone, Copy, Debug, Default)]
struct Candidate {
    /// The walk that is due, unless something holds it.
    due: Option<Start>,
    /// Whether the context asks for a solo insertion.
    is_solo: bool,
}

/// A walk that starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    pub context: usize,
    /// The vertex that is taken; `None` if the context tries its point again.
    pub id: Option<u32>,
    pub push: Bundle,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Starter {
    turn: usize,
    round: u32,
    /// Whether the pointer has gone round once. Before that no context starts.
    is_planned: bool,
    passed: Passed,
    candidate: Candidate,
    /// Whether all contexts work, because the first round is over or there is none.
    pub all_work: bool,
}

impl Starter {
    /// Whether the candidate is the context that asks for a solo insertion.
    pub(super) fn is_at_solo(&self) -> bool {
        self.candidate.is_solo
    }

    /// The walk that starts at this edge, if the queue and the vertex memory are free.
    pub(super) fn wants(&self, was: &Registers) -> Option<Start> {
        self.candidate.due.filter(|_| was.contexts.solo.is_none())
    }

    /// The walk of the context that the pointer left last, if one is due. If only one context works, it may be starting
    /// at this very edge, and then nothing is due.
    fn due(&self, was: &Registers, tables: &Tables, defect: Option<Defect>) -> Option<Start> {
        let Passed { context, id } = self.passed;
        let bit = 1 << context;
        let flags = &was.contexts;
        if flags.solo.is_some() || flags.asleep & bit == 0 || was.command.contexts == 1 && self.candidate.due.is_some()
        {
            return None;
        }
        if flags.retrying & bit != 0 {
            // L1: a context that has aborted rests. L3: no other context retries while the one with the priority
            // has waited for long.
            let rested = self.round == 0 || defect == Some(Defect::NeverRests);
            let may = flags.may_try_again(context) || defect == Some(Defect::NobodyYields);
            let ready = flags.busy & bit == 0 && rested && may;
            return ready.then(|| Start { context, id: None, push: Bundle::look(context, tables.root[context]) });
        }
        // L8: the first points go to context 0.
        let works = match context {
            0 => was.seeder.seeded || flags.began & 1 == 0,
            _ => self.all_work || (defect == Some(Defect::AllFromTheStart) && was.seeder.seeded),
        };
        let ready = self.is_planned && id < was.command.arrived && works;
        let start = match flags.hinted & bit {
            // Without a root, the walk starts at the first record of the job.
            0 if was.command.batch => 4 * context as u32,
            0 => 0,
            _ => tables.root[context],
        };
        ready.then(|| Start { context, id: Some(id), push: Bundle::look(context, start) })
    }

    pub(super) fn clock(
        &mut self,
        was: &Registers,
        wires: &Wires,
        tables: &Tables,
        memory: &mut Memory,
        defect: Option<Defect>,
    ) {
        if wires.start.is_some() {
            self.candidate.due = None;
        }
        if !wires.start_is_held {
            let context = was.starter.turn;
            let is_solo = was.contexts.solo == Some(self.passed.context);
            let due = was.starter.due(was, tables, defect);
            self.candidate = Candidate { due, is_solo };
            self.passed = Passed { context, id: next_id(was, context, memory) };
            self.turn += 1;
            if self.turn as u32 == was.command.contexts {
                self.turn = 0;
                self.is_planned = true;
                self.round = (self.round + 1) % REST_ROUNDS;
            }
        }
        if let Some(Start { context, id: Some(id), .. }) = wires.start {
            memory.point_id[context] = id;
            memory.position[context] = memory.vertex(id);
            memory.since[context] = was.counters.now;
            self.all_work |= context == 0 && id >= FIRST_ROUND;
        }
        if was.command.clears {
            *self = Self { all_work: was.command.batch, ..Self::default() };
        }
    }
}

/// The vertex that a context takes next. The vertices of the first round all go to context 0, and the later
/// ones are dealt to the contexts in turn. A batch has no first round; each context begins with the third of
/// its own first three points.
fn next_id(was: &Registers, context: usize, memory: &Memory) -> u32 {
    let began = was.contexts.began & 1 << context != 0;
    let id = memory.point_id[context];
    let dealt_from = was.command.dealt_from();
    match (began, context as u32) {
        (false, context) if was.command.batch => 3 * context + 2,
        (false, 0) => 2,
        (false, context) => dealt_from + context,
        (true, context) if id < dealt_from && was.command.batch => dealt_from + context,
        (true, _) if id < dealt_from => id + 1,
        (true, _) => id + was.command.contexts,
    }
}
