//! Simulated PCIe cards for the driver: in memory, behind the files of a directory, and as a device of vfio-user; and what the driver costs before them.

mod driver;
pub mod vfio;

pub use driver::{driver_cost, DriverCost, DriverCostError, Jobs, Way};

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::Arc;

use incircle::transports::parts::{CardFiles, RegisterFile};
use incircle_sim::pcie::{Beats, Card, CardDirectory, CardFaultSpec, DirectoryError, Errno};

/// Names of directories, so that no two are one.
static MOUNTED: AtomicU32 = AtomicU32::new(0);

/// A card in memory, called as the files of its driver would be.
#[derive(Clone)]
pub struct MemoryCard(Arc<Card>);

fn failed(errno: Errno) -> io::Error {
    io::Error::from_raw_os_error(errno.0)
}

impl MemoryCard {
    /// A card around this device.
    pub fn new(device: Box<dyn Beats>, faults: &CardFaultSpec) -> Self {
        Self(Arc::new(Card::new(device, faults)))
    }

    /// Its files.
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

/// A card in a directory of its own, which goes with it.
pub struct MountedCard {
    /// Dropped before its path is removed.
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

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its address for the library.
    pub fn address(&self) -> String {
        format!("pcie:{}", self.path.display())
    }
}

impl Drop for MountedCard {
    fn drop(&mut self) {
        drop(self.directory.take());
        // It is empty; should it not be, it is not ours to remove.
        let _ = std::fs::remove_dir(&self.path);
    }
}
