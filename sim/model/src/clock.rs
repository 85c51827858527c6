//! The core, clock by clock: what every root port of the Verilog says at every clock.
//!
//! One [`ClockModel::clock`] is one rising edge. Every block of the core has its file here with the same registers, as a
//! small `Copy` struct. An edge takes a copy of all registers as they were, derives the wires from it, and lets
//! each block compute its next state from that copy, so no order of evaluation matters, as in hardware. What is pipelined
//! there (memories, predicates) is computed at the clock its record is read and handed over when the hardware is done.
//! Nothing is shared with the hardware but the protocol.

mod cavity;
mod command_port;
mod commit;
mod context;
mod counters;
mod memory;
mod pipeline;
mod release;
mod responder;
mod solo;
mod wires;

use cavity::Cavity;
use command_port::CommandPort;
use commit::Commit;
use context::Context;
use counters::Counters;
use incircle_protocol::{Config, ConfigError};
use memory::Memory;
use pipeline::Pipeline;
use release::Release;
use responder::Responder;
use solo::Solo;
use wires::Wires;

pub use memory::Write;

/// What drives the core before a clock edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inputs {
    /// Synchronous reset, active high.
    pub reset: bool,
    /// A command word is offered.
    pub command_valid: bool,
    /// The word.
    pub command_data: u32,
    /// The host takes an answer word.
    pub response_ready: bool,
}

/// What the core shows before a clock edge. All outputs are functions of registers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outputs {
    /// The core takes a command word.
    pub command_ready: bool,
    /// An answer word is offered.
    pub response_valid: bool,
    /// The word; holds the last one while none is offered.
    pub response_data: u32,
    /// The write port of the triangle memory (simulation builds).
    pub write: Write,
}

/// All registers of the core but those of the visit pipeline.
#[derive(Clone, Copy, Debug, Default)]
struct Registers {
    command: CommandPort,
    responder: Responder,
    context: Context,
    cavity: Cavity,
    commit: Commit,
    solo: Solo,
    release: Release,
    counters: Counters,
    write: Write,
}

/// The core at a clock.
#[derive(Clone, Debug)]
pub struct ClockModel {
    config: Config,
    registers: Registers,
    pipeline: Pipeline,
    memory: Memory,
}

impl ClockModel {
    /// The core of a configuration, as it is after a clock with reset.
    ///
    /// # Errors
    /// A parameter that no core can be built with.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        let config = config.check()?;
        let mut registers = Registers::default();
        registers.release.reset();
        Ok(Self { config, registers, pipeline: Pipeline::default(), memory: Memory::new(config) })
    }

    /// The outputs as they stand.
    pub fn outputs(&self) -> Outputs {
        let now = &self.registers;
        Outputs {
            command_ready: now.command.is_ready(now),
            response_valid: now.responder.valid,
            response_data: now.responder.data,
            write: now.write,
        }
    }

    /// The record with this id as it stands in the memory, as words of a `Read` answer.
    pub fn record_words(&self, id: u32) -> [u32; 3] {
        self.memory.record_words(id)
    }

    /// What the core is doing, for a reader of a mismatch report.
    pub fn describe(&self) -> String {
        let now = &self.registers;
        format!(
            "phase {:?}, point {} at {:?}, {} tokens out, ring {}, commit {:?}, solo {:?}, command {:?}",
            now.context.phase,
            now.context.id,
            now.context.position,
            now.cavity.outstanding,
            now.cavity.count,
            now.commit.state,
            now.solo.state,
            now.command.state,
        )
    }

    /// One rising edge.
    ///
    /// # Panics
    /// If a memory is read and written in a way that is undefined in silicon, which would be a fault in the design.
    pub fn clock(&mut self, inputs: Inputs) {
        if inputs.reset {
            self.registers = Registers::default();
            self.registers.release.reset();
            self.pipeline.reset();
            return;
        }
        let was = self.registers;
        let wires = Wires::of(&was, &self.pipeline, &self.memory, inputs, self.config);
        let now = &mut self.registers;
        now.command.clock(&was, &wires, self.config);
        now.responder.clock(&was, &wires, self.config);
        now.context.clock(&was, &wires);
        now.cavity.clock(&was, &wires, &mut self.memory, self.config);
        now.commit.clock(&was, &self.memory);
        now.solo.clock(&was, &wires);
        now.counters.clock(&was, &wires);
        self.pipeline.clock(&was, &wires, &mut self.memory);
        self.memory.clock(&was, &wires);
        now.release.clock(&was, &wires, &mut self.memory, self.config);
        now.write.clock(&was);
    }
}
