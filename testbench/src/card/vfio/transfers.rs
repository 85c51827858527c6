//! Transfers through a channel: their memory, descriptors, a run, and the wait for its message.

use std::io::{self, Read, Write};
use std::os::fd::OwnedFd;
use std::sync::Arc;
use std::time::{Duration, Instant};

use rustix::event::{poll, PollFd, PollFlags, Timespec};

use super::channel::Way;
use super::descriptor::{Descriptor, Written};
use super::dma_memory::DmaMemory;
use super::error::DriverError;
use super::link::Link;
use super::numbers::{block, channel, descriptors, status, ALL_ONES, RUN};

/// Bytes of a page.
const PAGE: usize = 4096;
/// Pages of data for one run, behind the page with its descriptors.
const PAGES: usize = 16;
/// Bytes of data for one run.
const MOST: usize = PAGES * PAGE;
/// Offset in the memory at which the bridge reports the length of an answer.
const WRITTEN: usize = PAGES * Descriptor::BYTES;
/// Longest wait for a message before the status is read without one.
const LOOK: Duration = Duration::from_millis(100);

/// Errors as the driver XDMA reports them: a failed transfer, no such device, time over.
const EIO: i32 = 5;
const ENODEV: i32 = 19;
const ERESTARTSYS: i32 = 512;

fn failed(errno: i32) -> io::Error {
    io::Error::from_raw_os_error(errno)
}

/// A channel of the card with memory for its data. While the value lives, nobody else may use the channel.
pub struct Transfers {
    link: Arc<Link>,
    way: Way,
    memory: DmaMemory,
    timeout: Duration,
}

impl Transfers {
    /// Allocates memory for the channel and maps it for the card.
    ///
    /// # Errors
    /// The system has no memory, or the card does not answer.
    pub fn new(link: &Arc<Link>, way: Way, timeout: Duration) -> Result<Self, DriverError> {
        // The address of the data is a multiple of 4 GiB: the descriptors before it end where the low 32 bits overflow.
        let memory = DmaMemory::new(link.new_range() - PAGE as u64, PAGE + MOST)?;
        link.map(&memory)?;
        Ok(Self { link: Arc::clone(link), way, memory, timeout })
    }

    /// Memory of the channel: a page for descriptors, then the data.
    pub fn memory(&self) -> &DmaMemory {
        &self.memory
    }

    fn event(&self) -> &OwnedFd {
        self.link.event(self.way)
    }

    /// True if messages came since the last call.
    pub fn was_told(&self) -> bool {
        rustix::io::read(self.event(), &mut [0u8; 8]).is_ok()
    }

    /// The offset of a register of the channel.
    pub fn register(&self, register: u32) -> u32 {
        block::CHANNEL[self.way as usize] + register
    }

    /// Stores descriptors at the start of the memory, each pointing at the one behind it.
    ///
    /// # Errors
    /// There are more descriptors than fit.
    pub fn describe(&self, all: &[Descriptor]) -> io::Result<()> {
        for (place, descriptor) in all.iter().enumerate() {
            let at = place * Descriptor::BYTES;
            let next = self.memory.address() + (at + Descriptor::BYTES) as u64;
            self.memory.write(at, &Descriptor { next, ..*descriptor }.to_bytes())?;
        }
        Ok(())
    }

    /// Starts a run from the descriptor at this address.
    pub fn begin(&self, first: u64) {
        // A message for an earlier run must not be taken for one of this run.
        self.was_told();
        let at = block::DESCRIPTORS[self.way as usize];
        self.link.set_dma(at + descriptors::LOW, first as u32);
        self.link.set_dma(at + descriptors::HIGH, (first >> 32) as u32);
        self.link.set_dma(at + descriptors::ADJACENT, 0);
        self.link.set_dma(self.register(channel::CONTROL_SET), RUN);
    }

    /// Waits for the end of the run, and returns the bits of the status that were set meanwhile.
    ///
    /// # Errors
    /// As the driver XDMA: the card is gone, somebody reset it, or the time is over.
    pub fn wait(&self) -> io::Result<u32> {
        let deadline = Instant::now() + self.timeout;
        let mut seen = 0;
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            let was_told = self.wait_for_message(left.min(LOOK));
            let now = self.link.dma(self.register(channel::STATUS_CLEAR));
            if now == ALL_ONES {
                return Err(failed(ENODEV));
            }
            seen |= now & !status::BUSY;
            if seen & (status::STOPPED | status::ERRORS) != 0 {
                // The bridge sends the message before the status changes, so a message that
                // is missing now will not come.
                if !was_told && !self.was_told() {
                    self.link.count_untold();
                }
                return Ok(seen);
            }
            if self.link.dma(self.register(channel::CONTROL)) & RUN == 0 {
                return Err(failed(EIO));
            }
            if left.is_zero() {
                return Err(failed(ERESTARTSYS));
            }
        }
    }

    /// Ends the run, even one that is not complete.
    pub fn end(&self) {
        self.link.set_dma(self.register(channel::CONTROL_CLEAR), RUN);
    }

    fn wait_for_message(&self, time: Duration) -> bool {
        let time = Timespec { tv_sec: 0, tv_nsec: time.min(LOOK).subsec_nanos().into() };
        let mut events = [PollFd::new(self.event(), PollFlags::IN)];
        // An interrupted wait is a short wait; the caller waits again.
        let _ = poll(&mut events, Some(&time));
        self.was_told()
    }

    /// Runs over the descriptors that were stored.
    fn run(&self) -> io::Result<()> {
        self.begin(self.memory.address());
        let ended = self.wait();
        self.end();
        if ended? & status::ERRORS == 0 {
            Ok(())
        } else {
            Err(failed(EIO))
        }
    }
}

impl Drop for Transfers {
    /// Stops the card, which must not reach memory that may be used for something else.
    fn drop(&mut self) {
        self.end();
        // An error means that the card is gone, and such a card reaches nothing.
        let _ = self.link.unmap(&self.memory);
    }
}

/// The file to which commands are written.
pub struct Commands(pub Transfers);

impl Write for Commands {
    /// Moves at most 64 KiB, with one descriptor for each page. The pages lie in memory in reverse order, since those
    /// of a real driver may lie anywhere.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let Self(transfers) = self;
        let count = bytes.len().min(MOST);
        let pages = count.div_ceil(PAGE);
        let mut all = Vec::with_capacity(pages);
        for (page, piece) in bytes[..count].chunks(PAGE).enumerate() {
            let at = (PAGES - page) * PAGE;
            transfers.memory.write(at, piece)?;
            let is_last = page + 1 == pages;
            all.push(Descriptor {
                stops: is_last,
                completes: is_last,
                ends: is_last,
                length: piece.len() as u32,
                source: transfers.memory.address() + at as u64,
                ..Descriptor::default()
            });
        }
        if pages > 0 {
            transfers.describe(&all)?;
            transfers.run()?;
        }
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The file from which answers are read.
pub struct Answers(pub Transfers);

impl Read for Answers {
    /// Moves at most 64 KiB, and nothing beyond the end of an answer.
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let Self(transfers) = self;
        let count = bytes.len().min(MOST);
        let memory = &transfers.memory;
        memory.write(WRITTEN, &[0; Written::BYTES])?;
        transfers.describe(&[Descriptor {
            stops: true,
            completes: true,
            length: count as u32,
            source: memory.address() + WRITTEN as u64,
            destination: memory.address() + PAGE as u64,
            ..Descriptor::default()
        }])?;
        transfers.run()?;
        let mut written = [0; Written::BYTES];
        memory.read(WRITTEN, &mut written)?;
        let came = Written::from_bytes(written).map_or(0, |written| written.length as usize);
        if came == 0 || came > count {
            return Err(failed(EIO));
        }
        memory.read(PAGE, &mut bytes[..came])?;
        Ok(came)
    }
}
