//! Memory of the host that the card reaches by DMA.

use std::fs::File;
use std::io;

use vm_memory::{FileOffset, MmapRegion, VolatileMemory};

use super::shared_memory;

/// A piece of shared memory that can be mapped for the card.
#[derive(Debug)]
pub struct DmaMemory {
    address: u64,
    file: File,
    memory: MmapRegion,
}

impl DmaMemory {
    /// Allocates `bytes` bytes of zeros, which the card is to find at `address`.
    ///
    /// # Errors
    /// The system has no memory left.
    pub fn new(address: u64, bytes: usize) -> io::Result<Self> {
        let file = shared_memory(bytes as u64)?;
        let memory = MmapRegion::from_file(FileOffset::new(file.try_clone()?, 0), bytes).map_err(io::Error::other)?;
        Ok(Self { address, file, memory })
    }

    /// The address at which the card finds the memory.
    pub fn address(&self) -> u64 {
        self.address
    }

    /// The number of bytes.
    pub fn size(&self) -> u64 {
        self.memory.size() as u64
    }

    /// The file behind the memory.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// Writes from an offset on.
    ///
    /// # Errors
    /// The bytes would reach behind the end.
    pub fn write(&self, place: usize, bytes: &[u8]) -> io::Result<()> {
        self.memory.get_slice(place, bytes.len()).map_err(io::Error::other)?.copy_from(bytes);
        Ok(())
    }

    /// Reads from an offset on.
    ///
    /// # Errors
    /// The bytes would reach behind the end.
    pub fn read(&self, place: usize, bytes: &mut [u8]) -> io::Result<()> {
        self.memory.get_slice(place, bytes.len()).map_err(io::Error::other)?.copy_to(bytes);
        Ok(())
    }
}
