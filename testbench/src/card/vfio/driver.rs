//! A driver in user space for the card behind its socket: it finds the windows, switches DMA and messages on, and maps memory.

use std::io;
use std::os::fd::{AsRawFd, OwnedFd};
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use incircle::transports::parts::{CardFiles, RegisterFile};
use rustix::event::{eventfd, EventfdFlags};
use vfio_bindings::bindings::vfio::{
    VFIO_IRQ_SET_ACTION_MASK, VFIO_IRQ_SET_ACTION_TRIGGER, VFIO_IRQ_SET_ACTION_UNMASK, VFIO_IRQ_SET_DATA_EVENTFD,
    VFIO_IRQ_SET_DATA_NONE, VFIO_PCI_MSIX_IRQ_INDEX,
};
use vfio_user::{Client, Error};

use super::channel::Way;
use super::numbers::{CHANNELS, DEVICE, VENDOR};
use super::places::{find, read, read_config, start, write, write_config, Places};
use super::transfers::{Answers, Commands, DmaMemory, Transfers};

/// Why the driver does not start.
#[derive(Debug, thiserror::Error)]
pub enum DriverError {
    /// Nobody answers at the socket.
    #[error("the card does not answer: {0}: check that it is served")]
    Socket(#[from] Error),
    /// It is another device.
    #[error("this is device {vendor:04x}:{device:04x}, not {VENDOR:04x}:{DEVICE:04x}: choose another card")]
    Other {
        /// Who made it.
        vendor: u16,
        /// Which it is.
        device: u16,
    },
    /// The bridge is not there, or lacks something.
    #[error("the card has no {0}: check how its bridge was made")]
    Lacks(&'static str),
    /// The system refuses.
    #[error("memory or events cannot be had: {0}: check limits of the system")]
    System(#[from] io::Error),
}

/// The open card, for all that use it.
pub struct VfioDriver(Arc<Link>);

/// The connection. An access is a message and its answer, so one waits for the other.
pub struct Link {
    client: Mutex<Client>,
    places: Places,
    events: [OwnedFd; CHANNELS],
    /// Where memory is mapped that the card may reach.
    mapped: Mutex<Vec<u64>>,
    ranges: AtomicU32,
    untold: AtomicU32,
}

impl Link {
    fn lock(&self) -> MutexGuard<'_, Client> {
        self.client.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads a register of the bridge. A card that is gone reads as all ones.
    pub fn dma(&self, offset: u32) -> u32 {
        read(&mut self.lock(), self.places.dma, offset.into())
    }

    /// Writes it. To a card that is gone that does nothing.
    pub fn set_dma(&self, offset: u32, value: u32) {
        write(&mut self.lock(), self.places.dma, offset.into(), value);
    }

    /// The event of a channel.
    pub fn event(&self, way: Way) -> &OwnedFd {
        &self.events[way as usize]
    }

    fn mapped(&self) -> MutexGuard<'_, Vec<u64>> {
        self.mapped.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A multiple of 4 GiB that nobody else is given.
    pub fn new_range(&self) -> u64 {
        u64::from(self.ranges.fetch_add(1, Ordering::Relaxed) + 1) << 32
    }

    /// Lets the card reach memory.
    ///
    /// # Errors
    /// The card is gone.
    pub fn map(&self, memory: &DmaMemory) -> Result<(), Error> {
        self.lock().dma_map(0, memory.address(), memory.size(), memory.file().as_raw_fd())?;
        self.mapped().push(memory.address());
        Ok(())
    }

    /// Takes it back, if it can be reached: the crate's client would wait without end for the rest of a refusal.
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

    /// Counts the end of a run that no message told.
    pub fn count_untold(&self) {
        self.untold.fetch_add(1, Ordering::Relaxed);
    }
}

impl VfioDriver {
    /// Opens the card at a socket.
    ///
    /// # Errors
    /// [`DriverError`].
    pub fn open(path: &Path) -> Result<Self, DriverError> {
        let mut client = Client::new(path)?;
        let places = find(&mut client)?;
        let event = || eventfd(0, EventfdFlags::CLOEXEC | EventfdFlags::NONBLOCK).map_err(io::Error::from);
        let events = [event()?, event()?];
        let flags = VFIO_IRQ_SET_DATA_EVENTFD | VFIO_IRQ_SET_ACTION_TRIGGER;
        let numbers = [events[0].as_raw_fd(), events[1].as_raw_fd()];
        client.set_irqs(VFIO_PCI_MSIX_IRQ_INDEX, flags, 0, CHANNELS as u32, &numbers)?;
        start(&mut client, places);
        Ok(Self(Arc::new(Link {
            client: Mutex::new(client),
            places,
            events,
            mapped: Mutex::default(),
            ranges: AtomicU32::new(0),
            untold: AtomicU32::new(0),
        })))
    }

    /// The connection.
    pub fn link(&self) -> &Arc<Link> {
        &self.0
    }

    /// The three files of the card, for the library's driver. A transfer that takes longer than `timeout` fails as one of the driver XDMA.
    ///
    /// # Errors
    /// [`DriverError`]: memory cannot be had.
    pub fn files(&self, timeout: Duration) -> Result<CardFiles, DriverError> {
        Ok(CardFiles {
            commands: Box::new(Commands(Transfers::new(&self.0, Way::ToCard, timeout)?)),
            answers: Box::new(Answers(Transfers::new(&self.0, Way::ToHost, timeout)?)),
            registers: Box::new(Registers(Arc::clone(&self.0))),
        })
    }

    /// Ends of runs so far that were seen in the status and that no message told: interrupts that were lost.
    pub fn untold(&self) -> u32 {
        self.0.untold.load(Ordering::Relaxed)
    }

    /// Reads a register of the card.
    pub fn user(&self, offset: u32) -> u32 {
        read(&mut self.0.lock(), self.0.places.user, offset.into())
    }

    /// Writes a register of the card.
    pub fn set_user(&self, offset: u32, value: u32) {
        write(&mut self.0.lock(), self.0.places.user, offset.into(), value);
    }

    /// Reads four bytes of configuration space.
    pub fn config(&self, offset: u64) -> u32 {
        read_config(&mut self.0.lock(), offset)
    }

    /// Writes them.
    pub fn set_config(&self, offset: u64, value: u32) {
        write_config(&mut self.0.lock(), offset, value);
    }

    /// Masks all messages at the device's end of the socket, or ends that.
    ///
    /// # Errors
    /// The card is gone.
    pub fn mask(&self, is_masked: bool) -> Result<(), Error> {
        let action = if is_masked { VFIO_IRQ_SET_ACTION_MASK } else { VFIO_IRQ_SET_ACTION_UNMASK };
        self.0.lock().set_irqs(VFIO_PCI_MSIX_IRQ_INDEX, action | VFIO_IRQ_SET_DATA_NONE, 0, CHANNELS as u32, &[])
    }

    /// Resets the device, and switches on again what that switches off. Nobody sees it in between.
    ///
    /// # Errors
    /// The card is gone.
    pub fn reset(&self) -> Result<(), Error> {
        let mut client = self.0.lock();
        client.reset()?;
        start(&mut client, self.0.places);
        Ok(())
    }
}

/// The card's registers as a file.
struct Registers(Arc<Link>);

impl RegisterFile for Registers {
    fn read(&mut self, offset: u32) -> io::Result<u32> {
        Ok(read(&mut self.0.lock(), self.0.places.user, offset.into()))
    }

    fn write(&mut self, offset: u32, value: u32) -> io::Result<()> {
        write(&mut self.0.lock(), self.0.places.user, offset.into(), value);
        Ok(())
    }
}
