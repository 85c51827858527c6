//! The card and the bridge before it: the register behind each address of the windows, and the passing of time.

use incircle_sim::pcie::Beats;
use vfio_bindings::bindings::vfio::VFIO_PCI_CONFIG_REGION_INDEX;

use super::channel::{Channel, Way};
use super::config_space::ConfigSpace;
use super::interrupts::Interrupts;
use super::memory::HostMemory;
use super::numbers::{block, ALL_ONES, CHANNELS, DMA_BAR, DMA_BYTES, USER_BAR, USER_BYTES};

/// Makes a card in the state after the reset of its bus.
pub type MakeCard = Box<dyn Fn() -> Box<dyn Beats> + Send>;

/// Identifier of the block that holds the bridge's choices.
const CHOICES_IDENTIFIER: u32 = 0x1fc3_0006;
/// Bytes of a register.
const WORD: usize = 4;

/// The device that a host sees.
pub struct Bridge {
    make: MakeCard,
    card: Box<dyn Beats>,
    config: ConfigSpace,
    channels: [Channel; CHANNELS],
    /// Message-signalled interrupts of the device.
    pub interrupts: Interrupts,
    /// Host memory that the device may reach.
    pub memory: HostMemory,
}

fn channels() -> [Channel; CHANNELS] {
    [Channel::new(Way::ToCard), Channel::new(Way::ToHost)]
}

impl Bridge {
    /// Makes a device around such a card.
    pub fn new(make: MakeCard) -> Self {
        Self {
            card: make(),
            make,
            config: ConfigSpace::new(),
            channels: channels(),
            interrupts: Interrupts::new(),
            memory: HostMemory::default(),
        }
    }

    /// Resets the device and, through `bus_reset_n`, the card's bus. Memory mappings and events of the host stay.
    pub fn reset(&mut self) {
        self.card = (self.make)();
        self.config = ConfigSpace::new();
        self.channels = channels();
        self.interrupts.reset();
    }

    /// Drops everything that belonged to a host that has gone.
    pub fn forget(&mut self) {
        self.reset();
        self.interrupts.forget();
        self.memory.clear();
    }

    /// Reads from a region. As on a bus, an address that nobody answers reads as all ones, and so does a read
    /// that the card answers with SLVERR.
    pub fn read(&mut self, region: u32, offset: u64, bytes: &mut [u8]) {
        if region == VFIO_PCI_CONFIG_REGION_INDEX {
            return self.config.read(offset, bytes);
        }
        let register = self.register(region, offset, bytes.len());
        let value = register.map_or(ALL_ONES, |offset| match region {
            USER_BAR => self.card.read(offset).unwrap_or(ALL_ONES),
            _ => self.read_dma(offset),
        });
        for (byte, value) in bytes.iter_mut().zip(value.to_le_bytes().into_iter().cycle()) {
            *byte = value;
        }
        self.deliver();
    }

    /// Writes to a region. A write that nobody takes is lost.
    pub fn write(&mut self, region: u32, offset: u64, bytes: &[u8]) {
        if region == VFIO_PCI_CONFIG_REGION_INDEX {
            self.config.write(offset, bytes);
            return self.deliver();
        }
        let register = self.register(region, offset, bytes.len());
        if let (Some(offset), &[a, b, c, d]) = (register, bytes) {
            let value = u32::from_le_bytes([a, b, c, d]);
            match region {
                USER_BAR => {
                    // A posted write has no answer, so a refusal by the card reaches nobody.
                    let _ = self.card.write(offset, value);
                }
                _ => self.write_dma(offset, value),
            }
        }
        self.deliver();
    }

    /// Returns the offset of a register in a window, or `None` if the window is closed or the
    /// access is not one aligned word.
    fn register(&self, region: u32, offset: u64, length: usize) -> Option<u32> {
        let bytes = match region {
            USER_BAR => USER_BYTES,
            DMA_BAR => DMA_BYTES,
            _ => return None,
        };
        let is_register = self.config.has_memory() && length == WORD && offset < bytes && offset.is_multiple_of(4);
        is_register.then(|| u32::try_from(offset).ok()).flatten()
    }

    fn read_dma(&mut self, offset: u32) -> u32 {
        let (at, register) = (offset / block::BYTES * block::BYTES, offset % block::BYTES);
        for (way, channel) in self.channels.iter_mut().enumerate() {
            if at == block::CHANNEL[way] {
                return channel.read(register);
            }
            if at == block::DESCRIPTORS[way] {
                return channel.read_descriptors(register);
            }
        }
        match at {
            block::INTERRUPTS => self.interrupts.read(register),
            block::CHOICES if register == 0 => CHOICES_IDENTIFIER,
            _ if offset == block::PENDING => self.interrupts.pending(),
            block::MESSAGE_TABLE => self.interrupts.read_table(register),
            _ => 0,
        }
    }

    fn write_dma(&mut self, offset: u32, value: u32) {
        let (at, register) = (offset / block::BYTES * block::BYTES, offset % block::BYTES);
        for (way, channel) in self.channels.iter_mut().enumerate() {
            if at == block::CHANNEL[way] {
                return channel.write(register, value);
            }
            if at == block::DESCRIPTORS[way] {
                return channel.write_descriptors(register, value);
            }
        }
        match at {
            block::INTERRUPTS => self.interrupts.write(register, value),
            block::MESSAGE_TABLE => self.interrupts.write_table(register, value),
            _ => {}
        }
    }

    /// Sends the messages that are due.
    pub fn deliver(&mut self) {
        let asks = self.channels.iter().enumerate().filter(|(_, channel)| channel.requests());
        let requests = asks.fold(0, |bits, (place, _)| bits | 1 << place);
        self.interrupts.deliver(requests, self.config.has_messages());
    }

    /// Lets a slice of time pass. Returns false if nothing changes until the host acts.
    pub fn step(&mut self) -> bool {
        let mut has_moved = false;
        if self.config.is_master() {
            for channel in &mut self.channels {
                has_moved |= channel.step(&mut *self.card, &self.memory);
            }
            self.deliver();
        }
        has_moved || self.card.run()
    }
}
