//! The living engine, clock by clock: runs of questions and changes of a mesh that stands, in all contexts side by
//! side.
//!
//! The engine has the memories, the locks and the stages of the insertion engine, and works while that one rests. Its
//! rules, M1 to M13, are those of `docs/living-mesh.md`. Each clock, one visit completes and one is issued, one record
//! is written, one lock is cleared, one word of a command is taken and two words of an answer are given.

mod answers;
mod cavity;
mod commit;
mod context;
mod counts;
mod defect;
mod endings;
mod fill;
mod item;
mod judge;
mod pipeline;
mod port;
mod question;
mod reader;
mod release;
mod shared;
mod sight;
mod solo;
mod star;
mod visit;
mod walk;
mod work;

use super::beat::Beat;
use super::memory::{Memory, Write};
use context::Context;
pub use counts::RunCounts;
pub use defect::LivingDefect;
use incircle_protocol::{Config, Opcode, RunKind};
pub(super) use item::Signature;
use pipeline::{Around, Flight, Pipeline};
use port::Port;
use reader::Reader;
use shared::Shared;
use visit::{Ask, Bundle};
use work::Work;

/// The state of the mesh when the insertion engine has finished.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Standing {
    /// Number of records.
    pub records: u32,
    pub arrived: u32,
    pub duplicates: u32,
    pub refused: u32,
}

/// The signals from the rest of the core that the engine sees at an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Signals {
    /// The command word that is taken.
    pub word: Option<u32>,
    /// Whether the offered beat is taken.
    pub is_taken: bool,
    /// The write port of the triangle memory.
    pub port: Write,
}

#[derive(Clone, Debug)]
pub(super) struct LivingEngine {
    contexts: Vec<Context>,
    pipeline: Pipeline,
    port: Port,
    reader: Reader,
    sh: Shared,
    /// Whether a run has changed the mesh since the last `Clear`.
    pub has_changed: bool,
    /// The mesh that was taken over.
    standing: Option<Standing>,
    /// Whether the solo insertion of the first context that waits for one is under way.
    solo_runs: bool,
}

impl LivingEngine {
    pub(super) fn new(config: Config, defect: Option<LivingDefect>) -> Self {
        Self {
            contexts: vec![Context::default(); config.contexts as usize],
            pipeline: Pipeline::default(),
            port: Port::default(),
            reader: Reader::default(),
            sh: Shared::new(config, defect),
            has_changed: false,
            standing: None,
            solo_runs: false,
        }
    }

    /// Forgets everything but the parameters.
    pub(super) fn reset(&mut self) {
        *self = Self::new(self.sh.config, self.sh.defect);
    }

    /// Whether a command is in progress.
    pub(super) fn is_active(&self) -> bool {
        self.port.is_active()
    }

    /// Whether nothing is in progress. Without its fence, an engine may still write when a command has ended.
    pub(super) fn rests(&self) -> bool {
        !self.is_active() && self.sh.defect.is_none()
    }

    pub(super) fn is_ready(&self) -> bool {
        self.port.is_ready(&self.contexts)
    }

    pub(super) fn offered(&self) -> Option<Beat> {
        self.sh.answers.offered
    }

    /// Events of the last run.
    pub(super) fn counts(&self) -> &RunCounts {
        &self.sh.counts
    }

    /// Takes over the mesh that the insertion engine has made, with the record at which the next walk of each context
    /// begins.
    pub(super) fn take_over(&mut self, standing: &Standing, hints: &[u32], memory: &Memory) {
        if self.standing.replace(*standing) == Some(*standing) {
            return;
        }
        let sh = &mut self.sh;
        (sh.records, sh.arrived) = (standing.records, standing.arrived);
        (sh.duplicates, sh.refused) = (standing.duplicates, standing.refused);
        sh.is_vertex.fill(false);
        for vertex in (0..standing.records).flat_map(|id| memory.record(id).v) {
            if let Some(is_vertex) = sh.is_vertex.get_mut(vertex as usize) {
                *is_vertex = true;
            }
        }
        sh.vertices = sh.is_vertex.iter().map(|&is_vertex| u32::from(is_vertex)).sum();
        for (context, &hint) in self.contexts.iter_mut().zip(hints) {
            // A context that has taken no point since the last `Clear` has its hint from a mesh before, which may have
            // had more records.
            context.hint = if hint < standing.records { hint } else { 0 };
        }
    }

    /// Begins a command whose opcode has come.
    pub(super) fn begin(&mut self, opcode: Opcode, contexts: u32, has_mesh: bool, signature: Signature) {
        let kind = RunKind::of(opcode);
        self.sh.replies = kind.is_some();
        self.sh.kind = kind.unwrap_or(RunKind::InsertAs);
        self.sh.counts = RunCounts::default();
        self.has_changed |= has_mesh && kind.is_some_and(RunKind::is_change);
        // A stretch of the curve begins where that of the context before has ended.
        if self.port.items() >= contexts {
            let hints: Vec<u32> = self.contexts[..contexts as usize].iter().map(|context| context.hint).collect();
            for (place, hint) in hints.into_iter().enumerate() {
                self.contexts[(place + 1) % contexts as usize].hint = hint;
            }
            // The first stretch begins where it began in the run before.
            self.contexts[0].hint = self.sh.first_hint.unwrap_or(self.contexts[0].hint);
        }
        self.sh.first_hint = None;
        for context in &mut self.contexts {
            context.near = [None; 2];
            context.sight.by_number = self.sh.defect == Some(LivingDefect::NearestByNumber);
        }
        self.port.begin(opcode, contexts as usize, has_mesh, signature);
    }

    /// Simulates one edge, and returns the write that reaches the port in the next clock.
    pub(super) fn clock(&mut self, signals: &Signals, memory: &mut Memory) -> Option<Write> {
        self.sh.now += 1;
        self.sh.counts.clocks += u64::from(self.is_active());
        let asked = self.work(memory);
        let around = Around {
            port: &signals.port,
            cleared: self.sh.release.cleared(),
            records: self.sh.records,
            defect: self.sh.defect,
        };
        self.sh.counts.visits += u64::from(self.pipeline.reads());
        self.pipeline.clock(asked, &self.contexts, memory, &around);
        let committed = self.sh.commit.clock(self.sh.now, self.sh.defect);
        let write = committed.write;
        self.sh.counts.writes += u64::from(write.is_some());
        self.note(committed, memory);
        if let Some(id) = self.sh.release.cleared() {
            memory.locks[id as usize] = false;
        }
        if let Some(context) = self.sh.release.clock() {
            self.note_release(context);
        }
        // The flips begin when the last write has reached the memory.
        if write.is_none() && !signals.port.valid {
            self.begin_solo(memory);
        }
        if let Some(word) = signals.word {
            self.port.take(word, &mut self.contexts, &mut self.sh, &mut self.reader);
        }
        let is_done = self.is_done();
        self.port.clock(is_done, &mut self.sh, &mut self.reader, memory);
        self.sh.answers.clock(signals.is_taken);
        write
    }

    /// Whether all items that have come are done, and no lock is set.
    fn is_done(&self) -> bool {
        let is_idle = |context: &Context| context.is_idle();
        let unfenced = self.sh.defect == Some(LivingDefect::AnswersBeforeWritten) && self.sh.begun == 0;
        unfenced && self.contexts.iter().all(|context| context.items.is_empty() && context.item.is_none())
            || self.contexts.iter().all(is_idle)
                && self.sh.commit.is_idle()
                && self.sh.release.is_idle()
                && self.pipeline.is_empty()
    }

    /// The work of the context whose visit completes, or else of the next one that waits for a place in the queue.
    fn work(&mut self, memory: &Memory) -> Bundle {
        let now = self.sh.now;
        for x in 0..self.contexts.len() {
            if self.contexts[x].rests_until.is_some_and(|until| until <= now) {
                self.contexts[x].rests_until = None;
                self.sh.wake(x);
            }
        }
        let mut asked = Bundle::default();
        if let Some(flight) = self.pipeline.completion() {
            asked = self.complete(&flight, memory);
        }
        let may_start = self.sh.solo.is_empty() || self.sh.defect == Some(LivingDefect::SoloBesideOthers);
        if asked.is_empty() && may_start {
            if let Some(x) = self.sh.ready.pop_front() {
                let mut work = Work { x, cx: &mut self.contexts[x], sh: &mut self.sh, memory, asked };
                work.go_on();
                asked = work.asked;
            }
        }
        asked
    }

    fn complete(&mut self, flight: &Flight, memory: &Memory) -> Bundle {
        let x = flight.visit.context;
        let walks = matches!(flight.visit.ask, Ask::Walk | Ask::Root);
        self.sh.counts.walk_visits += u64::from(walks);
        let asked = Bundle::default();
        let mut work = Work { x, cx: &mut self.contexts[x], sh: &mut self.sh, memory, asked };
        match flight.visit.ask {
            Ask::Walk => work.walked(flight),
            Ask::Root => work.rooted(flight),
            Ask::Test { entry, after, cavity_entry } => work.tested(flight, entry, after, cavity_entry),
            Ask::Star { left, .. } => work.star_visited(flight, left),
            Ask::Outside { place } => work.outside_visited(flight, place),
            Ask::Corners { other, .. } if other == work.cx.sight.vertex => work.last_edge_tested(flight),
            Ask::Corners { .. } => work.corners_tested(flight),
            Ask::Around { left } => work.around_visited(flight, left),
            Ask::Hull => work.hull_visited(flight),
        }
        work.asked
    }
}
