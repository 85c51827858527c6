//! A Verilated core behind its two streams of words, driven clock by clock.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use incircle_protocol::{Config, Layout, CORE_COORD_BITS, NAMED};
use verilated::{Model, ModelDescription, PortId, TraceError};

use crate::error::{Awaited, SimError};
use crate::job_watch::{JobWatch, Moment};
use crate::models;

/// Number of clocks for which reset is held. One is enough for registers; the others flush what has no reset.
pub(crate) const RESET_CLOCKS: u32 = 4;

/// Prefix that the build script puts before the name of a configuration.
pub(crate) const CORE: &str = "core_";
/// The same for cores that can write waveforms. They are slower, also while they write none.
const TRACED: &str = "traced_core_";
/// The same for cores with runs.
const LIVING: &str = "living_core_";

/// A simulated core, started and reset.
///
/// Time passes only inside [`SimDevice::send`] and [`SimDevice::receive`]. The device takes answers from the
/// core as they come, also while it sends words, and keeps them until they are asked for; so no order of calls
/// can block the core.
#[derive(Debug)]
pub struct SimDevice {
    model: Model,
    ports: Ports,
    /// Answer words that have not been received yet, each with the number of the clock that ended when the word came.
    answers: VecDeque<(u32, u64)>,
    /// Clock of the word that was received last.
    answer_clock: Option<u64>,
    /// The command word that the core is currently offered.
    offered: Option<u32>,
    /// The command word that the last [`SimDevice::send`] left offered. The core may have taken it since.
    left: Option<u32>,
    clocks: u64,
    /// The waveform of one job that [`SimDevice::trace_job`] asked for.
    job_trace: Option<JobTrace>,
}

#[derive(Debug)]
struct JobTrace {
    path: PathBuf,
    watch: JobWatch,
    /// The reason why the waveform cannot be trusted, until the next call of the caller returns it.
    fault: Option<TraceError>,
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
    /// A simulated core of this configuration.
    ///
    /// # Errors
    /// The configuration is not one of [`incircle_protocol::NAMED`]: others were not translated when
    /// this crate was built.
    pub fn new(config: Config) -> Result<Self, SimError> {
        Self::of(description(CORE, config)?)
    }

    /// A simulated core of this configuration that can write waveforms. It is slower by up to a fifth, also while it
    /// writes none.
    ///
    /// # Errors
    /// As [`SimDevice::new`].
    pub fn traced(config: Config) -> Result<Self, SimError> {
        Self::of(description(TRACED, config)?)
    }

    /// A simulated core of this configuration with runs, for a mesh that lives.
    ///
    /// # Errors
    /// [`SimError::NoRuns`]: no core with runs of the configuration was translated when this crate was built.
    pub fn living(config: Config) -> Result<Self, SimError> {
        Self::of(living_description(config)?)
    }

    /// Whether there is a simulated core of this configuration with runs.
    pub fn has_living(config: Config) -> bool {
        find(LIVING, config).is_some()
    }

    /// A device around any model that has the two streams.
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
        Ok(Self {
            model,
            ports,
            answers: VecDeque::new(),
            answer_clock: None,
            offered: None,
            left: None,
            clocks,
            job_trace: None,
        })
    }

    /// Sends all `words` to the core, within `max_clocks` clocks.
    ///
    /// # Errors
    /// [`SimError::Timeout`]: the core took only the first `done` words. To resume, call again with the words from
    /// `done` on. The first of those stays offered until the core takes it, as the protocol demands, so the core may
    /// take it during [`SimDevice::receive`]; the call that resumes knows this and does not send it twice. If the next
    /// call begins with another word, its words follow the one that stayed offered.
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
    /// [`SimError::Timeout`]: the core has not given that many words. The words it gave are kept for the next call,
    /// and `words` is unchanged.
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

    /// Number of clocks since the device was made, reset included.
    pub fn clocks(&self) -> u64 {
        self.clocks
    }

    /// The clock, counted as [`SimDevice::clocks`] does, that ended when the last received word came;
    /// `None` before the first.
    pub fn answer_clock(&self) -> Option<u64> {
        self.answer_clock
    }

    /// Writes a VCD waveform of all signals from now on, which makes the simulation many times slower. Dropping the
    /// device completes the file.
    ///
    /// # Errors
    /// [`SimError::NotTraced`]: the device was not made by [`SimDevice::traced`]. [`SimError::Trace`]: the file cannot
    /// be created. If the disk fills later, `send` and `receive` return the error.
    pub fn trace_to(&mut self, path: impl AsRef<Path>) -> Result<(), SimError> {
        self.check_traced()?;
        Ok(self.model.trace_to(path)?)
    }

    /// Writes a VCD waveform of one job: from the clock in which the core takes the `Clear` with which the job begins,
    /// to the one in which it takes the next `Clear`. The job that begins next is number 1. The file is made when the
    /// job begins; if the device is dropped before, there is none.
    ///
    /// # Errors
    /// [`SimError::NotTraced`]: the device was not made by [`SimDevice::traced`]. [`SimError::NoJob`]: the number is 0.
    /// If the file cannot be written, `send` and `receive` return the error.
    pub fn trace_job(&mut self, path: impl AsRef<Path>, number: u64) -> Result<(), SimError> {
        self.check_traced()?;
        if number == 0 {
            return Err(SimError::NoJob);
        }
        // All cores have the same layout of points.
        let watch = JobWatch::new(number, Layout::of(CORE_COORD_BITS, 1));
        self.job_trace = Some(JobTrace { path: path.as_ref().to_owned(), watch, fault: None });
        Ok(())
    }

    fn check_traced(&self) -> Result<(), SimError> {
        let model = self.model.description();
        model.can_trace().then_some(()).ok_or(SimError::NotTraced { name: model.name() })
    }

    /// Begins and ends the waveform of the chosen job, when the core takes the offered word.
    fn watch_jobs(&mut self) {
        let (Some(trace), Some(word)) = (&mut self.job_trace, self.offered) else {
            return;
        };
        match trace.watch.take(word) {
            Moment::Begins => trace.fault = self.model.trace_to(&trace.path).err(),
            Moment::Ends => {
                // A waveform that could not begin stays an error.
                trace.fault = trace.fault.take().or(self.model.trace_flush().err());
                self.model.trace_close();
                self.job_trace = self.job_trace.take().filter(|trace| trace.fault.is_some());
            }
            Moment::Other => {}
        }
    }

    /// Flushes the waveform, if one is written, so that the file is complete up to this clock.
    fn keep_waveform(&mut self) -> Result<(), SimError> {
        if let Some(fault) = self.job_trace.as_mut().and_then(|trace| trace.fault.take()) {
            self.job_trace = None;
            return Err(fault.into());
        }
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

    /// Offers a word until the core takes it or the clock `end` is reached, and returns whether it was taken.
    /// The word stays offered.
    fn hand_over(&mut self, word: u32, end: u64) -> bool {
        self.offer(Some(word));
        while self.clocks < end {
            if self.clock() {
                return true;
            }
        }
        false
    }

    /// Simulates one clock and takes the answer that the core offers. Returns whether the core takes
    /// the offered command word.
    fn clock(&mut self) -> bool {
        let is_taken = self.offered.is_some() && self.model.get(self.ports.command_ready) != 0;
        if is_taken {
            self.watch_jobs();
        }
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

/// The translated core of a configuration, with the name that follows this prefix.
pub(crate) fn description(prefix: &str, config: Config) -> Result<&'static ModelDescription, SimError> {
    find(prefix, config).ok_or_else(|| SimError::NotBuilt {
        name: config.name,
        points: config.points,
        contexts: config.contexts,
        ring: config.ring,
        built: built(CORE).join(", "),
    })
}

/// The translated core of a configuration with runs.
pub(crate) fn living_description(config: Config) -> Result<&'static ModelDescription, SimError> {
    let missing = || SimError::NoRuns { name: config.name, built: built(LIVING).join(", ") };
    find(LIVING, config).ok_or_else(missing)
}

/// The translated core or board of a configuration, whose name follows this prefix, if there is one.
pub(crate) fn find(prefix: &str, config: Config) -> Option<&'static ModelDescription> {
    NAMED.contains(&config).then(|| models::find(&format!("{prefix}{}", config.name))).flatten()
}

/// Names of the configurations that were translated when this crate was built, of the cores or boards with this prefix.
pub(crate) fn built(prefix: &str) -> Vec<&'static str> {
    let names = models::NAMES.iter();
    names.filter_map(|name| name.strip_prefix(prefix)).collect()
}
