//! The card's configuration space: who it is, its two windows, and the switches for memory, for DMA and for messages.

use super::numbers::{block, config, CLASS, DEVICE, DMA_BAR, DMA_BYTES, USER_BAR, USER_BYTES, VECTORS, VENDOR};

/// The subsystem of the bridge, unless the build script names another.
const SUBSYSTEM_AT: usize = 0x2c;
const SUBSYSTEM: u16 = 0x0007;
/// Bits of the control of messages that the host may write, in its upper byte.
const CONTROL_BITS: u8 = ((config::MESSAGES_ENABLED | config::MESSAGES_MASKED) >> 8) as u8;

/// The bytes of it, and which of their bits may be written.
#[derive(Debug)]
pub struct ConfigSpace {
    bytes: Vec<u8>,
    writable: Vec<u8>,
}

impl ConfigSpace {
    /// As after a reset.
    pub fn new() -> Self {
        let mut space = Self { bytes: vec![0; config::BYTES], writable: vec![0; config::BYTES] };
        space.put(0, &VENDOR.to_le_bytes());
        space.put(2, &DEVICE.to_le_bytes());
        space.put(config::STATUS, &[config::STATUS_CAPABILITIES]);
        space.put(config::CLASS, &CLASS.to_le_bytes()[..3]);
        space.put(SUBSYSTEM_AT, &VENDOR.to_le_bytes());
        space.put(SUBSYSTEM_AT + 2, &SUBSYSTEM.to_le_bytes());
        space.put(config::CAPABILITIES, &[config::MESSAGES_AT as u8]);
        // The number of messages less one, and where their tables are: an offset, and in its lowest bits the window.
        space.put(config::MESSAGES_AT, &[config::MESSAGES, 0, VECTORS as u8 - 1, 0]);
        space.put(config::MESSAGES_AT + 4, &(block::MESSAGE_TABLE | DMA_BAR).to_le_bytes());
        space.put(config::MESSAGES_AT + 8, &(block::PENDING | DMA_BAR).to_le_bytes());
        space.writable[config::COMMAND] = config::COMMAND_MEMORY | config::COMMAND_MASTER;
        space.writable[config::MESSAGES_AT + 3] = CONTROL_BITS;
        // A window's address is a multiple of its size, so that all ones written tell the size.
        for (bar, size) in [(USER_BAR, USER_BYTES), (DMA_BAR, DMA_BYTES)] {
            let at = config::BARS + 4 * bar as usize;
            space.writable[at..at + 4].copy_from_slice(&(!(size as u32 - 1)).to_le_bytes());
        }
        space
    }

    fn put(&mut self, at: usize, bytes: &[u8]) {
        self.bytes[at..at + bytes.len()].copy_from_slice(bytes);
    }

    /// Reads from an offset on; all ones behind the end.
    pub fn read(&self, offset: u64, bytes: &mut [u8]) {
        let from = usize::try_from(offset).unwrap_or(usize::MAX);
        for (place, byte) in bytes.iter_mut().enumerate() {
            *byte = self.bytes.get(from.saturating_add(place)).copied().unwrap_or(u8::MAX);
        }
    }

    /// Writes the bits that may be written.
    pub fn write(&mut self, offset: u64, bytes: &[u8]) {
        let from = usize::try_from(offset).unwrap_or(usize::MAX);
        for (place, byte) in bytes.iter().enumerate() {
            let at = from.saturating_add(place);
            if let (Some(old), Some(bits)) = (self.bytes.get_mut(at), self.writable.get(at)) {
                *old = *old & !bits | byte & bits;
            }
        }
    }

    /// The windows answer.
    pub fn has_memory(&self) -> bool {
        self.bytes[config::COMMAND] & config::COMMAND_MEMORY != 0
    }

    /// The card may reach the host's memory.
    pub fn is_master(&self) -> bool {
        self.bytes[config::COMMAND] & config::COMMAND_MASTER != 0
    }

    /// It may send messages.
    pub fn has_messages(&self) -> bool {
        let control = u16::from(self.bytes[config::MESSAGES_AT + 3]) << 8;
        // Messages are writes to the host's memory.
        self.is_master() && control & (config::MESSAGES_ENABLED | config::MESSAGES_MASKED) == config::MESSAGES_ENABLED
    }
}
