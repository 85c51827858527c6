//! The card's configuration space: its identity, its two windows, and the switches for memory, DMA and messages.

use super::numbers::{block, config, CLASS, DEVICE, DMA_BAR, DMA_BYTES, USER_BAR, USER_BYTES, VECTORS, VENDOR};

/// Offset of the subsystem id, which is the bridge's own unless the build script names another.
const SUBSYSTEM_AT: usize = 0x2c;
const SUBSYSTEM: u16 = 0x0007;
/// Bits in the upper byte of the messages' control that the host may write.
const CONTROL_BITS: u8 = ((config::MESSAGES_ENABLED | config::MESSAGES_MASKED) >> 8) as u8;

/// The bytes of the configuration space, and a mask of the bits that the host may write.
#[derive(Debug)]
pub struct ConfigSpace {
    bytes: Vec<u8>,
    writable: Vec<u8>,
}

impl ConfigSpace {
    /// Makes the space in the state after a reset.
    pub fn new() -> Self {
        let mut space = Self { bytes: vec![0; config::BYTES], writable: vec![0; config::BYTES] };
        space.put(0, &VENDOR.to_le_bytes());
        space.put(2, &DEVICE.to_le_bytes());
        space.put(config::STATUS, &[config::STATUS_CAPABILITIES]);
        space.put(config::CLASS, &CLASS.to_le_bytes()[..3]);
        space.put(SUBSYSTEM_AT, &VENDOR.to_le_bytes());
        space.put(SUBSYSTEM_AT + 2, &SUBSYSTEM.to_le_bytes());
        space.put(config::CAPABILITIES, &[config::MESSAGES_AT as u8]);
        // The capability holds the number of messages less one, and the place of each of their tables: an offset
        // whose lowest bits name the window.
        space.put(config::MESSAGES_AT, &[config::MESSAGES, 0, VECTORS as u8 - 1, 0]);
        space.put(config::MESSAGES_AT + 4, &(block::MESSAGE_TABLE | DMA_BAR).to_le_bytes());
        space.put(config::MESSAGES_AT + 8, &(block::PENDING | DMA_BAR).to_le_bytes());
        space.writable[config::COMMAND] = config::COMMAND_MEMORY | config::COMMAND_MASTER;
        space.writable[config::MESSAGES_AT + 3] = CONTROL_BITS;
        // A window's address is a multiple of its size: a host that writes all ones reads the size back.
        for (bar, size) in [(USER_BAR, USER_BYTES), (DMA_BAR, DMA_BYTES)] {
            let at = config::BARS + 4 * bar as usize;
            space.writable[at..at + 4].copy_from_slice(&(!(size as u32 - 1)).to_le_bytes());
        }
        space
    }

    fn put(&mut self, at: usize, bytes: &[u8]) {
        self.bytes[at..at + bytes.len()].copy_from_slice(bytes);
    }

    /// Reads from an offset on; bytes behind the end are all ones.
    pub fn read(&self, offset: u64, bytes: &mut [u8]) {
        let from = usize::try_from(offset).unwrap_or(usize::MAX);
        for (place, byte) in bytes.iter_mut().enumerate() {
            *byte = self.bytes.get(from.saturating_add(place)).copied().unwrap_or(u8::MAX);
        }
    }

    /// Writes the bits that the host may write.
    pub fn write(&mut self, offset: u64, bytes: &[u8]) {
        let from = usize::try_from(offset).unwrap_or(usize::MAX);
        for (place, byte) in bytes.iter().enumerate() {
            let at = from.saturating_add(place);
            if let (Some(old), Some(bits)) = (self.bytes.get_mut(at), self.writable.get(at)) {
                *old = *old & !bits | byte & bits;
            }
        }
    }

    /// True if the host has opened the windows.
    pub fn has_memory(&self) -> bool {
        self.bytes[config::COMMAND] & config::COMMAND_MEMORY != 0
    }

    /// True if the card may reach the host's memory.
    pub fn is_master(&self) -> bool {
        self.bytes[config::COMMAND] & config::COMMAND_MASTER != 0
    }

    /// True if the card may send messages.
    pub fn has_messages(&self) -> bool {
        let control = u16::from(self.bytes[config::MESSAGES_AT + 3]) << 8;
        // A message is a write to the host's memory, so the card must be bus master as well.
        self.is_master() && control & (config::MESSAGES_ENABLED | config::MESSAGES_MASKED) == config::MESSAGES_ENABLED
    }
}
