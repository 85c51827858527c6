//! The outermost module of the core behind a UDP link, `incircle_udp_top`, with the pins of RGMII or of GMII:
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `core_clock`, `reset` | in | 1 | clock of the core; reset, active high, needed once for 4 clocks |
//! | `leds` | out | 3 | alive, busy, error, from bit 0 up |
//! | `rx_clock`, `rx_ctl`, `rxd` | in | 1, 1, 4 | RGMII: clock of the PHY, 125 MHz, and its data at both edges |
//! | `tx_clock`, `tx_ctl`, `txd` | out | 1, 1, 4 | RGMII: the same to the PHY |
//! | `port_clock` | in | 1 | GMII: clock of the PHY, 125 MHz, for both directions |
//! | `rx_valid`, `rx_error`, `rx_data` | in | 1, 1, 8 | GMII: `rx_dv`, `rx_er`, `rxd` |
//! | `tx_valid`, `tx_data` | out | 1, 8 | GMII: `tx_en`, `txd` |
//!
//! RGMII is for boards, GMII for simulation. With the probe the module has the write port of the triangle memory as
//! well, as those of the other devices.

use super::wrapper::{connections, link_side, module, ChipParts, Ports, Probe};

/// Name of the module of a core behind a UDP link.
pub const UDP_TOP_NAME: &str = "incircle_udp_top";

/// The pins that lead to the PHY.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UdpPins {
    /// A byte a clock, for simulation.
    Gmii,
    /// Half a byte at each edge of the clock, for boards.
    Rgmii {
        /// Taps of 25 ps, 0 to 127, by which an ECP5 delays the data that comes.
        delay: u8,
        /// Taps, 0 to 127, by which an ECP5 delays the clock to the PHY.
        clock_delay: u8,
    },
}

const GMII: [(&str, &str, usize); 9] = [
    ("input", "port_clock", 1),
    ("input", "core_clock", 1),
    ("input", "reset", 1),
    ("input", "rx_valid", 1),
    ("input", "rx_error", 1),
    ("input", "rx_data", 8),
    ("output", "tx_valid", 1),
    ("output", "tx_data", 8),
    ("output", "leds", 3),
];

const RGMII: [(&str, &str, usize); 9] = [
    ("input", "rx_clock", 1),
    ("input", "core_clock", 1),
    ("input", "reset", 1),
    ("input", "rx_ctl", 1),
    ("input", "rxd", 4),
    ("output", "tx_clock", 1),
    ("output", "tx_ctl", 1),
    ("output", "txd", 4),
    ("output", "leds", 3),
];

impl UdpPins {
    fn ports(self) -> Ports<'static> {
        match self {
            Self::Gmii => &GMII,
            Self::Rgmii { .. } => &RGMII,
        }
    }

    /// The Verilog between the pins and the device, whose ports are those of GMII.
    fn inside(self) -> String {
        match self {
            Self::Gmii => String::new(),
            Self::Rgmii { .. } => format!(
                "    wire port_clock = rx_clock;\n    wire rx_valid;\n    wire rx_error;\n    wire [7:0] rx_data;\n    \
                 wire tx_valid;\n    wire [7:0] tx_data;\n    {UDP_TOP_NAME}_rgmii_in pins_in (\n        \
                 .clock(rx_clock),\n        .control(rx_ctl),\n        .pins(rxd),\n        \
                 .data_valid(rx_valid),\n        .data_error(rx_error),\n        .data(rx_data)\n    );\n    \
                 {UDP_TOP_NAME}_rgmii_out pins_out (\n        .clock(rx_clock),\n        \
                 .data_valid(tx_valid),\n        .data(tx_data),\n        .clock_pin(tx_clock),\n        \
                 .control(tx_ctl),\n        .pins(txd)\n    );\n"
            ),
        }
    }
}

/// The Verilog of the wrapper around the root module `device` of a core behind a UDP link.
pub fn udp_wrapper(device: &str, pins: UdpPins, with_probe: bool) -> String {
    let probe = Probe { engines: 1, is_shown: with_probe };
    let instance = format!("    {device} device (\n{}{}\n    );\n", connections(&GMII), probe.connections());
    module(UDP_TOP_NAME, pins.ports(), probe, &(probe.inside() + &pins.inside() + &instance))
}

impl ChipParts<'_> {
    /// The Verilog of the outermost module of a chip behind a UDP link.
    pub fn udp(self, pins: UdpPins) -> String {
        let link = format!("    {} link (\n{}{}\n    );\n", self.link, connections(&GMII), link_side());
        let inside = pins.inside() + &self.engines("core_clock") + &link;
        module(UDP_TOP_NAME, pins.ports(), self.probe(), &inside)
    }
}
