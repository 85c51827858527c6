//! Numbers of the bridge that both its sides use, from AMD's product guide PG195, "DMA/Bridge Subsystem for PCI Express": one channel to the
//! card, one to the host, and what their interrupts need. Offsets are bytes, registers have 32 bits.

/// Who made the bridge, and which it is: on 7 series, two of five GT/s, four lanes. The card's build script leaves the bridge's own numbers.
pub const VENDOR: u16 = 0x10ee;
pub const DEVICE: u16 = 0x7024;
/// Simple communication controller, serial, 16450: the bridge's own as well, and no driver asks for it.
pub const CLASS: u32 = 0x07_00_01;

/// The windows: registers of the card, as its build script asks for them, and registers of the bridge.
pub const USER_BAR: u32 = 0;
pub const USER_BYTES: u64 = 4 << 10;
pub const DMA_BAR: u32 = 1;
pub const DMA_BYTES: u64 = 64 << 10;

/// What is read where nothing answers.
pub const ALL_ONES: u32 = u32::MAX;

/// Channels, as they are counted in masks of interrupts: to the card, to the host.
pub const CHANNELS: usize = 2;

/// Where the blocks of registers begin.
pub mod block {
    /// Of each channel.
    pub const CHANNEL: [u32; super::CHANNELS] = [0x0000, 0x1000];
    /// Interrupts.
    pub const INTERRUPTS: u32 = 0x2000;
    /// What was chosen for the bridge; only who it is.
    pub const CHOICES: u32 = 0x3000;
    /// Descriptors of each channel.
    pub const DESCRIPTORS: [u32; super::CHANNELS] = [0x4000, 0x5000];
    /// The table of message-signalled interrupts, and which of them are pending.
    pub const MESSAGE_TABLE: u32 = 0x8000;
    pub const PENDING: u32 = 0x8fe0;
    /// Bytes of a block.
    pub const BYTES: u32 = 0x1000;
}

/// Registers of a channel.
pub mod channel {
    pub const IDENTIFIER: u32 = 0x00;
    /// Written as it is, or ones in it are set or cleared.
    pub const CONTROL: u32 = 0x04;
    pub const CONTROL_SET: u32 = 0x08;
    pub const CONTROL_CLEAR: u32 = 0x0c;
    /// Ones that are written clear; from the second one, reading clears.
    pub const STATUS: u32 = 0x40;
    pub const STATUS_CLEAR: u32 = 0x44;
    /// Descriptors done since the run began.
    pub const COMPLETED: u32 = 0x48;
    pub const ALIGNMENTS: u32 = 0x4c;
    /// Which bits of the status ask for an interrupt.
    pub const MASK: u32 = 0x90;
    pub const MASK_SET: u32 = 0x94;
    pub const MASK_CLEAR: u32 = 0x98;
}

/// Registers of a channel's descriptors.
pub mod descriptors {
    pub const IDENTIFIER: u32 = 0x00;
    pub const LOW: u32 = 0x80;
    pub const HIGH: u32 = 0x84;
    /// Descriptors that lie right behind the first.
    pub const ADJACENT: u32 = 0x88;
}

/// Registers of interrupts.
pub mod interrupts {
    pub const IDENTIFIER: u32 = 0x00;
    pub const CHANNEL_MASK: u32 = 0x10;
    pub const CHANNEL_MASK_SET: u32 = 0x14;
    pub const CHANNEL_MASK_CLEAR: u32 = 0x18;
    /// Channels that ask, and those of them that may.
    pub const CHANNEL_REQUEST: u32 = 0x44;
    pub const CHANNEL_PENDING: u32 = 0x4c;
    /// The message of each channel, five bits in a byte.
    pub const CHANNEL_VECTORS: u32 = 0xa0;
}

/// Bits of a channel's status. In its control, the same bit lets the status have it, but for bit 0, which lets it run.
pub mod status {
    pub const BUSY: u32 = 1;
    pub const STOPPED: u32 = 1 << 1;
    pub const COMPLETED: u32 = 1 << 2;
    /// A descriptor without its letters.
    pub const MAGIC: u32 = 1 << 4;
    /// One whose length is no whole number of beats.
    pub const LENGTH: u32 = 1 << 5;
    pub const IDLE: u32 = 1 << 6;
    /// The host refused a read of data: "unsupported request".
    pub const READ: u32 = 1 << 9;
    /// It refused a write. The bridge's writes are posted, so a real one never hears of that; this one says it, so that a driver can.
    pub const WRITE: u32 = 1 << 14;
    /// It refused a read of a descriptor.
    pub const DESCRIPTOR: u32 = 1 << 19;
    /// All that can go wrong.
    pub const ERRORS: u32 = MAGIC | LENGTH | READ | WRITE | DESCRIPTOR;
    /// All but `BUSY`.
    pub const ALL: u32 = STOPPED | COMPLETED | IDLE | ERRORS;
}

/// Bit 0 of a channel's control.
pub const RUN: u32 = 1;

/// Messages that the bridge has.
pub const VECTORS: usize = 32;
/// Bytes of a message's entry in the table, and where in it the bit is that masks it.
pub const ENTRY_BYTES: u32 = 16;
pub const ENTRY_CONTROL: u32 = 12;
pub const ENTRY_MASKED: u32 = 1;

/// Configuration space.
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
    /// The capability of message-signalled interrupts, where it is, and what its control has.
    pub const MESSAGES: u8 = 0x11;
    pub const MESSAGES_AT: usize = 0x60;
    pub const MESSAGES_ENABLED: u16 = 1 << 15;
    pub const MESSAGES_MASKED: u16 = 1 << 14;
}
