//! Passes a core behind a UDP link through the gate, and keeps the size of port and link on an ECP5 in bounds.

use std::net::Ipv4Addr;

use incircle_hdl::export;
use incircle_hdl::top::{UdpPins, UDP_TOP_NAME};
use incircle_hdl::udp::UdpParameters;
use incircle_protocol::{Config, UdpLinkConfig, DUAL, SILENCE_MS, SMALL, TINY, UDP_PORT};
use incircle_testbench::gate::{self, Cells};

/// The link of a board.
const LINK: UdpLinkConfig = UdpLinkConfig {
    clock_hz: 125_000_000,
    fifo_bytes: 16_384,
    silence_ms: SILENCE_MS,
    mac: [0x02, 0x69, 0x6e, 0x43, 0x75, 0x01],
};
const DEVICE: UdpParameters =
    UdpParameters { link: LINK, address: Ipv4Addr::new(10, 0, 7, 2), prefix: 24, port: UDP_PORT };

/// Cells of port and link of a small core by Yosys 0.23.
const MEASURED: Cells =
    Cells { lut4: 2178, carry: 304, distributed_ram: 14, flip_flops: 1660, multipliers: 0, block_ram: 20 };

/// Largest number of look-up tables of four inputs for all that a board has beside its core, as yosys counts them:
/// without those in carry chains and in memory.
const MOST_TABLES: u64 = 2200;

#[test]
fn devices_with_a_udp_link_pass_lint_and_synthesis() {
    let rgmii = UdpPins::Rgmii { delay: 80, clock_delay: 80 };
    let devices: [(Config, UdpPins, bool); 4] =
        [(TINY, UdpPins::Gmii, true), (SMALL, UdpPins::Gmii, false), (SMALL, rgmii, false), (DUAL, rgmii, false)];
    for (config, pins, with_probe) in devices {
        let verilog = export::udp_top(config, DEVICE, pins, with_probe).unwrap();
        let passed = gate::pass(&verilog, UDP_TOP_NAME);
        assert!(passed.is_ok(), "{} with {pins:?}: {}", config.name, passed.unwrap_err());
    }
}

#[test]
fn a_device_with_runs_passes_lint_and_synthesis() {
    for pins in [UdpPins::Gmii, UdpPins::Rgmii { delay: 80, clock_delay: 80 }] {
        let passed = gate::pass(&export::udp_top_with_runs(SMALL, DEVICE, pins, false).unwrap(), UDP_TOP_NAME);
        assert!(passed.is_ok(), "{pins:?}: {}", passed.unwrap_err());
    }
}

#[test]
fn all_beside_the_core_is_small() {
    let verilog = export::udp_device(SMALL, DEVICE, "udp_device").unwrap();
    let cells = gate::cell_count(&verilog, "udp_device").unwrap();
    println!("Ethernet port and UDP link on ECP5: {cells:?}");
    assert!(cells.lut4 <= MOST_TABLES, "{} tables, more than {MOST_TABLES}", cells.lut4);
    // Eight hold the FIFO of commands and eight that of answers, four belong to the port.
    assert_eq!((cells.block_ram, cells.multipliers), (20, 0));
    assert_eq!(cells.check_near(&MEASURED), Ok(()));
}
