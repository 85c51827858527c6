//! A driver in user space for the card behind its socket. Opening the card finds the windows
//! and switches DMA and messages on.

use std::io;
use std::os::fd::AsRawFd;
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use incircle::transports::parts::{CardFiles, RegisterFile};
use rustix::event::{eventfd, EventfdFlags};
use vfio_bindings::bindings::vfio::{
    VFIO_IRQ_SET_ACTION_MASK, VFIO_IRQ_SET_ACTION_TRIGGER, VFIO_IRQ_SET_ACTION_UNMASK, VFIO_IRQ_SET_DATA_EVENTFD,
    VFIO_IRQ_SET_DATA_NONE, VFIO_PCI_MSIX_IRQ_INDEX,
};
use vfio_user::{Client, Error};

use super::channel::Way;
use super::error::DriverError;
use super::link::Link;
use super::numbers::CHANNELS;
use super::places::{find, read, read_config, start, write, write_config};
use super::transfers::{Answers, Commands, Transfers};

/// The open card, shared by all its users.
pub struct VfioDriver(Arc<Link>);

impl VfioDriver {
    /// Opens the card at a socket.
    ///
    /// # Errors
    /// [`DriverError`] says why the card cannot be used.
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

    /// The connection to the card.
    pub fn link(&self) -> &Arc<Link> {
        &self.0
    }

    /// The three files of the card for the library's driver. A transfer that takes longer than `timeout` fails with the
    /// error that the driver XDMA would report.
    ///
    /// # Errors
    /// [`DriverError`]: the memory for the transfers cannot be had.
    pub fn files(&self, timeout: Duration) -> Result<CardFiles, DriverError> {
        Ok(CardFiles {
            commands: Box::new(Commands(Transfers::new(&self.0, Way::ToCard, timeout)?)),
            answers: Box::new(Answers(Transfers::new(&self.0, Way::ToHost, timeout)?)),
            registers: Box::new(Registers(Arc::clone(&self.0))),
        })
    }

    /// Number of lost interrupts: runs so far whose end showed in the status without a message.
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

    /// Reads four bytes of the configuration space.
    pub fn config(&self, offset: u64) -> u32 {
        read_config(&mut self.0.lock(), offset)
    }

    /// Writes four bytes of the configuration space.
    pub fn set_config(&self, offset: u64, value: u32) {
        write_config(&mut self.0.lock(), offset, value);
    }

    /// Masks all messages at the device's end of the socket, or removes that mask.
    ///
    /// # Errors
    /// The card is gone.
    pub fn mask(&self, is_masked: bool) -> Result<(), Error> {
        let action = if is_masked { VFIO_IRQ_SET_ACTION_MASK } else { VFIO_IRQ_SET_ACTION_UNMASK };
        self.0.lock().set_irqs(VFIO_PCI_MSIX_IRQ_INDEX, action | VFIO_IRQ_SET_DATA_NONE, 0, CHANNELS as u32, &[])
    }

    /// Resets the device and switches on again what a reset switches off. No other call comes in between.
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
