//! What stands behind the beats: a device that takes and gives words, as many at a time as there are.

use incircle_protocol::{Config, Identity, CORE_COORD_BITS};

use crate::serial::core_identity;
use crate::{CommandModel, ModelError};

/// A device of two streams of words, without a clock.
pub trait WordStream {
    /// Starts anew.
    fn reset(&mut self);

    /// Takes any piece of the command stream.
    fn send(&mut self, words: &[u32]);

    /// Hands out answer words that are ready, and says how many.
    fn receive(&mut self, words: &mut [u32]) -> usize;

    /// True if it has a part of a command, or the answer to one.
    fn is_busy(&self) -> bool;

    /// What it says of itself.
    fn identity(&self) -> Identity;
}

/// The model by commands.
#[derive(Debug)]
pub struct ModelCore {
    model: CommandModel,
    parameters: (u32, u32, u32),
    contexts: u32,
}

impl ModelCore {
    /// A device for `capacity` points of `coord_bits` bits.
    ///
    /// # Errors
    /// As [`CommandModel::new`].
    pub fn new(coord_bits: u32, capacity: u32, ring: u32) -> Result<Self, ModelError> {
        let model = CommandModel::new(coord_bits, capacity, ring)?;
        Ok(Self { model, parameters: (coord_bits, capacity, ring), contexts: 1 })
    }

    /// The same as if it had so many contexts; see [`CommandModel::with_contexts`].
    #[must_use]
    pub fn with_contexts(mut self, contexts: u32) -> Self {
        self.model = self.model.with_contexts(contexts);
        self.contexts = contexts.clamp(1, 255);
        self
    }

    /// A device with the parameters of a core, and one context.
    ///
    /// # Errors
    /// As [`CommandModel::new`].
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
        Identity { coord_bits, ..core_identity(Config { name: "", points, ring, contexts: self.contexts }) }
    }
}
