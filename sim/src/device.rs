//! A core behind its two streams.

use std::collections::VecDeque;
use std::path::Path;

use incircle_protocol::{Config, NAMED};
use verilated::{Model, ModelDescription, PortId};

use crate::error::{Awaited, SimError};
use crate::models;

/// Clocks that reset is held: one is enough for registers, more flush what has no reset.
pub(crate) const RESET_CLOCKS: u32 = 4;

/// What the build script puts before the name of a configuration.
const CORE: &str = "core_";

/// A simulated core, started and reset.
///
/// Time passes only inside [`SimDevice::send`] and [`SimDevice::receive`]. Answers are taken from the core as they come, also
/// while words are sent, and kept until asked for; so no order of calls can block the core.
#[derive(Debug)]
pub struct SimDevice {
    model: Model,
    ports: Ports,
    /// Words that have not been received, each with the clock that ended when it came.
    answers: VecDeque<(u32, u64)>,
    /// That of the word that was received last.
    answer_clock: Option<u64>,
    /// The command word that the core is offered.
    offered: Option<u32>,
    /// The command word that the last [`SimDevice::send`] left offered. The core may have taken it since.
    left: Option<u32>,
    clocks: u64,
}

#[derive(Debug)]
struct Ports {
    command_valid: PortId,
    command_ready: PortId,
    command_data: PortId,
    response_valid: PortId,
    response_data: PortId,
    response_both: PortId,
}

impl SimDevice {
    /// A core of this configuration.
    ///
    /// # Errors
    /// It is not one of [`incircle_protocol::NAMED`]: others were not translated when this crate was built.
    pub fn new(config: Config) -> Result<Self, SimError> {
        Self::of(description(config)?)
    }

    /// Any model that has the two streams.
    pub(crate) fn of(description: &'static ModelDescription) -> Result<Self, SimError> {
        let mut model = Model::new(description);
        let ports = Ports {
            command_valid: model.port("command_valid")?,
            command_ready: model.port("command_ready")?,
            command_data: model.port("command_data")?,
            response_valid: model.port("response_valid")?,
            response_data: model.port("response_data")?,
            response_both: model.port("response_both")?,
        };
        let reset = model.port("reset")?;
        let response_ready = model.port("response_ready")?;
        model.port("clock")?;
        model.set(reset, 1);
        for _ in 0..RESET_CLOCKS {
            model.clock();
        }
        model.set(reset, 0);
        model.set(response_ready, 1);
        model.eval();
        let clocks = u64::from(RESET_CLOCKS);
        Ok(Self { model, ports, answers: VecDeque::new(), answer_clock: None, offered: None, left: None, clocks })
    }

    /// Hands all `words` to the core, within `max_clocks` clocks.
    ///
    /// # Errors
    /// [`SimError::Timeout`]: the core did not take them all; the first `done` words are with it. To resume, call again with the words
    /// from `done` on. The first of those stays offered until the core takes it, as the protocol demands, so it may be taken during
    /// [`SimDevice::receive`]; the call that resumes knows, and sends it once. Words that start with another are sent after it.
    pub fn send(&mut self, words: &[u32], max_clocks: u64) -> Result<(), SimError> {
        let start = self.clocks;
        let end = start.saturating_add(max_clocks);
        let mut done = 0;
        if let (Some(left), Some(first)) = (self.left, words.first()) {
            if self.offered.is_some() && !self.hand_over(left, end) {
                return Err(self.timeout(Awaited::CommandWords, done, words.len(), start));
            }
            self.left = None;
            done = usize::from(*first == left);
        }
        for (done, &word) in words.iter().enumerate().skip(done) {
            if !self.hand_over(word, end) {
                self.left = Some(word);
                return Err(self.timeout(Awaited::CommandWords, done, words.len(), start));
            }
        }
        if self.left.is_none() {
            self.offer(None);
        }
        self.keep_waveform()
    }

    /// Fills `words` with the next words of the core, within `max_clocks` clocks.
    ///
    /// # Errors
    /// [`SimError::Timeout`]: the core has not given so many. Those it gave are kept for the next call, and `words` is as before.
    pub fn receive(&mut self, words: &mut [u32], max_clocks: u64) -> Result<(), SimError> {
        let start = self.clocks;
        while self.answers.len() < words.len() {
            if self.clocks - start >= max_clocks {
                let done = self.answers.len();
                return Err(self.timeout(Awaited::AnswerWords, done, words.len(), start));
            }
            if self.clock() {
                self.offer(None);
            }
        }
        let answers = self.answers.drain(..words.len());
        for (place, (word, clock)) in words.iter_mut().zip(answers) {
            *place = word;
            self.answer_clock = Some(clock);
        }
        self.keep_waveform()
    }

    /// Clocks since the device was made, reset included.
    pub fn clocks(&self) -> u64 {
        self.clocks
    }

    /// The clock, counted as [`SimDevice::clocks`] does, that ended when the word came that was received last. None before the first.
    pub fn answer_clock(&self) -> Option<u64> {
        self.answer_clock
    }

    /// Writes a VCD waveform of all signals from now on; dropping the device completes the file. Slows the
    /// simulation manyfold.
    ///
    /// # Errors
    /// [`SimError::Trace`]: the file cannot be made. When the disk fills later, `send` and `receive` say so.
    pub fn trace_to(&mut self, path: impl AsRef<Path>) -> Result<(), SimError> {
        Ok(self.model.trace_to(path)?)
    }

    /// Holds that the waveform, if one is written, is complete so far.
    fn keep_waveform(&mut self) -> Result<(), SimError> {
        Ok(self.model.trace_flush()?)
    }

    /// Offers a word to the core, or none.
    fn offer(&mut self, command: Option<u32>) {
        if self.offered == command {
            return;
        }
        self.offered = command;
        let data = command.unwrap_or(0);
        self.model.set(self.ports.command_valid, u64::from(command.is_some()));
        self.model.set(self.ports.command_data, u64::from(data));
        // Outputs may depend on inputs of the same clock.
        self.model.eval();
    }

    /// Offers a word until the core takes it or the clock is `end`; true if it is taken. The word is offered afterwards as well.
    fn hand_over(&mut self, word: u32, end: u64) -> bool {
        self.offer(Some(word));
        while self.clocks < end {
            if self.clock() {
                return true;
            }
        }
        false
    }

    /// One clock; an answer that the core offers is taken. True if the core takes the word it is offered.
    fn clock(&mut self) -> bool {
        let is_taken = self.offered.is_some() && self.model.get(self.ports.command_ready) != 0;
        if self.model.get(self.ports.response_valid) != 0 {
            let (words, clock) = (self.model.get(self.ports.response_data), self.clocks + 1);
            self.answers.push_back((words as u32, clock));
            if self.model.get(self.ports.response_both) != 0 {
                self.answers.push_back(((words >> 32) as u32, clock));
            }
        }
        self.model.clock();
        self.clocks += 1;
        is_taken
    }

    fn timeout(&self, awaited: Awaited, done: usize, wanted: usize, start: u64) -> SimError {
        SimError::Timeout { awaited, done, wanted, clocks: self.clocks - start, total: self.clocks }
    }
}

/// The translated core of a configuration.
pub(crate) fn description(config: Config) -> Result<&'static ModelDescription, SimError> {
    let found = NAMED.contains(&config).then(|| models::find(&format!("{CORE}{}", config.name))).flatten();
    found.ok_or_else(|| SimError::NotBuilt {
        name: config.name,
        points: config.points,
        contexts: config.contexts,
        ring: config.ring,
        built: built().join(", "),
    })
}

/// Names of the configurations that were translated when this crate was built.
fn built() -> Vec<&'static str> {
    let names = models::NAMES.iter();
    names.filter_map(|name| name.strip_prefix(CORE)).collect()
}
