//! The device behind a link: it takes and gives words, one clock at a time.

use incircle_protocol::{
    Config, Identity, CORE_COORD_BITS, CORE_RUNS, CORE_VERSION, FEATURE_SHORT_IDS, MAGIC, PROTOCOL_VERSION,
};

use crate::{ChipModel, ClockModel, CommandModel, Inputs, Outputs};

/// A device with a stream of command words and a stream of answer words, driven clock by clock.
pub trait WordDevice {
    /// Resets the device, which forgets everything.
    fn reset(&mut self);

    /// Simulates one clock. The device is offered a command word, or none, and may give answer words if `takes_answer`.
    /// On both sides, an offered word that was not taken stays offered in the next clock.
    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed;

    /// Whether an engine of several is at work although an answer has just ended. On a device of one engine the words
    /// alone tell whether it is at work.
    fn owes_answers(&self) -> bool {
        false
    }
}

/// The words that passed in a clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Passed {
    /// Whether the command word was taken.
    pub is_taken: bool,
    /// The answer words that were given: none, one, or two in their order.
    pub answer: [Option<u32>; 2],
}

/// The model by commands, as a device that takes one word in each clock and needs no time for insertions.
#[derive(Debug)]
pub struct Instantly {
    model: CommandModel,
    parameters: (u32, u32, u32),
    has_runs: bool,
    answer: Option<u32>,
}

impl Instantly {
    /// A device for `capacity` points of `coord_bits` bits, with boundary lists of `ring` entries.
    ///
    /// # Errors
    /// The errors of [`CommandModel::new`].
    pub fn new(coord_bits: u32, capacity: u32, ring: u32) -> Result<Self, crate::ModelError> {
        let model = CommandModel::new(coord_bits, capacity, ring)?;
        Ok(Self { model, parameters: (coord_bits, capacity, ring), has_runs: false, answer: None })
    }

    /// The same device with the runs that a core with runs has.
    #[must_use]
    pub fn with_runs(self) -> Self {
        Self { model: self.model.with_core_runs(), has_runs: true, ..self }
    }

    /// A device with the parameters of a core.
    ///
    /// # Errors
    /// The errors of [`CommandModel::new`].
    pub fn of(config: Config) -> Result<Self, crate::ModelError> {
        Self::new(CORE_COORD_BITS, config.points, config.ring)
    }

    /// The identity of the device.
    pub fn identity(&self) -> Identity {
        let (coord_bits, points, ring) = self.parameters;
        let core = core_identity(Config { name: "", points, ring, contexts: 1, engines: 1 });
        let runs = if self.has_runs { CORE_RUNS } else { 0 };
        Identity { coord_bits, features: core.features | runs, ..core }
    }

    /// The answer word that is offered now.
    fn offered(&mut self) -> Option<u32> {
        if self.answer.is_none() {
            let mut word = [0];
            self.answer = (self.model.receive(&mut word) == 1).then_some(word[0]);
        }
        self.answer
    }
}

impl WordDevice for Instantly {
    fn reset(&mut self) {
        let (coord_bits, capacity, ring) = self.parameters;
        if let Ok(fresh) = Self::new(coord_bits, capacity, ring) {
            *self = if self.has_runs { fresh.with_runs() } else { fresh };
        }
    }

    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed {
        match (self.offered(), command) {
            (Some(_), _) => {
                let answer = if takes_answer { self.answer.take() } else { None };
                Passed { is_taken: false, answer: [answer, None] }
            }
            // As the core does, the model takes no word while an answer is in progress.
            (None, Some(word)) => {
                self.model.send(&[word]);
                Passed { is_taken: true, ..Passed::default() }
            }
            (None, None) => Passed::default(),
        }
    }
}

/// Simulates one clock of a model by clock in which a command word, or none, is offered.
fn clocked(outputs: Outputs, command: Option<u32>, takes_answer: bool, clock: impl FnOnce(Inputs)) -> Passed {
    clock(Inputs {
        reset: false,
        command_valid: command.is_some(),
        command_data: command.unwrap_or(0),
        response_ready: takes_answer,
    });
    let mut words = outputs.answer_words();
    let mut word = || words.next().filter(|_| takes_answer);
    Passed { is_taken: command.is_some() && outputs.command_ready, answer: [word(), word()] }
}

impl WordDevice for ClockModel {
    fn reset(&mut self) {
        self.clock(Inputs { reset: true, ..Inputs::default() });
    }

    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed {
        clocked(self.outputs(), command, takes_answer, |inputs| self.clock(inputs))
    }
}

impl WordDevice for ChipModel {
    fn reset(&mut self) {
        self.clock(Inputs { reset: true, ..Inputs::default() });
    }

    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed {
        clocked(self.outputs(), command, takes_answer, |inputs| self.clock(inputs))
    }

    fn owes_answers(&self) -> bool {
        self.is_at_work()
    }
}

/// The identity of a core of this configuration.
pub fn core_identity(config: Config) -> Identity {
    Identity {
        magic: MAGIC,
        protocol_version: PROTOCOL_VERSION,
        core_version: CORE_VERSION,
        coord_bits: CORE_COORD_BITS,
        capacity: config.points,
        contexts: config.contexts,
        engines: config.engines,
        ring_capacity: config.ring,
        features: FEATURE_SHORT_IDS,
    }
}
