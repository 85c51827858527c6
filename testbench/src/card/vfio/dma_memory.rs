//! Memory that the card reaches by DMA.

use std::fs::File;
use std::io;

use vm_memory::{FileOffset, MmapRegion, VolatileMemory};

use super::shared_memory;

/// Memory that the card may be let reach.
#[derive(Debug)]
pub struct DmaMemory {
    address: u64,
    file: File,
    memory: MmapRegion,
}

impl DmaMemory {
    /// So many bytes, of zeros, which the card is to find at this address.
    ///
    /// # Errors
    /// The system has none.
    pub fn new(address: u64, bytes: usize) -> io::Result<Self> {
        let file = shared_memory(bytes as u64)?;
        let memory = MmapRegion::from_file(FileOffset::new(file.try_clone()?, 0), bytes).map_err(io::Error::other)?;
        Ok(Self { address, file, memory })
    }

    /// Where the card finds it.
    pub fn address(&self) -> u64 {
        self.address
    }

    /// Its bytes.
    pub fn size(&self) -> u64 {
        self.memory.size() as u64
    }

    /// What it is a mapping of.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// Writes from a place on.
    ///
    /// # Errors
    /// Some of it lies behind the end.
    pub fn write(&self, place: usize, bytes: &[u8]) -> io::Result<()> {
        self.memory.get_slice(place, bytes.len()).map_err(io::Error::other)?.copy_from(bytes);
        Ok(())
    }

    /// Reads from a place on.
    ///
    /// # Errors
    /// Some of it lies behind the end.
    pub fn read(&self, place: usize, bytes: &mut [u8]) -> io::Result<()> {
        self.memory.get_slice(place, bytes.len()).map_err(io::Error::other)?.copy_to(bytes);
        Ok(())
    }
}
