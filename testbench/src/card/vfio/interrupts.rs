//! The bridge's interrupts: the requests of the channels, the message for each, the masks, and the
//! events that the host waits for.

use std::fs::File;
use std::io::Write;

use vfio_bindings::bindings::vfio::{
    VFIO_IRQ_SET_ACTION_MASK, VFIO_IRQ_SET_ACTION_TRIGGER, VFIO_IRQ_SET_ACTION_TYPE_MASK, VFIO_IRQ_SET_ACTION_UNMASK,
    VFIO_IRQ_SET_DATA_EVENTFD,
};

use super::numbers::{interrupts, CHANNELS, ENTRY_BYTES, ENTRY_CONTROL, ENTRY_MASKED, VECTORS};

/// Identifier of the block of registers.
const IDENTIFIER: u32 = 0x1fc2_0006;
/// Words of an entry in the table of messages.
const ENTRY_WORDS: usize = ENTRY_BYTES as usize / 4;
/// Mask with a bit for each channel.
const ALL: u32 = (1 << CHANNELS) - 1;

/// The host named a message that the card does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("messages {start} to {start} + {count} are not there: there are {VECTORS}")]
pub struct NoVector {
    start: u32,
    count: u32,
}

/// State of all interrupts.
///
/// A channel's line is high while the channel asks and its mask allows the interrupt. Each rise of a line is
/// worth one message. A message that a mask holds back is sent when the mask goes, if the line is still high by
/// then: so no interrupt is lost.
#[derive(Debug)]
pub struct Interrupts {
    /// A bit for each channel: the channels that ask, and those that the host allows.
    requests: u32,
    mask: u32,
    vectors: u32,
    table: [[u32; ENTRY_WORDS]; VECTORS],
    /// The host's event for each message, and the messages that the host masks at its end of the socket.
    events: [Option<File>; VECTORS],
    is_masked: [bool; VECTORS],
    /// A bit for each channel whose line is high and was reported by a message.
    told: u32,
}

impl Interrupts {
    /// Makes the state after power-up: no event, every message masked.
    pub fn new() -> Self {
        let mut entry = [0; ENTRY_WORDS];
        entry[ENTRY_CONTROL as usize / 4] = ENTRY_MASKED;
        Self {
            requests: 0,
            mask: 0,
            vectors: 0,
            table: [entry; VECTORS],
            events: [const { None }; VECTORS],
            is_masked: [false; VECTORS],
            told: 0,
        }
    }

    /// Resets everything but the host's events.
    pub fn reset(&mut self) {
        let events = std::mem::replace(&mut self.events, [const { None }; VECTORS]);
        *self = Self { events, ..Self::new() };
    }

    /// Reads a register; an unused offset reads as 0.
    pub fn read(&self, offset: u32) -> u32 {
        match offset {
            interrupts::IDENTIFIER => IDENTIFIER,
            interrupts::CHANNEL_MASK => self.mask,
            interrupts::CHANNEL_REQUEST => self.requests,
            interrupts::CHANNEL_PENDING => self.requests & self.mask,
            interrupts::CHANNEL_VECTORS => self.vectors,
            _ => 0,
        }
    }

    /// Writes a register; a write to an unused offset does nothing.
    pub fn write(&mut self, offset: u32, value: u32) {
        match offset {
            interrupts::CHANNEL_MASK => self.mask = value & ALL,
            interrupts::CHANNEL_MASK_SET => self.mask |= value & ALL,
            interrupts::CHANNEL_MASK_CLEAR => self.mask &= !value,
            interrupts::CHANNEL_VECTORS => self.vectors = value & 0x1f1f,
            _ => {}
        }
    }

    /// Reads the table of messages at an offset; behind its end the table reads as 0.
    pub fn read_table(&self, offset: u32) -> u32 {
        let word = offset as usize / 4;
        self.table.get(word / ENTRY_WORDS).map_or(0, |entry| entry[word % ENTRY_WORDS])
    }

    /// Writes the table of messages at an offset.
    pub fn write_table(&mut self, offset: u32, value: u32) {
        let word = offset as usize / 4;
        if let Some(entry) = self.table.get_mut(word / ENTRY_WORDS) {
            entry[word % ENTRY_WORDS] = value;
        }
    }

    /// A bit for each message that is held back by a mask.
    pub fn pending(&self) -> u32 {
        let lines = self.requests & self.mask & !self.told;
        let waiting = (0..CHANNELS).filter(|channel| lines >> channel & 1 != 0);
        waiting.map(|channel| self.vector(channel)).fold(0, |bits, vector| bits | 1 << vector)
    }

    fn vector(&self, channel: usize) -> usize {
        (self.vectors >> (8 * channel) & 0x1f) as usize
    }

    /// Handles the host's request about `count` messages from `start` on: set their events, drop all events,
    /// send them, mask or unmask them.
    ///
    /// # Errors
    /// The card has fewer messages than that.
    pub fn set(&mut self, flags: u32, (start, count): (u32, u32), events: Vec<File>) -> Result<(), NoVector> {
        let range = start as usize..(start as usize).saturating_add(count as usize);
        if range.end > VECTORS {
            return Err(NoVector { start, count });
        }
        let has_events = flags & VFIO_IRQ_SET_DATA_EVENTFD != 0;
        match flags & VFIO_IRQ_SET_ACTION_TYPE_MASK {
            VFIO_IRQ_SET_ACTION_TRIGGER if has_events => {
                let mut events = events.into_iter();
                self.events[range].iter_mut().for_each(|event| *event = events.next());
            }
            // In the protocol a trigger without data and of no message ends all events.
            VFIO_IRQ_SET_ACTION_TRIGGER if count == 0 => self.events.iter_mut().for_each(|event| *event = None),
            VFIO_IRQ_SET_ACTION_TRIGGER => range.for_each(|vector| self.send(vector)),
            VFIO_IRQ_SET_ACTION_MASK => self.is_masked[range].fill(true),
            VFIO_IRQ_SET_ACTION_UNMASK => self.is_masked[range].fill(false),
            _ => {}
        }
        Ok(())
    }

    /// Forgets the host's events and masks.
    pub fn forget(&mut self) {
        *self = Self::new();
    }

    /// Sends the messages that are due. `requests` has a bit for each channel; `may_send` says
    /// that the configuration space allows messages.
    pub fn deliver(&mut self, requests: u32, may_send: bool) {
        self.requests = requests;
        let lines = requests & self.mask;
        self.told &= lines;
        let untold = lines & !self.told;
        for channel in (0..CHANNELS).filter(|channel| untold >> channel & 1 != 0) {
            let vector = self.vector(channel);
            let is_masked =
                self.is_masked[vector] || self.table[vector][ENTRY_CONTROL as usize / 4] & ENTRY_MASKED != 0;
            if may_send && !is_masked {
                self.send(vector);
                self.told |= 1 << channel;
            }
        }
    }

    fn send(&mut self, vector: usize) {
        if let Some(event) = &mut self.events[vector] {
            // An event counts up to 2^64, so it takes this one. A host that gave another kind of file gets no event.
            let _ = event.write_all(&1u64.to_ne_bytes());
        }
    }
}
