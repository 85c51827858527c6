//! Lock-step: the Verilated core and the model clock by clock, driven alike, compared at every root port at every clock.

mod report;
mod stream;

pub use report::Mismatch;
pub use stream::{Job, Stalls};

use crate::blocks;
use incircle_model::{ClockModel, Inputs, Outputs, Write};
use incircle_protocol::Config;
use report::History;
use verilated::{Model, PortId};

/// Output ports of the core with its probe, in the order in which [`words_of`] lists the model's outputs.
const OUTPUTS: [&str; 13] = [
    "command_ready",
    "response_valid",
    "response_data",
    "write_valid",
    "write_id",
    "write_vertices",
    "write_links",
    "write_v0",
    "write_v1",
    "write_v2",
    "write_n0",
    "write_n1",
    "write_n2",
];

/// A core and its model, always at the same clock.
pub struct Lockstep {
    core: Model,
    model: ClockModel,
    inputs: [PortId; 4],
    outputs: [PortId; OUTPUTS.len()],
    history: History,
    clocks: u64,
}

impl Lockstep {
    /// The Verilated core `name` (see `testbench/build.rs`) and the model of its configuration, after a reset out of random
    /// registers and memories.
    ///
    /// # Panics
    /// If there is no such core, or one of its ports is missing.
    pub fn new(name: &str, config: Config, seed: u32) -> Self {
        let mut core = blocks::randomized(name, seed);
        let port = |name: &str| core.port(name).unwrap_or_else(|error| panic!("{error}"));
        let inputs = ["reset", "command_valid", "command_data", "response_ready"].map(port);
        let outputs = OUTPUTS.map(port);
        let model = ClockModel::new(config).unwrap_or_else(|error| panic!("{error}"));
        core.set(inputs[0], 1);
        core.clock();
        core.set(inputs[0], 0);
        core.eval();
        Self {
            core,
            model,
            inputs,
            outputs,
            history: History::default(),
            clocks: 1,
        }
    }

    /// Writes a waveform from now on.
    ///
    /// # Panics
    /// If the file cannot be made.
    pub fn trace_to(&mut self, path: &std::path::Path) {
        self.core
            .trace_to(path)
            .unwrap_or_else(|error| panic!("{error}"));
    }

    /// Clocks since the start.
    pub fn clocks(&self) -> u64 {
        self.clocks
    }

    /// What the model shows now; the core shows the same, or the last clock was a mismatch.
    pub fn outputs(&self) -> Outputs {
        self.model.outputs()
    }

    /// One clock. Both are compared before the edge.
    ///
    /// # Errors
    /// The first port that differs.
    pub fn clock(&mut self, inputs: Inputs) -> Result<(), Mismatch> {
        let [reset, valid, data, ready] = self.inputs;
        self.core.set(reset, u64::from(inputs.reset));
        self.core.set(valid, u64::from(inputs.command_valid));
        self.core.set(data, u64::from(inputs.command_data));
        self.core.set(ready, u64::from(inputs.response_ready));
        let expected = self.model.outputs();
        self.history.note(self.clocks, inputs, expected);
        for (port, expected) in self.outputs.into_iter().zip(words_of(&expected)) {
            let found = self.core.get(port);
            if found != expected {
                let doing = self.model.describe();
                return Err(self.history.mismatch(
                    self.clocks,
                    port.name(),
                    expected,
                    found,
                    doing,
                ));
            }
        }
        self.core.clock();
        self.model.clock(inputs);
        self.clocks += 1;
        Ok(())
    }
}

/// The model's outputs as the core's ports carry them.
fn words_of(outputs: &Outputs) -> [u64; OUTPUTS.len()] {
    let Write {
        valid,
        id,
        vertices,
        links,
        record,
    } = outputs.write;
    let links = u64::from(links[0]) | u64::from(links[1]) << 1 | u64::from(links[2]) << 2;
    [
        u64::from(outputs.command_ready),
        u64::from(outputs.response_valid),
        u64::from(outputs.response_data),
        u64::from(valid),
        u64::from(id),
        u64::from(vertices),
        links,
        u64::from(record.v[0]),
        u64::from(record.v[1]),
        u64::from(record.v[2]),
        u64::from(record.n[0]),
        u64::from(record.n[1]),
        u64::from(record.n[2]),
    ]
}
