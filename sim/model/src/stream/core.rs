//! The device behind the beats of the stream link: it takes and gives words, as many at a time as there are.

use incircle_protocol::{command_opcode, Config, Identity, Opcode, CORE_COORD_BITS, PADDING};

use crate::link::core_identity;
use crate::{CommandModel, ModelError};

/// A device with a stream of command words and a stream of answer words, without a clock.
pub trait WordStream {
    /// Resets the device, which forgets everything.
    fn reset(&mut self);

    /// Takes a piece of the command stream, of any length.
    fn send(&mut self, words: &[u32]);

    /// Hands out answer words that are ready, and returns their number.
    fn receive(&mut self, words: &mut [u32]) -> usize;

    /// Whether the device holds a part of a command, or an answer to one.
    fn is_busy(&self) -> bool;

    /// The identity of the device.
    fn identity(&self) -> Identity;
}

/// Models by commands as a word stream: one for each engine of the device.
///
/// Jobs go to the engines in turn, as on a chip, without a look at whether an engine still owes answers. Answers come
/// in the order of their commands if the caller takes all of them before it sends the next job, as
/// [`StreamModel`](super::StreamModel) does.
#[derive(Debug)]
pub struct ModelCore {
    engines: Vec<CommandModel>,
    /// The engine of the present job.
    current: usize,
    /// The engine whose answers are handed out.
    giving: usize,
    coord_bits: u32,
    config: Config,
}

impl ModelCore {
    /// A device of one engine and one context for `capacity` points of `coord_bits` bits, with boundary lists of `ring`
    /// entries.
    ///
    /// # Errors
    /// The errors of [`CommandModel::new`].
    pub fn new(coord_bits: u32, capacity: u32, ring: u32) -> Result<Self, ModelError> {
        Self::with_sizes(coord_bits, Config { name: "", points: capacity, ring, contexts: 1, engines: 1 })
    }

    /// The same device with this many contexts in each engine; see [`CommandModel::with_contexts`].
    #[must_use]
    pub fn with_contexts(self, contexts: u32) -> Self {
        let engines = self.engines.into_iter().map(|engine| engine.with_contexts(contexts)).collect();
        Self { engines, config: Config { contexts: contexts.clamp(1, 255), ..self.config }, ..self }
    }

    /// A device with the parameters of a core, but with one context in each engine.
    ///
    /// # Errors
    /// The errors of [`CommandModel::new`].
    pub fn of(config: Config) -> Result<Self, ModelError> {
        Self::with_sizes(CORE_COORD_BITS, Config { name: "", contexts: 1, ..config })
    }

    fn with_sizes(coord_bits: u32, config: Config) -> Result<Self, ModelError> {
        let config = Config { engines: config.engines.clamp(1, 255), ..config };
        let engine = |number| {
            let model = CommandModel::new(coord_bits, config.points, config.ring)?.with_contexts(config.contexts);
            Ok(model.as_engine(number, config.engines))
        };
        let engines = (0..config.engines as u8).map(engine).collect::<Result<_, _>>()?;
        Ok(Self { engines, current: 0, giving: 0, coord_bits, config })
    }
}

impl WordStream for ModelCore {
    fn reset(&mut self) {
        if let Ok(fresh) = Self::with_sizes(self.coord_bits, self.config) {
            *self = fresh;
        }
    }

    fn send(&mut self, words: &[u32]) {
        for &word in words {
            let begins = self.engines[self.current].is_between_commands();
            if begins && word != PADDING && command_opcode(word) == Opcode::Clear as u8 {
                self.current = (self.current + 1) % self.engines.len();
            }
            self.engines[self.current].send(&[word]);
        }
    }

    fn receive(&mut self, words: &mut [u32]) -> usize {
        let mut filled = 0;
        // An engine hands out all its answers before the next one does, so that each answer is whole.
        for _ in 0..self.engines.len() {
            filled += self.engines[self.giving].receive(&mut words[filled..]);
            if filled == words.len() {
                break;
            }
            self.giving = (self.giving + 1) % self.engines.len();
        }
        filled
    }

    fn is_busy(&self) -> bool {
        self.engines.iter().any(CommandModel::is_busy)
    }

    fn identity(&self) -> Identity {
        Identity { coord_bits: self.coord_bits, ..core_identity(self.config) }
    }
}
