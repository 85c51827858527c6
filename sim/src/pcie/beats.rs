//! A stream device as a bus sees it: the seam between the files of a card and the device behind them, which is the
//! Verilated card, the software model or a device that does nothing.

use incircle_model::stream::{BusError, Given, StreamModel, WordStream};

/// A device that takes command beats, gives answer beats, and has registers. No call blocks.
pub trait Beats: Send {
    /// Takes as many of the beats as the device has room for now, and returns how many bytes that was.
    fn take(&mut self, bytes: &[u8]) -> usize;

    /// Gives the beats that are ready now, at most as many as fit into `bytes`, and none beyond the end of an answer.
    fn give(&mut self, bytes: &mut [u8]) -> Given;

    /// Reads the register at this byte offset.
    ///
    /// # Errors
    /// There is no register at this offset.
    fn read(&mut self, offset: u32) -> Result<u32, BusError>;

    /// Writes the register at this byte offset.
    ///
    /// # Errors
    /// There is no register at this offset, or it is read-only.
    fn write(&mut self, offset: u32, value: u32) -> Result<(), BusError>;

    /// Number of bytes of a beat.
    fn beat_bytes(&self) -> usize;

    /// Lets a slice of the device's time pass. Returns false if that changes nothing until a beat is taken or given, or
    /// a register is written.
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
