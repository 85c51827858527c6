//! A channel of the bridge: it fetches descriptors, and moves beats between the host's memory and the card.

use incircle_sim::pcie::Beats;

use super::descriptor::{Descriptor, Written};
use super::memory::{HostMemory, Refused};
use super::numbers::{channel, descriptors, status, RUN};

/// Upper bits of the identifier: of channels, and of their descriptors; the channels are streams.
const CHANNEL_IDENTIFIER: [u32; 2] = [0x1fc0_8000, 0x1fc1_8000];
const DESCRIPTORS_IDENTIFIER: [u32; 2] = [0x1fc4_8000, 0x1fc5_8000];
/// The bridge's version, of Vivado 2017.1 to now.
const VERSION: u32 = 6;
/// Any address and any length will do, and addresses have 64 bits.
const ALIGNMENTS: u32 = 0x0001_0140;
/// Bytes that are moved at once: whole beats of any width.
const PIECE: usize = 8 << 10;

/// Which way a channel goes. As a number: its place among the channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Commands.
    ToCard,
    /// Answers.
    ToHost,
}

/// A descriptor and how many of its bytes were moved.
type Progress = (Descriptor, u32);

/// A channel, with its registers.
///
/// It runs from a descriptor to the next until one says that it is the last. An error stops it, and so does clearing its bit `Run`: at the next
/// beat, where a real one ends its descriptor first, for which it may wait without end.
#[derive(Debug)]
pub struct Channel {
    way: Way,
    control: u32,
    status: u32,
    mask: u32,
    completed: u32,
    first: u64,
    adjacent: u32,
    is_busy: bool,
    /// Where the next descriptor is.
    next: u64,
    current: Option<Progress>,
    piece: Vec<u8>,
}

impl Channel {
    /// As after a reset.
    pub fn new(way: Way) -> Self {
        Self {
            way,
            control: 0,
            status: 0,
            mask: 0,
            completed: 0,
            first: 0,
            adjacent: 0,
            is_busy: false,
            next: 0,
            current: None,
            piece: vec![0; PIECE],
        }
    }

    /// True if it asks for its interrupt.
    pub fn requests(&self) -> bool {
        self.status & self.mask != 0
    }

    /// Reads a register of the channel; 0 where there is none.
    pub fn read(&mut self, offset: u32) -> u32 {
        let busy = if self.is_busy { status::BUSY } else { 0 };
        match offset {
            channel::IDENTIFIER => CHANNEL_IDENTIFIER[self.way as usize] | VERSION,
            channel::CONTROL => self.control,
            channel::STATUS => self.status | busy,
            channel::STATUS_CLEAR => std::mem::take(&mut self.status) | busy,
            channel::COMPLETED => self.completed,
            channel::ALIGNMENTS => ALIGNMENTS,
            channel::MASK => self.mask,
            _ => 0,
        }
    }

    /// Writes a register of the channel, if there is one.
    pub fn write(&mut self, offset: u32, value: u32) {
        match offset {
            channel::CONTROL => self.set_control(value),
            channel::CONTROL_SET => self.set_control(self.control | value),
            channel::CONTROL_CLEAR => self.set_control(self.control & !value),
            channel::STATUS => self.status &= !value,
            channel::MASK => self.mask = value & status::ALL,
            channel::MASK_SET => self.mask |= value & status::ALL,
            channel::MASK_CLEAR => self.mask &= !value,
            _ => {}
        }
    }

    /// Reads a register of its descriptors; 0 where there is none.
    pub fn read_descriptors(&self, offset: u32) -> u32 {
        match offset {
            descriptors::IDENTIFIER => DESCRIPTORS_IDENTIFIER[self.way as usize] | VERSION,
            descriptors::LOW => self.first as u32,
            descriptors::HIGH => (self.first >> 32) as u32,
            descriptors::ADJACENT => self.adjacent,
            _ => 0,
        }
    }

    /// Writes a register of its descriptors, if there is one.
    pub fn write_descriptors(&mut self, offset: u32, value: u32) {
        match offset {
            descriptors::LOW => self.first = self.first >> 32 << 32 | u64::from(value),
            descriptors::HIGH => self.first = u64::from(value) << 32 | u64::from(self.first as u32),
            // Those that lie together may be fetched together. Each is fetched alone here.
            descriptors::ADJACENT => self.adjacent = value & 0x3f,
            _ => {}
        }
    }

    fn set_control(&mut self, value: u32) {
        let did_run = self.control & RUN != 0;
        self.control = value & (RUN | status::ALL);
        match (did_run, value & RUN != 0) {
            (false, true) => {
                (self.status, self.completed, self.current) = (0, 0, None);
                (self.is_busy, self.next) = (true, self.first);
            }
            (true, false) => {
                (self.is_busy, self.current) = (false, None);
                self.note(status::IDLE);
            }
            _ => {}
        }
    }

    /// Sets a bit of the status, if the control lets it.
    fn note(&mut self, bit: u32) {
        self.status |= bit & self.control;
    }

    /// Moves what can be moved now, a piece at most. False if that was nothing.
    pub fn step(&mut self, card: &mut dyn Beats, memory: &HostMemory) -> bool {
        if !self.is_busy {
            return false;
        }
        self.advance(card, memory).unwrap_or_else(|error| {
            (self.is_busy, self.current) = (false, None);
            self.note(error);
            true
        })
    }

    /// The error is a bit of the status.
    fn advance(&mut self, card: &mut dyn Beats, memory: &HostMemory) -> Result<bool, u32> {
        let (descriptor, moved) = match self.current {
            Some(progress) => progress,
            None => (self.fetch(card.beat_bytes(), memory)?, 0),
        };
        let (now, is_end) = match self.way {
            Way::ToCard => (self.push((descriptor, moved), card, memory)?, false),
            Way::ToHost => self.pull((descriptor, moved), card, memory)?,
        };
        let moved = moved + now;
        if is_end || moved == descriptor.length {
            self.complete(descriptor, Written { length: moved, is_end }, memory)?;
            return Ok(true);
        }
        self.current = Some((descriptor, moved));
        Ok(now > 0)
    }

    fn fetch(&self, beat: usize, memory: &HostMemory) -> Result<Descriptor, u32> {
        let mut bytes = [0; Descriptor::BYTES];
        memory.read(self.next, &mut bytes).map_err(|Refused| status::DESCRIPTOR)?;
        let descriptor = Descriptor::from_bytes(bytes).ok_or(status::MAGIC)?;
        let is_whole = descriptor.length > 0 && (descriptor.length as usize).is_multiple_of(beat);
        is_whole.then_some(descriptor).ok_or(status::LENGTH)
    }

    /// Moves commands to the card; says how many bytes.
    fn push(&mut self, (of, moved): Progress, card: &mut dyn Beats, memory: &HostMemory) -> Result<u32, u32> {
        let count = PIECE.min((of.length - moved) as usize);
        let piece = &mut self.piece[..count];
        memory.read(of.source.wrapping_add(u64::from(moved)), piece).map_err(|Refused| status::READ)?;
        // No more than a piece.
        Ok(card.take(piece) as u32)
    }

    /// Moves an answer to the host; says how many bytes, and whether they end it.
    fn pull(&mut self, (of, moved): Progress, card: &mut dyn Beats, memory: &HostMemory) -> Result<(u32, bool), u32> {
        let count = PIECE.min((of.length - moved) as usize);
        let given = card.give(&mut self.piece[..count]);
        let address = of.destination.wrapping_add(u64::from(moved));
        memory.write(address, &self.piece[..given.bytes]).map_err(|Refused| status::WRITE)?;
        Ok((given.bytes as u32, given.is_end))
    }

    fn complete(&mut self, of: Descriptor, written: Written, memory: &HostMemory) -> Result<(), u32> {
        if self.way == Way::ToHost {
            memory.write(of.source, &written.to_bytes()).map_err(|Refused| status::WRITE)?;
        }
        self.current = None;
        self.completed = self.completed.wrapping_add(1);
        self.next = of.next;
        if of.completes {
            self.note(status::COMPLETED);
        }
        if of.stops {
            self.is_busy = false;
            self.note(status::STOPPED);
        }
        Ok(())
    }
}
