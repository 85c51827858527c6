//! Wakes sleeping contexts: a pointer goes round them, one in each clock, and a walk starts where one is due.
//!
//! Hardware twin: the block `Starter`.

use super::attempts::Tables;
use super::contexts::{team_of, Set};
use super::defect::Defect;
use super::memory::Memory;
use super::visit::Bundle;
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
    /// The context, if it asks for a solo insertion and none is at work.
    solo: Option<usize>,
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
    /// Teams whose contexts all work, because the first round of their job is over.
    open_teams: Set,
}

impl Starter {
    /// The candidate, if it asks for a solo insertion.
    pub(super) fn solo(&self) -> Option<usize> {
        self.candidate.solo
    }

    /// The walk that starts at this edge, if the queue and the vertex memory are free.
    pub(super) fn wants(&self, was: &Registers) -> Option<Start> {
        self.candidate.due.filter(|_| was.contexts.solo == 0)
    }

    /// The walk of the context that the pointer left last, if one is due. If only one context works, it may be starting
    /// at this very edge, and then nothing is due.
    fn due(&self, was: &Registers, wires: &Wires, tables: &Tables, defect: Option<Defect>) -> Option<Start> {
        let Passed { context, id } = self.passed;
        let bit = 1 << context;
        let flags = &was.contexts;
        if flags.solo != 0 || flags.asleep & bit == 0 || was.command.contexts == 1 && self.candidate.due.is_some() {
            return None;
        }
        if flags.retrying & bit != 0 {
            // L1: a context that has aborted rests. L3: while the context with the priority of the team has waited for
            // long, no other context of the team retries.
            let rested = self.round == 0 || defect == Some(Defect::NeverRests);
            let jobs = if defect == Some(Defect::OnePriority) { 1 } else { was.command.jobs };
            let may = flags.may_try_again(context, jobs) || defect == Some(Defect::NobodyYields);
            let ready = flags.busy & bit == 0 && rested && may;
            return ready.then(|| Start { context, id: None, push: Bundle::look(context, tables.root[context]) });
        }
        let ready =
            !wires.has_changed && self.is_planned && id < was.command.arrived && self.works(was, context, defect);
        let team = team_of(context, was.command.jobs) as u32;
        let start = match flags.hinted & bit {
            // L11: without a root, the walk starts at the first record of the job.
            0 if defect == Some(Defect::StartsInAnyMesh) => 0,
            0 => 4 * team,
            _ => tables.root[context],
        };
        ready.then(|| Start { context, id: Some(id), push: Bundle::look(context, start) })
    }

    /// L8: whether a context takes points. The first points of each job go to the first context of its team.
    fn works(&self, was: &Registers, context: usize, defect: Option<Defect>) -> bool {
        let team = team_of(context, was.command.jobs);
        match defect {
            _ if context == team => was.seeder.seeded || was.contexts.began & 1 << context == 0,
            Some(Defect::AllFromTheStart) => was.seeder.seeded,
            Some(Defect::TeamsStartTogether) => self.open_teams != 0,
            _ => self.open_teams & 1 << team != 0,
        }
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
            let asks_for_solo = was.contexts.solo & 1 << self.passed.context != 0 && !was.solo.is_at_work();
            let solo = asks_for_solo.then_some(self.passed.context);
            let due = was.starter.due(was, wires, tables, defect);
            self.candidate = Candidate { due, solo };
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
            let jobs = was.command.jobs;
            self.open_teams |= Set::from(id >= FIRST_ROUND * jobs) << team_of(context, jobs);
        }
        if was.command.clears {
            *self = Self::default();
        }
    }
}

/// The vertex that a context takes next. The vertices of a job's first round all go to the first context of its team,
/// the later ones to the contexts of the team in turn. Behind the first triangles, vertex `i` of job `g` has the id
/// `i * jobs + g`.
fn next_id(was: &Registers, context: usize, memory: &Memory) -> u32 {
    let began = was.contexts.began & 1 << context != 0;
    let (id, jobs) = (memory.point_id[context], was.command.jobs);
    match (began, context as u32) {
        (false, first) if first < jobs => 3 * first + 2,
        (false, member) => FIRST_ROUND * jobs + member,
        (true, first) if id < 3 * jobs => 3 * jobs + first,
        (true, _) if id < FIRST_ROUND * jobs => id + jobs,
        (true, _) => id + was.command.contexts,
    }
}
