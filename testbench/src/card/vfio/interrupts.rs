//! The bridge's interrupts: what each channel asks for, which message that is, what masks it, and the event that the host waits for.

use std::fs::File;
use std::io::Write;

use vfio_bindings::bindings::vfio::{
    VFIO_IRQ_SET_ACTION_MASK, VFIO_IRQ_SET_ACTION_TRIGGER, VFIO_IRQ_SET_ACTION_TYPE_MASK, VFIO_IRQ_SET_ACTION_UNMASK,
    VFIO_IRQ_SET_DATA_EVENTFD,
};

use super::numbers::{interrupts, CHANNELS, ENTRY_BYTES, ENTRY_CONTROL, ENTRY_MASKED, VECTORS};

/// What the block of registers says it is.
const IDENTIFIER: u32 = 0x1fc2_0006;
/// Words of an entry in the table of messages.
const ENTRY_WORDS: usize = ENTRY_BYTES as usize / 4;
/// A bit for each channel.
const ALL: u32 = (1 << CHANNELS) - 1;

/// A host's message is not one of the card's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("messages {start} to {start} + {count} are not there: there are {VECTORS}")]
pub struct NoVector {
    start: u32,
    count: u32,
}

/// The state of all interrupts.
///
/// A channel's line is high while it asks and its mask lets it. A line that goes high is worth one message. What cannot be sent, as something masks
/// it, is sent when that ends and the line is still high: so none is lost.
#[derive(Debug)]
pub struct Interrupts {
    /// Channels that ask, and that may.
    requests: u32,
    mask: u32,
    vectors: u32,
    table: [[u32; ENTRY_WORDS]; VECTORS],
    /// Events of the host, and messages that it masks besides.
    events: [Option<File>; VECTORS],
    is_masked: [bool; VECTORS],
    /// Channels whose line was told.
    told: u32,
}

impl Interrupts {
    /// As after a reset: no event, each message masked.
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

    /// A reset: only the host's events are left.
    pub fn reset(&mut self) {
        let events = std::mem::replace(&mut self.events, [const { None }; VECTORS]);
        *self = Self { events, ..Self::new() };
    }

    /// Reads a register; 0 where there is none.
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

    /// Writes a register, if there is one.
    pub fn write(&mut self, offset: u32, value: u32) {
        match offset {
            interrupts::CHANNEL_MASK => self.mask = value & ALL,
            interrupts::CHANNEL_MASK_SET => self.mask |= value & ALL,
            interrupts::CHANNEL_MASK_CLEAR => self.mask &= !value,
            interrupts::CHANNEL_VECTORS => self.vectors = value & 0x1f1f,
            _ => {}
        }
    }

    /// Reads the table of messages, by an offset in it; 0 behind its end.
    pub fn read_table(&self, offset: u32) -> u32 {
        let word = offset as usize / 4;
        self.table.get(word / ENTRY_WORDS).map_or(0, |entry| entry[word % ENTRY_WORDS])
    }

    /// Writes it.
    pub fn write_table(&mut self, offset: u32, value: u32) {
        let word = offset as usize / 4;
        if let Some(entry) = self.table.get_mut(word / ENTRY_WORDS) {
            entry[word % ENTRY_WORDS] = value;
        }
    }

    /// A bit for each message that waits for its mask.
    pub fn pending(&self) -> u32 {
        let lines = self.requests & self.mask & !self.told;
        let waiting = (0..CHANNELS).filter(|channel| lines >> channel & 1 != 0);
        waiting.map(|channel| self.vector(channel)).fold(0, |bits, vector| bits | 1 << vector)
    }

    fn vector(&self, channel: usize) -> usize {
        (self.vectors >> (8 * channel) & 0x1f) as usize
    }

    /// What the host does with messages from `start` on: events for them, or none, or a mask.
    ///
    /// # Errors
    /// There are not so many messages.
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
            // None of none is the end of all of them.
            VFIO_IRQ_SET_ACTION_TRIGGER if count == 0 => self.events.iter_mut().for_each(|event| *event = None),
            VFIO_IRQ_SET_ACTION_TRIGGER => range.for_each(|vector| self.send(vector)),
            VFIO_IRQ_SET_ACTION_MASK => self.is_masked[range].fill(true),
            VFIO_IRQ_SET_ACTION_UNMASK => self.is_masked[range].fill(false),
            _ => {}
        }
        Ok(())
    }

    /// Forgets the host's events, and its masks.
    pub fn forget(&mut self) {
        *self = Self::new();
    }

    /// Sends what is to be sent. `requests` has a bit for each channel; `may_send`: configuration space allows messages.
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
            // It counts to 2^64; a host that gave something else than an event has none.
            let _ = event.write_all(&1u64.to_ne_bytes());
        }
    }
}
