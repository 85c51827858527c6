//! A channel of the bridge, which fetches descriptors and moves beats between the host's memory and the card.

use incircle_sim::pcie::Beats;

use super::descriptor::{Descriptor, Written};
use super::memory::{HostMemory, Refused};
use super::numbers::{channel, descriptors, status, RUN};

/// Upper bits of the identifiers of the channels and of their descriptors. The channels are streams.
const CHANNEL_IDENTIFIER: [u32; 2] = [0x1fc0_8000, 0x1fc1_8000];
const DESCRIPTORS_IDENTIFIER: [u32; 2] = [0x1fc4_8000, 0x1fc5_8000];
/// Version of the bridge that Vivado 2017.1 and later build.
const VERSION: u32 = 6;
/// Says that any address and any length are allowed, and that addresses have 64 bits.
const ALIGNMENTS: u32 = 0x0001_0140;
/// Bytes that are moved in one step: whole beats of any width.
const PIECE: usize = 8 << 10;

/// Direction of a channel. As a number, its place among the channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The channel that carries commands.
    ToCard,
    /// The channel that carries answers.
    ToHost,
}

/// A descriptor, and the number of its bytes that were moved.
type Progress = (Descriptor, u32);

/// A channel and its registers.
///
/// A run goes from one descriptor to the next until a descriptor says that it is the last. An error stops the run, and
/// so does clearing the bit `Run`. This model then stops at the next beat; a real bridge first ends the descriptor, for
/// which it may wait without end.
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
    /// Address of the next descriptor.
    next: u64,
    current: Option<Progress>,
    piece: Vec<u8>,
}

impl Channel {
    /// Makes a channel in the state after a reset.
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

    /// True while the channel asks for its interrupt.
    pub fn requests(&self) -> bool {
        self.status & self.mask != 0
    }

    /// Reads a register of the channel; an unused offset reads as 0.
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

    /// Writes a register of the channel; a write to an unused offset does nothing.
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

    /// Reads a register of the channel's descriptors; an unused offset reads as 0.
    pub fn read_descriptors(&self, offset: u32) -> u32 {
        match offset {
            descriptors::IDENTIFIER => DESCRIPTORS_IDENTIFIER[self.way as usize] | VERSION,
            descriptors::LOW => self.first as u32,
            descriptors::HIGH => (self.first >> 32) as u32,
            descriptors::ADJACENT => self.adjacent,
            _ => 0,
        }
    }

    /// Writes a register of the channel's descriptors; a write to an unused offset does nothing.
    pub fn write_descriptors(&mut self, offset: u32, value: u32) {
        match offset {
            descriptors::LOW => self.first = self.first >> 32 << 32 | u64::from(value),
            descriptors::HIGH => self.first = u64::from(value) << 32 | u64::from(self.first as u32),
            // A real bridge may fetch adjacent descriptors together; this model fetches each by itself.
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

    /// Sets a bit of the status if the control enables that bit.
    fn note(&mut self, bit: u32) {
        self.status |= bit & self.control;
    }

    /// Moves at most one piece. Returns false if nothing could be moved.
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

    /// Works on the current descriptor; an error is the bit of the status that reports it.
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

    /// Moves commands to the card and returns the number of bytes moved.
    fn push(&mut self, (of, moved): Progress, card: &mut dyn Beats, memory: &HostMemory) -> Result<u32, u32> {
        let count = PIECE.min((of.length - moved) as usize);
        let piece = &mut self.piece[..count];
        memory.read(of.source.wrapping_add(u64::from(moved)), piece).map_err(|Refused| status::READ)?;
        // The cast is safe: a piece has 8 KiB at most.
        Ok(card.take(piece) as u32)
    }

    /// Moves an answer to the host and returns the number of bytes moved, and whether the answer ended with them.
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
