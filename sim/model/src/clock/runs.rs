//! Runs on the core: the living engine works while the insertion engine rests, and has the memories and both channels.

use super::command_port::State as CommandState;
use super::living::{LivingDefect, LivingEngine, RunCounts, Signals, Signature, Standing};
use super::memory::Write;
use super::ports::{Inputs, Outputs};
use super::questions::{Questions, Signals as QuestionSignals};
use super::ClockModel;
use incircle_protocol::{command_opcode, Opcode, RunKind};

impl ClockModel {
    /// The same core with the commands for a mesh that stands, the runs, which its identity then offers.
    #[must_use]
    pub fn with_runs(mut self) -> Self {
        self.living = Some(LivingEngine::new(self.config, None));
        self.registers.has_runs = true;
        self
    }

    /// The same core with runs, and without one of their rules.
    #[must_use]
    pub fn with_runs_without(mut self, rule: LivingDefect) -> Self {
        self.living = Some(LivingEngine::new(self.config, Some(rule)));
        self.registers.has_runs = true;
        self
    }

    /// The same core with questions about a mesh that stands, and no other runs: a core of the hardware as far as it is
    /// built. Its identity does not offer runs.
    #[must_use]
    pub fn with_questions(mut self) -> Self {
        self.questions = Some(Questions::new(self.config.contexts));
        self
    }

    /// What the last run did. `None` for a core without runs.
    pub fn run_counts(&self) -> Option<&RunCounts> {
        self.living.as_ref().map(LivingEngine::counts)
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

    /// Simulates one edge of the questions. Returns the inputs that are left for the rest of the core.
    pub(super) fn clock_questions(&mut self, inputs: Inputs) -> Inputs {
        let awaits_command = self.registers.command.state == CommandState::Command && !self.sweeps();
        let has_mesh = self.has_mesh();
        let Some(questions) = &mut self.questions else {
            return inputs;
        };
        let command = &self.registers.command;
        let is_active = questions.is_active();
        let word = Some(inputs.command_data).filter(|_| inputs.command_valid);
        let kind = word.and_then(opcode_of).and_then(RunKind::of).filter(|&kind| Questions::answers(kind));
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
        questions.clock(&signals, &self.memory);
        Inputs { command_valid: inputs.command_valid && !is_active && begins.is_none(), ..inputs }
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
