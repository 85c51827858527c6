//! Runs on the core: the living engine works while the insertion engine rests, and has the memories and both channels.

use super::command_port::State as CommandState;
use super::defect::Defect;
use super::holes::Holes;
use super::living::{LivingDefect, LivingEngine, RunCounts, Signals, Signature, Standing};
use super::memory::Write;
use super::ports::{Inputs, Outputs};
use super::questions::{Events, ItemEnd, Launch, Questions, Signals as QuestionSignals};
use super::visit::Completion;
use super::wires::{Registers, Wires};
use super::ClockModel;
use incircle_protocol::{
    command_opcode, ConfigError, Opcode, Outcome, RunKind, CORE_RUNS, FEATURE_RUNS, MAX_DELETE_RING,
};

impl ClockModel {
    /// The same core with the commands for a mesh that stands, the runs, which its identity then offers.
    #[must_use]
    pub fn with_runs(mut self) -> Self {
        self.living = Some(LivingEngine::new(self.config, None));
        self.registers.features |= FEATURE_RUNS;
        self
    }

    /// The same core with runs, and without one of their rules.
    #[must_use]
    pub fn with_runs_without(mut self, rule: LivingDefect) -> Self {
        self.living = Some(LivingEngine::new(self.config, Some(rule)));
        self.registers.features |= FEATURE_RUNS;
        self
    }

    /// The same core with runs as the hardware does them, clock by clock. Its identity then offers them.
    ///
    /// # Panics
    /// The boundary list is longer than [`MAX_DELETE_RING`]: the hardware refuses such a core.
    #[must_use]
    pub fn with_core_runs(mut self) -> Self {
        assert!(self.config.ring <= MAX_DELETE_RING, "{}", ConfigError::RingForDeletions(self.config.ring));
        self.registers.features |= CORE_RUNS;
        self.registers.skips_free = true;
        self.questions = Some(Questions::new(self.config));
        self.holes = Some(Holes::new(self.config.contexts as usize));
        self
    }

    /// Forgets all runs.
    pub(super) fn reset_runs(&mut self) {
        self.questions = self.questions.as_ref().map(|_| Questions::new(self.config));
        self.holes = self.holes.as_ref().map(|_| Holes::new(self.config.contexts as usize));
    }

    /// Simulates one edge of the blocks of deletions, and counts the vertices that they take away.
    pub(super) fn clock_holes(&mut self, was: &Registers, wires: &Wires) {
        let now = &mut self.registers;
        let comes_back = wires.committed.map(|job| job.vertex).filter(|_| was.commit.has_kept());
        let solo = Some(was.solo.vertex()).filter(|&v| wires.solo_inserts && self.memory.kept(v).is_some());
        if let Some(vertex) = solo {
            self.memory.take_kept(vertex);
        }
        let back = u32::from(comes_back.is_some()) + u32::from(solo.is_some());
        now.deleted += u32::from(wires.erased.is_some());
        now.kept = now.kept + u32::from(wires.erased.is_some()) - back;
        if let Some((context, star)) = wires.outcome.and_then(|outcome| Some((outcome.context, outcome.star?))) {
            self.memory.carried[context] = star.carried;
        }
        if let Some(holes) = &mut self.holes {
            holes.clock(
                wires.outcome.as_ref().filter(|_| wires.finds),
                wires.fill_push.is_some(),
                wires.fill_end.is_some(),
                &mut self.memory,
            );
            now.filled = holes.write();
            let is_mark = now.filled.vertices && now.filled.record.v == [wires.infinite; 3];
            if is_mark && self.defect == Some(Defect::LeavesFreeRecordsUnmarked) {
                now.filled.valid = false;
            }
        }
        if was.command.clears {
            (now.deleted, now.kept) = (0, 0);
            self.memory.clear_kept();
        }
    }

    /// What the last run did. `None` for a core without runs, and for one with the blocks of the hardware
    /// ([`ClockModel::with_core_runs`]), of which [`ClockModel::run_latencies`] tells how long its items took.
    pub fn run_counts(&self) -> Option<&RunCounts> {
        self.living.as_ref().map(LivingEngine::counts)
    }

    /// For each item that the last run has begun, in the order in which they ended, the number of clocks from its start
    /// to its end. Items that are refused before they begin have none. `None` for a core without runs.
    pub fn run_latencies(&self) -> Option<&[u32]> {
        match (&self.living, &self.questions) {
            (Some(living), _) => Some(&living.counts().latencies),
            (None, Some(questions)) => Some(questions.latencies()),
            (None, None) => None,
        }
    }

    /// The outputs of the core, given those of the insertion engine.
    pub(super) fn with_run_outputs(&self, outputs: Outputs) -> Outputs {
        let (is_active, is_ready, offered) = match (&self.living, &self.questions) {
            (Some(living), _) => (living.is_active(), living.is_ready(), living.offered()),
            (None, Some(questions)) => (questions.is_active(), questions.is_ready(), questions.offered()),
            (None, None) => return outputs,
        };
        let command_ready = if is_active { is_ready } else { outputs.command_ready };
        match offered.filter(|_| !outputs.response_valid) {
            None => Outputs { command_ready, ..outputs },
            Some(beat) => Outputs {
                command_ready,
                response_valid: true,
                response_data: u64::from(beat.low) | u64::from(beat.high) << 32,
                response_both: beat.both,
                response_last: beat.last,
                write: outputs.write,
            },
        }
    }

    /// The inputs that are left for the rest of the core beside the blocks of runs, and the signals for these.
    pub(super) fn question_signals(&self, inputs: Inputs) -> (Inputs, Option<QuestionSignals>) {
        let awaits_command = self.registers.command.state == CommandState::Command && !self.sweeps();
        let has_mesh = self.has_mesh();
        let Some(questions) = &self.questions else {
            return (inputs, None);
        };
        let command = &self.registers.command;
        let is_active = questions.is_active();
        let word = Some(inputs.command_data).filter(|_| inputs.command_valid);
        let answers = |kind: &RunKind| self.registers.features & kind.feature() != 0;
        let kind = word.and_then(opcode_of).and_then(RunKind::of).filter(answers);
        let begins = kind.filter(|_| awaits_command && !is_active);
        let signals = QuestionSignals {
            begins,
            word: word.filter(|_| is_active),
            is_taken: inputs.response_ready && !self.registers.responder.valid,
            clears: command.clears,
            has_mesh,
            contexts: command.contexts as usize,
            signature: u32::from(self.engine) << 8 | u32::from(command.tag),
        };
        let command_valid = inputs.command_valid && !is_active && begins.is_none();
        (Inputs { command_valid, ..inputs }, Some(signals))
    }

    /// Simulates one edge of the blocks of runs. Returns the vertex that has come into the mesh with an item of a
    /// change.
    pub(super) fn clock_questions(&mut self, signals: &QuestionSignals, wires: &Wires) -> Option<u32> {
        let events = self.change_events(wires);
        let raised = self.questions.as_mut()?.clock(signals, &events, &self.memory);
        if let Some(Launch { context, item, returns, .. }) = wires.launch {
            self.memory.point_id[context] = item.vertex;
            self.memory.position[context] = item.place;
            self.memory.target[context] = item.target;
            self.memory.inserts[context] = returns;
            self.memory.since[context] = self.registers.counters.now;
        }
        raised
    }

    /// The item of a change that begins at this edge. The queue of visits takes one bundle a clock.
    pub(super) fn launch(&self, is_blocked: bool) -> Option<Launch> {
        let was = &self.registers;
        let may = !is_blocked && was.contexts.solo == 0 && !was.solo.is_at_work();
        let lacks_port = |launch: &Launch| launch.returns && was.has_late_point();
        self.questions.as_ref().filter(|_| may).and_then(Questions::launch).filter(|launch| !lacks_port(launch))
    }

    /// The events of the insertion engine that concern the items of changes.
    fn change_events(&self, wires: &Wires) -> Events {
        let was = &self.registers;
        let end = |context: usize, duplicate: Option<Completion>| ItemEnd {
            context,
            vertex: self.memory.point_id[context],
            early: None,
            duplicate: duplicate.map(|done| done.corner),
        };
        let ends = wires.outcome.filter(|outcome| outcome.commit.is_some() || outcome.duplicate).map(|outcome| {
            let finds = wires.finds;
            let end = end(outcome.context, wires.done.filter(|_| outcome.duplicate && !finds));
            let early = if outcome.moves_in_place { Outcome::Done } else { Outcome::ManyNeighbors };
            ItemEnd { early: Some(early).filter(|_| finds), ..end }
        });
        // The item of a move goes on when its hole is full.
        let fill_ends = wires
            .fill_end
            .filter(|fill| fill.is_flat || !wires.moves)
            .map(|fill| ItemEnd { early: Some(Outcome::Flat).filter(|_| fill.is_flat), ..end(fill.context, None) });
        let root = wires.done.filter(|done| wires.outcome.is_some() && done.visit.is_root());
        let solo_ends = wires.solo_ends.then(|| {
            let duplicate = if wires.solo_inserts { None } else { was.solo.last_visit() };
            end(was.solo.context(), duplicate)
        });
        Events {
            ends,
            fill_ends,
            solo_ends,
            root: root.map(|done| (done.visit.context, done.visit.record)),
            committed: wires.committed.or(wires.erased.filter(|_| !wires.moves)).map(|job| (job.context, job.vertex)),
            put_out: wires.erased.filter(|_| wires.moves).map(|job| job.context),
            taken: wires.start.and_then(|start| start.id),
            launch: wires.launch,
            fetches: self.pipeline.fetches() || was.storing.is_some() || was.has_late_point(),
            all_rest: was.contexts.rest,
            arrival: was.command.came.then(|| (was.command.came_id, self.memory.vertex(was.command.came_id))),
            arrived: was.command.arrived,
        }
    }

    /// Whether there is a mesh to ask and to change. A batch has several.
    fn has_mesh(&self) -> bool {
        self.registers.command.jobs == 1 && self.registers.commit.records > 0 && !self.registers.watchdog.stuck
    }

    /// Simulates one edge of the living engine. Returns the inputs that are left for the rest of the core, and the
    /// write that reaches the port in the next clock.
    pub(super) fn clock_living(&mut self, inputs: Inputs) -> (Inputs, Option<Write>) {
        let is_command = self.registers.command.state == CommandState::Command;
        let clears = self.registers.command.clears;
        // Between its commands the living engine has nothing to do.
        let may_begin = inputs.command_valid && is_command || clears;
        if self.living.as_ref().is_none_or(|living| living.rests() && !may_begin) {
            return (inputs, None);
        }
        let is_ready = self.outputs().command_ready;
        let word = (inputs.command_valid && is_ready).then_some(inputs.command_data);
        let standing = self.standing();
        let has_mesh = self.has_mesh();
        let signature = Signature { engine: self.engine, tag: self.registers.command.tag };
        let contexts = self.registers.command.contexts;
        let Some(living) = &mut self.living else {
            return (inputs, None);
        };
        let is_active = living.is_active();
        let mut is_mine = is_active;
        if let Some(opcode) = word.filter(|_| is_command && !is_active).and_then(opcode_of) {
            let is_run = RunKind::of(opcode).is_some();
            let reads = matches!(opcode, Opcode::Insert | Opcode::Read | Opcode::Triangles);
            is_mine = is_run || living.has_changed && reads;
            if is_mine {
                if !living.has_changed {
                    living.take_over(&standing, &self.tables.root, &self.memory);
                }
                living.begin(opcode, contexts, has_mesh, signature);
            }
        }
        if clears {
            living.reset();
        }
        let signals = Signals {
            word: word.filter(|_| is_active),
            is_taken: inputs.response_ready && !self.registers.responder.valid,
            port: self.registers.write,
        };
        let write = living.clock(&signals, &mut self.memory);
        (Inputs { command_valid: inputs.command_valid && !is_mine, ..inputs }, write)
    }

    /// The mesh as the insertion engine leaves it.
    fn standing(&self) -> Standing {
        let now = &self.registers;
        Standing {
            records: now.commit.records,
            arrived: now.command.arrived,
            duplicates: now.counted.duplicates,
            refused: now.command.refused,
        }
    }
}

/// The command of an opcode word.
fn opcode_of(word: u32) -> Option<Opcode> {
    Opcode::from_u8(command_opcode(word))
}
