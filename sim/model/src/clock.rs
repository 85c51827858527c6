//! The model clock by clock: the value of every root port of the Verilog at every clock.
//!
//! One [`ClockModel::clock`] is one rising edge. Each part of the core has a file here, with a small `Copy` struct of
//! the registers that decide what the root ports say and when. A part may stand for several blocks of the hardware, and
//! has fewer registers, since only the time of a pipeline is modelled: what memories and predicates compute in stages
//! is computed here in one step, at the clock in which the record is read, and handed over when the hardware would be
//! done. An edge takes a copy of all registers, derives the wires from the copy, and lets each part compute its next
//! state from both, so the order of evaluation does not matter, as in hardware. The model shares nothing with the
//! hardware but the protocol.

mod answer;
mod attempt;
mod attempts;
mod beat;
mod command_port;
mod commit;
mod commit_job;
mod contexts;
mod counters;
mod defect;
mod holes;
mod late_point;
mod living;
mod memory;
mod outcome;
mod pipeline;
mod ports;
mod questions;
mod record_reads;
mod release;
mod release_job;
mod responder;
mod ring;
mod runs;
mod seeder;
mod solo;
mod starter;
mod view;
mod visit;
mod watchdog;
mod wires;

use attempts::Tables;
use counters::Latencies;
use holes::Holes;
use incircle_protocol::{Config, ConfigError};
use late_point::LatePoint;
use living::LivingEngine;
use memory::Memory;
use pipeline::Pipeline;
use questions::{Launch, Questions};
use release::Release;
use ring::RingReader;
use visit::Bundle;
use wires::Registers;

pub use defect::Defect;
pub use living::{LivingDefect, RunCounts};
pub use memory::Write;
pub use ports::{Inputs, Outputs};
pub use view::{Activity, ContextView, VisitView};

/// The state of the core at a clock.
#[derive(Clone, Debug)]
pub struct ClockModel {
    config: Config,
    /// Number of this engine on the chip.
    engine: u8,
    registers: Registers,
    pipeline: Pipeline,
    ring: RingReader,
    release: Release,
    tables: Tables,
    memory: Memory,
    latencies: Latencies,
    defect: Option<Defect>,
    /// The living engine, in a core that has runs.
    living: Option<LivingEngine>,
    /// The questions and changes of a core with runs, and the deletions of one that has them too.
    questions: Option<Questions>,
    holes: Option<Holes>,
}

impl ClockModel {
    /// The first engine of a configuration, which is the core if it has no other, as it is after a clock with reset.
    ///
    /// # Errors
    /// A parameter that no core can be built with.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        Self::numbered(config, 0)
    }

    /// An engine of a chip of this configuration, as it is after a clock with reset.
    ///
    /// # Errors
    /// A parameter that no chip can be built with.
    pub fn numbered(config: Config, engine: u8) -> Result<Self, ConfigError> {
        let config = config.check()?;
        let mut release = Release::default();
        release.reset();
        Ok(Self {
            config,
            engine,
            registers: Registers::after_reset(config, engine),
            pipeline: Pipeline::default(),
            ring: RingReader::default(),
            release,
            tables: Tables::new(config.contexts),
            memory: Memory::new(config),
            latencies: Latencies::new(),
            defect: None,
            living: None,
            questions: None,
            holes: None,
        })
    }

    /// The same core without one of its rules, to show what the rule prevents.
    pub fn with_defect(mut self, defect: Defect) -> Self {
        self.defect = Some(defect);
        self
    }

    /// The outputs in the current state.
    pub fn outputs(&self) -> Outputs {
        let now = &self.registers;
        self.with_run_outputs(Outputs {
            command_ready: now.command.is_ready(now, self.sweeps(), self.point_waits()),
            response_valid: now.responder.valid,
            response_data: u64::from(now.responder.offered.low) | u64::from(now.responder.offered.high) << 32,
            response_both: now.responder.offered.both,
            response_last: now.responder.offered.last,
            write: now.write,
        })
    }

    /// Whether the last point of an `Insert` still waits for its context.
    fn point_waits(&self) -> bool {
        self.questions.as_ref().is_some_and(Questions::point_waits)
    }

    /// Whether memories are being cleared.
    fn sweeps(&self) -> bool {
        self.release.sweeps() || self.latencies.sweeps()
    }

    /// The record of this id as it stands in the memory, as words of a `Read` answer.
    pub fn record_words(&self, id: u32) -> [u32; 3] {
        self.memory.record_words(id)
    }

    /// The state of the core in a sentence, for readers of a report of a mismatch.
    pub fn describe(&self) -> String {
        let now = &self.registers;
        format!(
            "asleep {:x}, retrying {:x}, busy {:x}, with priority {:x}, solo {:x}, {} of {} points finished, \
             commit {:?}, solo {:?}, command {:?}",
            now.contexts.asleep,
            now.contexts.retrying,
            now.contexts.busy,
            now.contexts.holders,
            now.contexts.solo,
            now.contexts.finished,
            now.command.arrived,
            now.commit.state,
            now.solo.state,
            now.command.state,
        )
    }

    /// Simulates one rising edge.
    ///
    /// # Panics
    /// A memory is read and written in a way that is undefined in silicon, which would be a fault of the design.
    pub fn clock(&mut self, inputs: Inputs) {
        if inputs.reset {
            let Registers { features, skips_free, .. } = self.registers;
            self.registers = Registers { features, skips_free, ..Registers::after_reset(self.config, self.engine) };
            if let Some(living) = &mut self.living {
                living.reset();
            }
            self.reset_runs();
            self.release.reset();
            self.pipeline.reset();
            self.ring.reset();
            self.latencies.reset();
            return;
        }
        let (inputs, run_signals) = self.question_signals(inputs);
        let (inputs, living_write) = self.clock_living(inputs);
        let was = self.registers;
        let wires = self.wires(inputs);
        let raised = run_signals.and_then(|signals| self.clock_questions(&signals, &wires));
        let now = &mut self.registers;
        now.command.clock(&was, &wires, self.config);
        if let Some(vertex) = raised {
            now.command.raise(vertex);
        }
        now.responder.clock(&was, &wires, &self.latencies, self.config);
        now.contexts.clock(&was, &wires, self.config.contexts, self.defect);
        now.seeder.clock(&was, &wires);
        now.solo.clock(&was, &wires, &self.tables, &self.memory);
        now.finished_points.clock(&was, &wires);
        now.watchdog.clock(&was, &wires, self.config);
        now.counters.clock(&was, &wires, &self.pipeline);
        now.counted = was.counters;
        now.outcome = wires.outcome;
        now.noted = was.contexts;
        now.push = wires
            .outcome
            .and_then(|outcome| outcome.push)
            .or(wires.solo_push)
            .or(wires.start.map(|start| start.push))
            .or(wires.fill_push);
        if let Some(Launch { context, record, .. }) = wires.launch {
            now.push = Some(Bundle::look(context, record));
        }
        self.latencies.clock(&was, &wires);
        self.pipeline.clock(&was, &wires, &mut self.memory, self.defect);
        now.starter.clock(&was, &wires, &self.tables, &mut self.memory, self.defect);
        self.ring.clock(wires.head_is_taken, wires.outcome.as_ref(), &self.memory);
        let takes_new = wires.solo_inserts && self.memory.kept(was.solo.vertex()).is_none();
        now.commit.clock(&was, wires.head, &mut self.memory, takes_new, wires.seeds, wires.holds);
        self.tables.clock(&wires, &mut self.memory);
        self.memory.clock(&was, &wires);
        self.release.clock(&wires, &mut self.memory, self.config, self.defect);
        now.write.clock(&was);
        now.coming_point = wires.coming_point;
        now.late_point = LatePoint::after(was.late_point, was.coming_point, &wires);
        now.storing = wires.stored;
        if let Some(write) = living_write {
            now.write = write;
        }
        self.clock_holes(&was, &wires);
    }
}
