//! Finds the parts of the device and switches them on: the windows by their sizes and by what they
//! answer, the messages among the capabilities.

use vfio_bindings::bindings::vfio::{VFIO_PCI_BAR5_REGION_INDEX, VFIO_PCI_CONFIG_REGION_INDEX};
use vfio_user::Client;

use super::error::DriverError;
use super::numbers::{
    block, channel, config, interrupts, status, ALL_ONES, CHANNELS, DEVICE, ENTRY_BYTES, ENTRY_CONTROL, VENDOR,
};

/// Two blocks of the bridge and the upper bits of their identifiers, by which the driver XDMA finds its window too.
const BLOCKS: [(u32, u32); 2] = [(block::INTERRUPTS, 0x1fc2), (block::CHOICES, 0x1fc3)];
/// Number of capabilities that fit into the configuration space.
const MOST_CAPABILITIES: usize = 48;

/// The parts of the device that the driver has found.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    pub user: u32,
    pub dma: u32,
    /// Offset of the capability of messages in the configuration space.
    messages: u64,
    /// Window and offset of the table of messages.
    table: (u32, u64),
}

/// Reads four bytes of a region. A card that is gone reads as all ones.
pub fn read(client: &mut Client, region: u32, offset: u64) -> u32 {
    let mut bytes = [0; 4];
    client.region_read(region, offset, &mut bytes).map_or(ALL_ONES, |()| u32::from_le_bytes(bytes))
}

/// Writes four bytes of a region. A write to a card that is gone does nothing.
pub fn write(client: &mut Client, region: u32, offset: u64, value: u32) {
    // As on a bus, a write that fails is lost; the next read shows it.
    let _ = client.region_write(region, offset, &value.to_le_bytes());
}

/// Reads four bytes of the configuration space.
pub fn read_config(client: &mut Client, offset: u64) -> u32 {
    read(client, VFIO_PCI_CONFIG_REGION_INDEX, offset)
}

/// Writes four bytes of the configuration space.
pub fn write_config(client: &mut Client, offset: u64, value: u32) {
    write(client, VFIO_PCI_CONFIG_REGION_INDEX, offset, value);
}

/// Finds the parts, by the configuration space and by what the windows answer.
///
/// # Errors
/// The device is another one, or lacks one of the parts.
pub fn find(client: &mut Client) -> Result<Places, DriverError> {
    let who = read_config(client, 0);
    let (vendor, device) = (who as u16, (who >> 16) as u16);
    if (vendor, device) != (VENDOR, DEVICE) {
        return Err(DriverError::Other { vendor, device });
    }
    let bars: Vec<(u32, u64)> = (0..=VFIO_PCI_BAR5_REGION_INDEX).map(|bar| (bar, bar_size(client, bar))).collect();
    // The windows have to answer before the bridge can be found among them.
    write_config(client, config::COMMAND as u64, config::COMMAND_MEMORY.into());
    let has_bridge = |client: &mut Client, bar, size| {
        size > u64::from(block::PENDING) && BLOCKS.iter().all(|&(at, who)| read(client, bar, at.into()) >> 16 == who)
    };
    let dma = bars.iter().find(|&&(bar, size)| has_bridge(client, bar, size));
    let &(dma, _) = dma.ok_or(DriverError::Lacks("window with the registers of AMD's bridge"))?;
    let user = bars.iter().find(|&&(bar, size)| bar != dma && size > 0);
    let &(user, _) = user.ok_or(DriverError::Lacks("window with registers of its own"))?;
    let messages = capability(client).ok_or(DriverError::Lacks("message-signalled interrupts"))?;
    let table = read_config(client, messages + 4);
    Ok(Places { user, dma, messages, table: (table & 7, u64::from(table & !7)) })
}

/// Size of a window: after a write of all ones to its address, only the bits above its size read as ones.
fn bar_size(client: &mut Client, bar: u32) -> u64 {
    let at = (config::BARS + 4 * bar as usize) as u64;
    let address = read_config(client, at);
    write_config(client, at, ALL_ONES);
    let bits = read_config(client, at) & !0xf;
    write_config(client, at, address);
    u64::from(bits.wrapping_neg())
}

/// Offset of the capability of messages, if there is one.
fn capability(client: &mut Client) -> Option<u64> {
    let mut at = u64::from(read_config(client, config::CAPABILITIES as u64) & 0xfc);
    for _ in 0..MOST_CAPABILITIES {
        if at == 0 {
            return None;
        }
        let head = read_config(client, at);
        if head as u8 == config::MESSAGES {
            return Some(at);
        }
        at = u64::from(head >> 8 & 0xfc);
    }
    None
}

/// Switches on what a reset switches off: the windows, DMA, messages, and the reports of each channel.
pub fn start(client: &mut Client, places: Places) {
    let switches = u32::from(config::COMMAND_MEMORY | config::COMMAND_MASTER);
    write_config(client, config::COMMAND as u64, switches);
    write_config(client, places.messages, u32::from(config::MESSAGES_ENABLED) << 16);
    let (table_bar, table) = places.table;
    for (vector, way) in (0..).zip(0..CHANNELS) {
        write(client, table_bar, table + u64::from(vector * ENTRY_BYTES + ENTRY_CONTROL), 0);
        write(client, places.dma, (block::CHANNEL[way] + channel::CONTROL).into(), status::ALL);
        let asks = status::STOPPED | status::COMPLETED | status::ERRORS;
        write(client, places.dma, (block::CHANNEL[way] + channel::MASK).into(), asks);
    }
    // Message 0 is for the channel to the card, message 1 for the channel to the host.
    write(client, places.dma, (block::INTERRUPTS + interrupts::CHANNEL_VECTORS).into(), 0x0100);
    write(client, places.dma, (block::INTERRUPTS + interrupts::CHANNEL_MASK_SET).into(), 3);
}
