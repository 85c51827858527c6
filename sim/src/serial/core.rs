//! The Verilated core as a device of words, one clock at a time, for the software model of a link.

use incircle_model::serial::{core_identity, Passed, WordDevice};
use incircle_protocol::{Config, Identity, CORE_RUNS};
use verilated::{Model, PortId};

use crate::device::{description, living_description, CORE};
use crate::error::SimError;

/// A Verilated core and its two streams.
#[derive(Debug)]
pub(crate) struct StreamCore {
    model: Model,
    reset: PortId,
    command_valid: PortId,
    command_ready: PortId,
    command_data: PortId,
    response_valid: PortId,
    response_ready: PortId,
    response_data: PortId,
    response_both: PortId,
}

impl StreamCore {
    /// A core of this configuration, with or without runs, after its reset.
    pub(crate) fn new(config: Config, has_runs: bool) -> Result<Self, SimError> {
        let found = if has_runs { living_description(config)? } else { description(CORE, config)? };
        let model = Model::new(found);
        let mut core = Self {
            reset: model.port("reset")?,
            command_valid: model.port("command_valid")?,
            command_ready: model.port("command_ready")?,
            command_data: model.port("command_data")?,
            response_valid: model.port("response_valid")?,
            response_ready: model.port("response_ready")?,
            response_data: model.port("response_data")?,
            response_both: model.port("response_both")?,
            model,
        };
        core.model.port("clock")?;
        core.reset();
        Ok(core)
    }

    /// The identity of a core of this configuration, with or without runs.
    pub(crate) fn identity(config: Config, has_runs: bool) -> Identity {
        let core = core_identity(config);
        let runs = if has_runs { CORE_RUNS } else { 0 };
        Identity { features: core.features | runs, ..core }
    }
}

impl WordDevice for StreamCore {
    fn reset(&mut self) {
        self.model.set(self.command_valid, 0);
        self.model.set(self.reset, 1);
        for _ in 0..crate::device::RESET_CLOCKS {
            self.model.clock();
        }
        self.model.set(self.reset, 0);
        self.model.eval();
    }

    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed {
        self.model.set(self.command_valid, u64::from(command.is_some()));
        self.model.set(self.command_data, u64::from(command.unwrap_or(0)));
        self.model.set(self.response_ready, u64::from(takes_answer));
        // Outputs may depend on inputs of the same clock.
        self.model.eval();
        let is_taken = command.is_some() && self.model.get(self.command_ready) != 0;
        let is_given = takes_answer && self.model.get(self.response_valid) != 0;
        let data = self.model.get(self.response_data);
        let has_second = is_given && self.model.get(self.response_both) != 0;
        let answer = [is_given.then_some(data as u32), has_second.then_some((data >> 32) as u32)];
        self.model.clock();
        Passed { is_taken, answer }
    }
}
