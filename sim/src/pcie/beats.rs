//! A stream device as a bus sees it.

use incircle_model::stream::{BusError, Given, StreamModel, WordStream};

/// A device that takes command beats, gives answer beats, and has registers. Nothing blocks.
pub trait Beats: Send {
    /// Takes as many of the beats as it has room for now, and says how many bytes that was.
    fn take(&mut self, bytes: &[u8]) -> usize;

    /// Gives the beats that it has now, at most what has room, and nothing beyond the end of an answer.
    fn give(&mut self, bytes: &mut [u8]) -> Given;

    /// Reads a register.
    ///
    /// # Errors
    /// There is none at this offset.
    fn read(&mut self, offset: u32) -> Result<u32, BusError>;

    /// Writes a register.
    ///
    /// # Errors
    /// There is none at this offset, or it can only be read.
    fn write(&mut self, offset: u32, value: u32) -> Result<(), BusError>;

    /// Bytes of a beat.
    fn beat_bytes(&self) -> usize;

    /// A slice of its time passes. False if that changes nothing until somebody takes, gives or writes.
    fn run(&mut self) -> bool {
        false
    }
}

impl<C: WordStream + Send> Beats for StreamModel<C> {
    fn take(&mut self, bytes: &[u8]) -> usize {
        StreamModel::take(self, bytes)
    }

    fn give(&mut self, bytes: &mut [u8]) -> Given {
        StreamModel::give(self, bytes)
    }

    fn read(&mut self, offset: u32) -> Result<u32, BusError> {
        StreamModel::read(self, offset)
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), BusError> {
        StreamModel::write(self, offset, value)
    }

    fn beat_bytes(&self) -> usize {
        StreamModel::beat_bytes(self)
    }
}
