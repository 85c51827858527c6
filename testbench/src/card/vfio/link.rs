//! The connection between the driver and the card.

use std::os::fd::{AsRawFd, OwnedFd};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use vfio_user::{Client, Error};

use super::channel::Way;
use super::dma_memory::DmaMemory;
use super::numbers::CHANNELS;
use super::places::{read, write, Places};

/// The connection to a card. An access is a message and its answer, so accesses wait for one another.
pub struct Link {
    pub(super) client: Mutex<Client>,
    pub(super) places: Places,
    pub(super) events: [OwnedFd; CHANNELS],
    /// Addresses at which memory is mapped for the card.
    pub(super) mapped: Mutex<Vec<u64>>,
    pub(super) ranges: AtomicU32,
    pub(super) untold: AtomicU32,
}

impl Link {
    pub(super) fn lock(&self) -> MutexGuard<'_, Client> {
        self.client.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads a register of the bridge. A card that is gone reads as all ones.
    pub fn dma(&self, offset: u32) -> u32 {
        read(&mut self.lock(), self.places.dma, offset.into())
    }

    /// Writes a register of the bridge. A write to a card that is gone does nothing.
    pub fn set_dma(&self, offset: u32, value: u32) {
        write(&mut self.lock(), self.places.dma, offset.into(), value);
    }

    /// The event of a channel's message.
    pub fn event(&self, way: Way) -> &OwnedFd {
        &self.events[way as usize]
    }

    fn mapped(&self) -> MutexGuard<'_, Vec<u64>> {
        self.mapped.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns a multiple of 4 GiB that no other caller gets.
    pub fn new_range(&self) -> u64 {
        u64::from(self.ranges.fetch_add(1, Ordering::Relaxed) + 1) << 32
    }

    /// Maps memory for the card.
    ///
    /// # Errors
    /// The card is gone.
    pub fn map(&self, memory: &DmaMemory) -> Result<(), Error> {
        self.lock().dma_map(0, memory.address(), memory.size(), memory.file().as_raw_fd())?;
        self.mapped().push(memory.address());
        Ok(())
    }

    /// Unmaps memory, but only if it is mapped: the crate's client would wait without end for the rest of a refusal.
    ///
    /// # Errors
    /// The card is gone.
    pub fn unmap(&self, memory: &DmaMemory) -> Result<(), Error> {
        let place = self.mapped().iter().position(|&address| address == memory.address());
        let Some(place) = place else {
            return Ok(());
        };
        self.mapped().swap_remove(place);
        self.lock().dma_unmap(memory.address(), memory.size())
    }

    /// Counts the end of a run that no message reported.
    pub fn count_untold(&self) {
        self.untold.fetch_add(1, Ordering::Relaxed);
    }
}
