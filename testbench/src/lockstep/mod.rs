//! Lock-step: the Verilated core and the model run side by side, with equal inputs, and every root
//! port is compared at every clock.

mod faults;
mod recording;
mod report;
mod stream;

pub use faults::{Fault, Piece, CHANGE_FAULTS, FAULTS, QUESTION_FAULTS};
pub use recording::KEPT;
pub use report::Mismatch;
pub use stream::{Job, Stalls};

use crate::blocks;
use incircle_model::{ChipModel, Defect, Inputs, Outputs, Write};
use incircle_protocol::Config;
use recording::Recording;
use report::History;
use std::path::Path;
use verilated::{Model, PortId, TraceError};

/// Input ports of the core, in the order in which [`drive`] sets them.
const INPUTS: [&str; 4] = ["reset", "command_valid", "command_data", "response_ready"];

/// Output ports of the two streams, in the order in which [`words_of`] lists the model's outputs.
const OUTPUTS: [&str; 5] = ["command_ready", "response_valid", "response_data", "response_both", "response_last"];

/// Fields of the write port of an engine, in the order in which [`write_words`] lists them.
const WRITE: [&str; 10] = ["valid", "id", "vertices", "links", "v0", "v1", "v2", "n0", "n1", "n2"];

/// Names of all output ports of a chip of this many engines with its probe.
fn output_names(engines: u32) -> Vec<String> {
    let number = |engine: u32| if engines == 1 { String::new() } else { engine.to_string() };
    let write = |engine| WRITE.map(|field| format!("write{}_{field}", number(engine)));
    OUTPUTS.map(str::to_string).into_iter().chain((0..engines).flat_map(write)).collect()
}

/// Number of clocks before a mismatch that the waveform shows.
const TRACED: usize = 2000;

/// Clocks of the first reset. One clock is enough in a running core. At power-up, registers without
/// reset may hold values that they never hold later, such as a context beyond the last; registers with
/// reset overwrite them within these clocks.
const FIRST_RESET: usize = 4;

/// Input port of cores that have faults behind switches.
const SWITCHES: &str = "faults";

/// The reasons why a run leaves no waveform.
#[derive(Debug, thiserror::Error)]
pub enum WaveformError {
    /// The first inputs of the run are no longer in memory.
    #[error("the run is longer than the {KEPT} clocks that are kept: split it into shorter runs")]
    TooLong,
    /// The file cannot be made, or the core was built without waveforms.
    #[error("{0}")]
    Trace(#[from] TraceError),
}

/// A core and its model, always at the same clock.
pub struct Lockstep {
    name: String,
    seed: Option<u32>,
    /// Value of the port [`SWITCHES`] for the whole run.
    faults: u64,
    core: Model,
    model: ChipModel,
    engines: u32,
    inputs: [PortId; INPUTS.len()],
    outputs: Vec<PortId>,
    recording: Recording,
    history: History,
    clocks: u64,
}

impl Lockstep {
    /// Makes the Verilated core `name` (see `testbench/build.rs`) and the model of its configuration. Both come out of
    /// a reset; before it the core's registers and memories are random.
    ///
    /// # Panics
    /// Panics if there is no such core, or one of its ports is missing.
    pub fn new(name: &str, config: Config, seed: u32) -> Self {
        Self::from_state(name, config, Some(seed), 0)
    }

    /// Makes the pair as [`Lockstep::new`] does, but out of registers and memories of zeros, the
    /// state of an ECP5 after configuration.
    ///
    /// # Panics
    /// Panics as [`Lockstep::new`] does.
    pub fn configured(name: &str, config: Config) -> Self {
        Self::from_state(name, config, None, 0)
    }

    /// Makes the pair as [`Lockstep::new`] does, for a core with switches, and turns
    /// on the switches of these [`FAULTS`], or of these [`QUESTION_FAULTS`] or [`CHANGE_FAULTS`] for a core with runs.
    ///
    /// # Panics
    /// Panics as [`Lockstep::new`] does, and if there is no fault of such a name.
    pub fn faulty(name: &str, config: Config, seed: u32, faults: &[&str]) -> Self {
        let place_in = |list: &[Fault], name: &str| list.iter().position(|fault| fault.name == name);
        let lists = [FAULTS, QUESTION_FAULTS, CHANGE_FAULTS];
        let place = |name: &&str| lists.into_iter().find_map(|list| place_in(list, name));
        let switch = |name| 1 << place(name).unwrap_or_else(|| panic!("no fault {name:?}"));
        Self::from_state(name, config, Some(seed), faults.iter().map(switch).sum())
    }

    /// Lets the model leave out a rule, as the core beside it does.
    pub fn with_defect(self, defect: Defect) -> Self {
        self.with_defect_in(0, defect)
    }

    /// Gives the model the questions that the core beside it has.
    #[must_use]
    pub fn with_core_runs(mut self) -> Self {
        self.model = self.model.with_core_runs();
        self
    }

    /// Lets one engine of the model leave out a rule.
    pub fn with_defect_in(mut self, engine: usize, defect: Defect) -> Self {
        self.model = self.model.with_defect(engine, defect);
        self
    }

    fn from_state(name: &str, config: Config, seed: Option<u32>, faults: u64) -> Self {
        let core = started(name, seed, faults);
        let port = |name: &str| core.port(name).unwrap_or_else(|error| panic!("{error}"));
        let outputs = output_names(config.engines).iter().map(|name| port(name)).collect();
        let inputs = INPUTS.map(port);
        let model = ChipModel::new(config).unwrap_or_else(|error| panic!("{error}"));
        let (name, recording) = (name.to_string(), Recording::keeping(KEPT));
        let engines = config.engines;
        Self {
            name,
            seed,
            faults,
            core,
            model,
            engines,
            inputs,
            outputs,
            recording,
            history: History::default(),
            clocks: 1,
        }
    }

    /// Replays the whole run on a fresh core, and writes the last clocks as a waveform.
    ///
    /// # Errors
    /// The run is longer than [`KEPT`], the file cannot be made, or the core was built without waveforms.
    pub fn leave_waveform(&self, path: &Path) -> Result<(), WaveformError> {
        let recording = self.recording.whole().ok_or(WaveformError::TooLong)?;
        let mut core = started(&self.name, self.seed, self.faults);
        let shown = recording.len().saturating_sub(TRACED);
        for (clock, inputs) in recording.iter().enumerate() {
            if clock == shown {
                core.trace_to(path)?;
            }
            drive(&mut core, &self.inputs, inputs);
            core.clock();
        }
        core.trace_close();
        Ok(())
    }

    /// Number of clocks since the start.
    pub fn clocks(&self) -> u64 {
        self.clocks
    }

    /// Outputs of the model. The core has the same ones, or the last clock was a mismatch.
    pub fn outputs(&self) -> Outputs {
        self.model.outputs()
    }

    /// Runs one clock. The outputs of both are compared before the edge.
    ///
    /// # Errors
    /// The first port that differs.
    pub fn clock(&mut self, inputs: Inputs) -> Result<(), Mismatch> {
        drive(&mut self.core, &self.inputs, &inputs);
        self.recording.note(inputs);
        let expected = self.model.outputs();
        self.history.note(self.clocks, inputs, expected);
        let writes = (0..self.engines).flat_map(|engine| write_words(self.model.write(engine as usize)));
        for (&port, expected) in self.outputs.iter().zip(words_of(&expected).into_iter().chain(writes)) {
            let found = self.core.get(port);
            if found != expected {
                let doing = self.model.describe();
                return Err(self.history.mismatch(self.clocks, port.name(), expected, found, doing));
            }
        }
        self.core.clock();
        self.model.clock(inputs);
        self.clocks += 1;
        Ok(())
    }
}

/// Makes a core with these faults after its first reset, out of random registers and memories,
/// or of zeros without a seed.
fn started(name: &str, seed: Option<u32>, faults: u64) -> Model {
    let mut core = seed.map_or_else(|| blocks::model(name), |seed| blocks::randomized(name, seed));
    let reset = core.port(INPUTS[0]).unwrap_or_else(|error| panic!("{error}"));
    if let Ok(switches) = core.port(SWITCHES) {
        core.set(switches, faults);
    }
    core.set(reset, 1);
    (0..FIRST_RESET).for_each(|_| core.clock());
    core.set(reset, 0);
    core.eval();
    core
}

fn drive(core: &mut Model, ports: &[PortId; INPUTS.len()], inputs: &Inputs) {
    core.set(ports[0], u64::from(inputs.reset));
    core.set(ports[1], u64::from(inputs.command_valid));
    core.set(ports[2], u64::from(inputs.command_data));
    core.set(ports[3], u64::from(inputs.response_ready));
}

/// The model's outputs in the form of the core's ports.
fn words_of(outputs: &Outputs) -> [u64; OUTPUTS.len()] {
    [
        u64::from(outputs.command_ready),
        u64::from(outputs.response_valid),
        outputs.response_data,
        u64::from(outputs.response_both),
        u64::from(outputs.response_last),
    ]
}

/// The fields of a write port of the model.
fn write_words(write: Write) -> [u64; WRITE.len()] {
    let Write { valid, id, vertices, links, record } = write;
    let links = u64::from(links[0]) | u64::from(links[1]) << 1 | u64::from(links[2]) << 2;
    let ([v0, v1, v2], [n0, n1, n2]) = (record.v.map(u64::from), record.n.map(u64::from));
    [u64::from(valid), u64::from(id), u64::from(vertices), links, v0, v1, v2, n0, n1, n2]
}
