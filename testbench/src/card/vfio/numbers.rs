//! Numbers of the bridge that both its sides use, from AMD's product guide PG195, "DMA/Bridge Subsystem
//! for PCI Express": one channel to the card, one to the host, and what their interrupts need. Offsets
//! count bytes; registers have 32 bits.

/// Vendor and device id of the bridge on the 7 series with 5 GT/s and four lanes. The card's build
/// script leaves these as they are.
pub const VENDOR: u16 = 0x10ee;
pub const DEVICE: u16 = 0x7024;
/// Class code "simple communication controller, serial, 16450". The bridge's own too; no driver looks for it.
pub const CLASS: u32 = 0x07_00_01;

/// Regions of the two windows: registers of the card, as its build script requests them, and registers of the bridge.
pub const USER_BAR: u32 = 0;
pub const USER_BYTES: u64 = 4 << 10;
pub const DMA_BAR: u32 = 1;
pub const DMA_BYTES: u64 = 64 << 10;

/// Value of a read that nothing answers.
pub const ALL_ONES: u32 = u32::MAX;

/// Number of channels. Masks of interrupts count the one to the card first, then the one to the host.
pub const CHANNELS: usize = 2;

/// Offsets at which the blocks of registers begin.
pub mod block {
    /// The block of each channel.
    pub const CHANNEL: [u32; super::CHANNELS] = [0x0000, 0x1000];
    /// The block of the interrupts.
    pub const INTERRUPTS: u32 = 0x2000;
    /// The block with the choices made for the bridge. Only its identifier is modelled.
    pub const CHOICES: u32 = 0x3000;
    /// The block of each channel's descriptors.
    pub const DESCRIPTORS: [u32; super::CHANNELS] = [0x4000, 0x5000];
    /// The table of message-signalled interrupts, and the bits of those that are pending.
    pub const MESSAGE_TABLE: u32 = 0x8000;
    pub const PENDING: u32 = 0x8fe0;
    /// Number of bytes of a block.
    pub const BYTES: u32 = 0x1000;
}

/// Offsets of the registers of a channel.
pub mod channel {
    pub const IDENTIFIER: u32 = 0x00;
    /// The control register; the next two set or clear the bits that are written as ones.
    pub const CONTROL: u32 = 0x04;
    pub const CONTROL_SET: u32 = 0x08;
    pub const CONTROL_CLEAR: u32 = 0x0c;
    /// The status register: ones that are written clear bits; a read at the second offset clears all.
    pub const STATUS: u32 = 0x40;
    pub const STATUS_CLEAR: u32 = 0x44;
    /// Number of descriptors done since the run began.
    pub const COMPLETED: u32 = 0x48;
    pub const ALIGNMENTS: u32 = 0x4c;
    /// Mask of the bits of the status that ask for an interrupt.
    pub const MASK: u32 = 0x90;
    pub const MASK_SET: u32 = 0x94;
    pub const MASK_CLEAR: u32 = 0x98;
}

/// Offsets of the registers of a channel's descriptors.
pub mod descriptors {
    pub const IDENTIFIER: u32 = 0x00;
    pub const LOW: u32 = 0x80;
    pub const HIGH: u32 = 0x84;
    /// Number of descriptors that lie right behind the first.
    pub const ADJACENT: u32 = 0x88;
}

/// Offsets of the registers of interrupts.
pub mod interrupts {
    pub const IDENTIFIER: u32 = 0x00;
    pub const CHANNEL_MASK: u32 = 0x10;
    pub const CHANNEL_MASK_SET: u32 = 0x14;
    pub const CHANNEL_MASK_CLEAR: u32 = 0x18;
    /// The channels that ask, and those of them that are allowed to.
    pub const CHANNEL_REQUEST: u32 = 0x44;
    pub const CHANNEL_PENDING: u32 = 0x4c;
    /// The message of each channel: five bits in a byte for each.
    pub const CHANNEL_VECTORS: u32 = 0xa0;
}

/// Bits of a channel's status. The same bit of the control enables each of them, except bit
/// 0, which lets the channel run.
pub mod status {
    pub const BUSY: u32 = 1;
    pub const STOPPED: u32 = 1 << 1;
    pub const COMPLETED: u32 = 1 << 2;
    /// A descriptor lacks its magic number.
    pub const MAGIC: u32 = 1 << 4;
    /// The length of a descriptor is no whole number of beats.
    pub const LENGTH: u32 = 1 << 5;
    pub const IDLE: u32 = 1 << 6;
    /// The host refused a read of data, as an "unsupported request".
    pub const READ: u32 = 1 << 9;
    /// The host refused a write. A real bridge posts its writes and never hears of a refusal; this model reports it, so
    /// that a driver can be tested.
    pub const WRITE: u32 = 1 << 14;
    /// The host refused a read of a descriptor.
    pub const DESCRIPTOR: u32 = 1 << 19;
    /// All bits that report errors.
    pub const ERRORS: u32 = MAGIC | LENGTH | READ | WRITE | DESCRIPTOR;
    /// All bits but `BUSY`.
    pub const ALL: u32 = STOPPED | COMPLETED | IDLE | ERRORS;
}

/// The bit of a channel's control that lets the channel run.
pub const RUN: u32 = 1;

/// Number of messages that the bridge has.
pub const VECTORS: usize = 32;
/// Bytes of a message's entry in the table, and the place of its mask bit.
pub const ENTRY_BYTES: u32 = 16;
pub const ENTRY_CONTROL: u32 = 12;
pub const ENTRY_MASKED: u32 = 1;

/// Offsets and values of the configuration space.
pub mod config {
    pub const BYTES: usize = 4096;
    pub const COMMAND: usize = 0x04;
    pub const COMMAND_MEMORY: u8 = 1 << 1;
    pub const COMMAND_MASTER: u8 = 1 << 2;
    pub const STATUS: usize = 0x06;
    pub const STATUS_CAPABILITIES: u8 = 1 << 4;
    pub const CLASS: usize = 0x09;
    pub const BARS: usize = 0x10;
    pub const CAPABILITIES: usize = 0x34;
    /// Identifier of the capability for message-signalled interrupts, its offset, and the bits of its control.
    pub const MESSAGES: u8 = 0x11;
    pub const MESSAGES_AT: usize = 0x60;
    pub const MESSAGES_ENABLED: u16 = 1 << 15;
    pub const MESSAGES_MASKED: u16 = 1 << 14;
}
