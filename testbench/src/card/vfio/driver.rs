//! A driver in user space for the card behind its socket: it finds the windows, switches DMA and messages on, and maps memory.

use std::io;
use std::os::fd::{AsRawFd, OwnedFd};
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use incircle::pcie::{CardFiles, RegisterFile};
use rustix::event::{eventfd, EventfdFlags};
use vfio_bindings::bindings::vfio::{
    VFIO_IRQ_SET_ACTION_MASK, VFIO_IRQ_SET_ACTION_TRIGGER, VFIO_IRQ_SET_ACTION_UNMASK, VFIO_IRQ_SET_DATA_EVENTFD,
    VFIO_IRQ_SET_DATA_NONE, VFIO_PCI_BAR5_REGION_INDEX, VFIO_PCI_CONFIG_REGION_INDEX, VFIO_PCI_MSIX_IRQ_INDEX,
};
use vfio_user::{Client, Error};

use super::channel::Way;
use super::numbers::{
    block, channel, config, interrupts, status, ALL_ONES, CHANNELS, DEVICE, ENTRY_BYTES, ENTRY_CONTROL, VENDOR,
};
use super::transfers::{Answers, Commands, DmaMemory, Transfers};

/// Upper bits of what two of the bridge's blocks say they are, by which XDMA finds its window.
const BLOCKS: [(u32, u32); 2] = [(block::INTERRUPTS, 0x1fc2), (block::CHOICES, 0x1fc3)];
/// Most capabilities that fit.
const MOST_CAPABILITIES: usize = 48;

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

/// Where things are.
#[derive(Clone, Copy, Debug)]
struct Places {
    user: u32,
    dma: u32,
    /// The capability of messages, in configuration space.
    messages: u64,
    /// Their table: window and offset.
    table: (u32, u64),
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

fn read(client: &mut Client, region: u32, offset: u64) -> u32 {
    let mut bytes = [0; 4];
    client.region_read(region, offset, &mut bytes).map_or(ALL_ONES, |()| u32::from_le_bytes(bytes))
}

fn write(client: &mut Client, region: u32, offset: u64, value: u32) {
    // As on a bus: what cannot be written is lost, and what is read next tells.
    let _ = client.region_write(region, offset, &value.to_le_bytes());
}

fn read_config(client: &mut Client, offset: u64) -> u32 {
    read(client, VFIO_PCI_CONFIG_REGION_INDEX, offset)
}

fn write_config(client: &mut Client, offset: u64, value: u32) {
    write(client, VFIO_PCI_CONFIG_REGION_INDEX, offset, value);
}

/// What the card's configuration space says of it.
fn find(client: &mut Client) -> Result<Places, DriverError> {
    let who = read_config(client, 0);
    let (vendor, device) = (who as u16, (who >> 16) as u16);
    if (vendor, device) != (VENDOR, DEVICE) {
        return Err(DriverError::Other { vendor, device });
    }
    // The windows answer from now on.
    write_config(client, config::COMMAND as u64, config::COMMAND_MEMORY.into());
    let bars: Vec<(u32, u64)> = (0..=VFIO_PCI_BAR5_REGION_INDEX).map(|bar| (bar, bar_size(client, bar))).collect();
    let has_bridge = |client: &mut Client, bar, size| {
        size > u64::from(block::PENDING) && BLOCKS.iter().all(|&(at, who)| read(client, bar, at.into()) >> 16 == who)
    };
    let dma = bars.iter().find(|&&(bar, size)| has_bridge(client, bar, size));
    let &(dma, _) = dma.ok_or(DriverError::Lacks("window with the registers of AMD's bridge"))?;
    let user = bars.iter().find(|&&(bar, size)| bar != dma && size > 0);
    let &(user, _) = user.ok_or(DriverError::Lacks("window with registers of its own"))?;
    let messages = capability(client).ok_or(DriverError::Lacks("message-signalled interrupts"))?;
    let table = read_config(client, messages + 4);
    Ok(Places { user, dma, messages, table: (table & 7, u64::from(table & !7)) })
}

/// Bytes of a window: of an address that is written as all ones, the bits stay that are above its size.
fn bar_size(client: &mut Client, bar: u32) -> u64 {
    let at = (config::BARS + 4 * bar as usize) as u64;
    let address = read_config(client, at);
    write_config(client, at, ALL_ONES);
    let bits = read_config(client, at) & !0xf;
    write_config(client, at, address);
    u64::from(bits.wrapping_neg())
}

/// Where the capability of messages is.
fn capability(client: &mut Client) -> Option<u64> {
    let mut at = u64::from(read_config(client, config::CAPABILITIES as u64) & 0xfc);
    for _ in 0..MOST_CAPABILITIES {
        if at == 0 {
            return None;
        }
        let head = read_config(client, at);
        if head as u8 == config::MESSAGES {
            return Some(at);
        }
        at = u64::from(head >> 8 & 0xfc);
    }
    None
}

/// Switches on what a reset switches off: windows, DMA, messages, and what each channel tells.
fn start(client: &mut Client, places: Places) {
    let switches = u32::from(config::COMMAND_MEMORY | config::COMMAND_MASTER);
    write_config(client, config::COMMAND as u64, switches);
    write_config(client, places.messages, u32::from(config::MESSAGES_ENABLED) << 16);
    let (table_bar, table) = places.table;
    for (vector, way) in (0..).zip(0..CHANNELS) {
        write(client, table_bar, table + u64::from(vector * ENTRY_BYTES + ENTRY_CONTROL), 0);
        write(client, places.dma, (block::CHANNEL[way] + channel::CONTROL).into(), status::ALL);
        let asks = status::STOPPED | status::COMPLETED | status::ERRORS;
        write(client, places.dma, (block::CHANNEL[way] + channel::MASK).into(), asks);
    }
    // Message 0 for the channel to the card, message 1 for the one to the host.
    write(client, places.dma, (block::INTERRUPTS + interrupts::CHANNEL_VECTORS).into(), 0x0100);
    write(client, places.dma, (block::INTERRUPTS + interrupts::CHANNEL_MASK_SET).into(), 3);
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
