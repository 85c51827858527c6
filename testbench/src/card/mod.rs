//! Simulated PCIe cards for the driver: in memory, behind the files of a directory, and as a vfio-user device.
//! [`driver_cost`] measures what the driver costs in front of them.

mod driver;
pub mod vfio;

pub use driver::{driver_cost, DriverCost, DriverCostError, Jobs, Way};

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::Arc;

use incircle::transports::parts::{CardFiles, RegisterFile};
use incircle_sim::pcie::{Beats, Card, CardDirectory, CardFaultSpec, DirectoryError, Errno};

/// Numbers the directories, so that no two cards share one.
static MOUNTED: AtomicU32 = AtomicU32::new(0);

/// A card in memory, called as its driver's files would be.
#[derive(Clone)]
pub struct MemoryCard(Arc<Card>);

fn failed(errno: Errno) -> io::Error {
    io::Error::from_raw_os_error(errno.0)
}

impl MemoryCard {
    /// Makes a card around this device.
    pub fn new(device: Box<dyn Beats>, faults: &CardFaultSpec) -> Self {
        Self(Arc::new(Card::new(device, faults)))
    }

    /// The card's three files.
    pub fn files(&self) -> CardFiles {
        CardFiles {
            commands: Box::new(self.clone()),
            answers: Box::new(self.clone()),
            registers: Box::new(self.clone()),
        }
    }
}

impl Write for MemoryCard {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes).map_err(failed)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Read for MemoryCard {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.0.read(bytes).map_err(failed)
    }
}

impl RegisterFile for MemoryCard {
    fn read(&mut self, offset: u32) -> io::Result<u32> {
        self.0.read_register(offset).map_err(failed)
    }

    fn write(&mut self, offset: u32, value: u32) -> io::Result<()> {
        self.0.write_register(offset, value).map_err(failed)
    }
}

/// A card in a directory of its own. Dropping the card removes the directory.
pub struct MountedCard {
    /// Dropped before the path is removed.
    directory: Option<CardDirectory>,
    path: PathBuf,
}

impl MountedCard {
    /// Mounts a card around this device.
    ///
    /// # Errors
    /// The system has no FUSE.
    pub fn new(device: Box<dyn Beats>, faults: &CardFaultSpec) -> Result<Self, DirectoryError> {
        let number = MOUNTED.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("incircle-card-{}-{number}", std::process::id()));
        let directory = CardDirectory::mount(&path, Arc::new(Card::new(device, faults)))?;
        Ok(Self { directory: Some(directory), path })
    }

    /// The directory of the card.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The card's address for the library.
    pub fn address(&self) -> String {
        format!("pcie:{}", self.path.display())
    }
}

impl Drop for MountedCard {
    fn drop(&mut self) {
        drop(self.directory.take());
        // The directory should be empty. If somebody put a file there, the test must not remove that file.
        let _ = std::fs::remove_dir(&self.path);
    }
}
