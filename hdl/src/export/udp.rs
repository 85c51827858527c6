//! Exports devices with a UDP link, and parts of them.

use incircle_protocol::{Config, UdpLinkConfig, UDP_KEPT_WORDS};

use super::{connected, engines, on_large_stack, ExportError};
use crate::ethernet::{RgmiiIn, RgmiiOut};
use crate::top::{udp_wrapper, ChipParts, LivingCore, UdpPins, UdpTop, UDP_TOP_NAME};
use crate::udp::{UdpDevice, UdpLink, UdpParameters};

/// The Verilog of a block whose FIFO for answers has the size for a configuration ([`answer_pointer_bits`]), which is a
/// parameter of the block's type.
macro_rules! with_answers_of {
    ($config:expr, $block:ident::$new:ident($($argument:expr),*), $name:expr) => {
        match answer_pointer_bits($config) {
            8 => connected($block::<8>::$new($($argument),*)?, $name),
            12 => connected($block::<12>::$new($($argument),*)?, $name),
            13 => connected($block::<13>::$new($($argument),*)?, $name),
            _ => connected($block::<14>::$new($($argument),*)?, $name),
        }
    };
}

/// The whole Verilog of a core, or of a chip of several engines, behind a UDP link: the device, and around it the ANSI
/// wrapper [`UDP_TOP_NAME`](crate::top::UDP_TOP_NAME) with these pins of a PHY.
///
/// `with_probe` adds the write port of the triangle memory to the wrapper's ports, for simulation.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn udp_top(
    config: Config,
    parameters: UdpParameters,
    pins: UdpPins,
    with_probe: bool,
) -> Result<String, ExportError> {
    on_large_stack(|| {
        let [link, chip, device] = ["link", "engines", "logic"].map(|part| format!("{UDP_TOP_NAME}_{part}"));
        if config.engines > 1 {
            let parts = ChipParts { link: &link, chip: &chip, engines: config.engines, with_probe };
            let inside = udp_device(config, parameters, parts.link)? + &engines(config, parts.chip)?;
            return Ok(inside + &pin_blocks(pins)? + &parts.udp(pins));
        }
        let inside = with_answers_of!(config, UdpTop::new(config, parameters), &device)?;
        Ok(inside + &pin_blocks(pins)? + &udp_wrapper(&device, pins, with_probe))
    })
}

/// The whole Verilog of a core of one engine with runs behind a UDP link: the link, the core, and around them the ANSI
/// wrapper [`UDP_TOP_NAME`](crate::top::UDP_TOP_NAME) with these pins of a PHY.
///
/// `with_probe` adds the write port of the triangle memory to the wrapper's ports, for simulation.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn udp_top_with_runs(
    config: Config,
    parameters: UdpParameters,
    pins: UdpPins,
    with_probe: bool,
) -> Result<String, ExportError> {
    on_large_stack(|| {
        let names = [format!("{UDP_TOP_NAME}_link"), format!("{UDP_TOP_NAME}_core")];
        let parts = ChipParts { link: &names[0], chip: &names[1], engines: 1, with_probe };
        let core = connected(LivingCore::new(config)?, parts.chip)?;
        let link = with_answers_of!(config, UdpDevice::with_runs(config, parameters), parts.link)?;
        Ok(link + &core + &pin_blocks(pins)? + &parts.udp(pins))
    })
}

/// The Verilog of the blocks between the pins of a PHY and a device, which GMII needs none of.
fn pin_blocks(pins: UdpPins) -> Result<String, ExportError> {
    match pins {
        UdpPins::Gmii => Ok(String::new()),
        UdpPins::Rgmii { delay, clock_delay } => {
            let [rgmii_in, rgmii_out] = ["rgmii_in", "rgmii_out"].map(|part| format!("{UDP_TOP_NAME}_{part}"));
            Ok(connected(RgmiiIn::new(delay), &rgmii_in)? + &connected(RgmiiOut::new(clock_delay), &rgmii_out)?)
        }
    }
}

/// The Verilog of all that a device with a UDP link has beside its core, with the root module `name`.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn udp_device(config: Config, parameters: UdpParameters, name: &str) -> Result<String, ExportError> {
    with_answers_of!(config, UdpDevice::new(config, parameters), name)
}

/// Number of bits of a pointer of the FIFO between core and UDP link. The FIFO holds the mesh of all points of the
/// chip, three words a point and two words an entry, but [`UDP_KEPT_WORDS`] at most, the mesh of 5,400 points: more
/// block RAM is not left on the boards.
fn answer_pointer_bits(config: Config) -> usize {
    match config.points * config.engines {
        0..=64 => 8,
        65..=1024 => 12,
        1025..=2048 => 13,
        _ => const { (UDP_KEPT_WORDS / 2).ilog2() as usize + 1 },
    }
}

/// The Verilog of a UDP link alone, without its Ethernet port, with the root module `name`.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn udp_link(config: Config, link: UdpLinkConfig, name: &str) -> Result<String, ExportError> {
    connected(UdpLink::new(config, link)?, name)
}
