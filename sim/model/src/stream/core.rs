//! The device behind the beats of the stream link: it takes and gives words, as many at a time as there are.

use incircle_protocol::{Config, Identity, CORE_COORD_BITS};

use crate::serial::core_identity;
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

/// The model by commands as a word stream.
#[derive(Debug)]
pub struct ModelCore {
    model: CommandModel,
    parameters: (u32, u32, u32),
    contexts: u32,
}

impl ModelCore {
    /// A device for `capacity` points of `coord_bits` bits, with boundary lists of `ring` entries.
    ///
    /// # Errors
    /// The errors of [`CommandModel::new`].
    pub fn new(coord_bits: u32, capacity: u32, ring: u32) -> Result<Self, ModelError> {
        let model = CommandModel::new(coord_bits, capacity, ring)?;
        Ok(Self { model, parameters: (coord_bits, capacity, ring), contexts: 1 })
    }

    /// The same device with this many contexts; see [`CommandModel::with_contexts`].
    #[must_use]
    pub fn with_contexts(mut self, contexts: u32) -> Self {
        self.model = self.model.with_contexts(contexts);
        self.contexts = contexts.clamp(1, 255);
        self
    }

    /// A device with the parameters of a core, but with one context.
    ///
    /// # Errors
    /// The errors of [`CommandModel::new`].
    pub fn of(config: Config) -> Result<Self, ModelError> {
        Self::new(CORE_COORD_BITS, config.points, config.ring)
    }
}

impl WordStream for ModelCore {
    fn reset(&mut self) {
        let (coord_bits, capacity, ring) = self.parameters;
        if let Ok(fresh) = Self::new(coord_bits, capacity, ring) {
            *self = fresh.with_contexts(self.contexts);
        }
    }

    fn send(&mut self, words: &[u32]) {
        self.model.send(words);
    }

    fn receive(&mut self, words: &mut [u32]) -> usize {
        self.model.receive(words)
    }

    fn is_busy(&self) -> bool {
        self.model.is_busy()
    }

    fn identity(&self) -> Identity {
        let (coord_bits, points, ring) = self.parameters;
        Identity { coord_bits, ..core_identity(Config { name: "", points, ring, contexts: self.contexts, engines: 1 }) }
    }
}
