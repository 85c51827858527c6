//! The software model as a transport: it takes commands like any other device.

use std::time::Instant;

use incircle_model::CommandModel;
use incircle_protocol::Command;

use super::transport::{receive_in_pieces, AnswerHead, Capabilities, Transport};
use crate::error::{Error, TransportError};

/// Boundary edges of a cavity for which the model has room, as many as the standard cores.
pub(crate) const RING_CAPACITY: u32 = 32;
/// Name of the back end in reports.
pub(crate) const MODEL_NAME: &str = "model";

/// The software model as a transport. The model answers at once, so deadlines play no part.
///
/// [`Device::model`](crate::Device::model) makes a device of it.
pub struct ModelTransport {
    model: CommandModel,
}

impl ModelTransport {
    /// Makes a model for `capacity` points of `coord_bits` bits, which takes about 60 bytes per point.
    ///
    /// # Errors
    /// [`Error::Model`] if the model refuses these parameters.
    pub fn new(coord_bits: u32, capacity: u32) -> Result<Self, Error> {
        let model = CommandModel::new(coord_bits, capacity, RING_CAPACITY)
            .map_err(|refusal| Error::Model(refusal.to_string()))?;
        Ok(Self { model: model.with_runs() })
    }
}

impl ModelTransport {
    /// Fills the whole of `words` with the next words of the model.
    fn fill(&mut self, words: &mut [u32]) -> Result<(), TransportError> {
        let wanted = words.len();
        let mut done = 0;
        while let Some(rest) = words.get_mut(done..).filter(|rest| !rest.is_empty()) {
            match self.model.receive(rest) {
                0 => return Err(TransportError::Closed { done, wanted }),
                more => done += more,
            }
        }
        Ok(())
    }
}

impl Transport for ModelTransport {
    fn name(&self) -> String {
        MODEL_NAME.to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], _deadline: Instant) -> Result<(), TransportError> {
        for command in commands {
            let (head, count) = command.head();
            self.model.send(&head[..count]);
            self.model.send(command.points());
        }
        Ok(())
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        _deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        receive_in_pieces(head, payload, |words| self.fill(words))
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities { takes_ahead: true, ..Capabilities::default() }
    }
}
