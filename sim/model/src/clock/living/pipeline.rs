//! The visit pipeline: queue, issue, reads of record and vertices, predicates. One visit enters in each clock, visits
//! complete in the order of their issue, and a visit takes 18 clocks from its request to the requests that follow it,
//! as in the pipeline of insertions, of which this one has all stages.

use super::context::Context;
use super::defect::LivingDefect;
use super::judge::{judge, Verdict};
use super::visit::{Ask, Bundle, Visit};
use crate::clock::memory::{Memory, Write};
use crate::mesh::Record;
use std::collections::VecDeque;

/// Number of clocks from the issue register to the completion register.
const STAGES: usize = 16;
/// Number of clocks from the read of a record to the read of its vertices.
const VERTEX_STAGE: usize = 3;

/// A visit in the stages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight {
    pub visit: Visit,
    pub record: Record,
    /// Whether the visit took the lock.
    pub took: bool,
    /// Whether another context holds the lock.
    pub foreign: bool,
    /// Whether the record was being written, or had never been.
    pub torn: bool,
    pub verdict: Verdict,
}

/// What the memories are told in a clock beside the visit that is issued.
pub(super) struct Around<'a> {
    pub port: &'a Write,
    /// The lock that is cleared at this edge.
    pub cleared: Option<u32>,
    /// Ids from here on have no record yet.
    pub records: u32,
    pub defect: Option<LivingDefect>,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Pipeline {
    entering: Bundle,
    queue: VecDeque<Visit>,
    issued: Option<Visit>,
    stages: [Option<Flight>; STAGES],
    /// Place of the completion register in `stages`, which are used as a ring.
    head: usize,
}

impl Pipeline {
    /// The visit that completes in this clock.
    pub(super) fn completion(&self) -> Option<Flight> {
        self.stages[self.head]
    }

    /// Whether no visit is in flight.
    pub(super) fn is_empty(&self) -> bool {
        self.entering.is_empty()
            && self.queue.is_empty()
            && self.issued.is_none()
            && self.stages.iter().all(Option::is_none)
    }

    /// Whether a visit reads the memories in this clock.
    pub(super) fn reads(&self) -> bool {
        self.issued.is_some()
    }

    /// Simulates one edge, at which these visits are asked for.
    pub(super) fn clock(&mut self, asked: Bundle, contexts: &[Context], memory: &mut Memory, around: &Around) {
        self.stages[self.head] = self.issued.map(|visit| read(visit, memory, around));
        let judged = (self.head + STAGES - VERTEX_STAGE) % STAGES;
        if let Some(flight) = &mut self.stages[judged] {
            let sight = &contexts[flight.visit.context].sight;
            flight.verdict = judge(&flight.visit, &flight.record, sight, memory);
        }
        self.head = (self.head + 1) % STAGES;
        self.queue.extend(self.entering.visits());
        self.issued = self.queue.pop_front();
        self.entering = asked;
    }
}

/// Reads a record, and takes its lock if the visit asks for it.
fn read(visit: Visit, memory: &mut Memory, around: &Around) -> Flight {
    let is_open = around.defect == Some(LivingDefect::LeavesTheRingOpen) && matches!(visit.ask, Ask::Outside { .. });
    let (took, held) = match visit.ask.locks() && !is_open {
        true => memory.take_lock(visit.record, visit.context, around.cleared, None),
        false => (false, false),
    };
    let foreign = match around.defect {
        Some(LivingDefect::TakesOwnForForeign) => visit.ask.locks() && !took && !is_open,
        Some(LivingDefect::IgnoresForeignLocks) => false,
        _ => held,
    };
    // M9: such a record is not complete.
    let is_written = around.port.valid && around.port.id == visit.record;
    let torn = (is_written || visit.record >= around.records)
        && !matches!(visit.ask, Ask::Corners { .. })
        && around.defect != Some(LivingDefect::ReadsTheUnwritten);
    Flight { visit, record: memory.record(visit.record), took, foreign, torn, verdict: Verdict::default() }
}
