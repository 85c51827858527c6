//! The parameters of simulated boards on a network, in a file that the build script reads too.

use std::net::Ipv4Addr;

use incircle_protocol::{Config, UdpLinkConfig, SMALL, UDP_PORT};

/// Address of a simulated board, the bits of its network, and the UDP port.
pub const ADDRESS: Ipv4Addr = Ipv4Addr::new(10, 0, 0, 7);
#[allow(dead_code, reason = "the build script needs it, the crate does not")]
pub const PREFIX: u8 = 24;
pub const PORT: u16 = UDP_PORT;

/// The link of a simulated board: that of a real board with a shorter silence, because the real silence would take
/// minutes to simulate.
pub const fn network_link(config: Config) -> UdpLinkConfig {
    let clock_hz = if config.points <= SMALL.points { 125_000_000 } else { 120_000_000 };
    UdpLinkConfig { clock_hz, fifo_bytes: 16_384, silence_ms: 200, mac: [0x02, 0, 0, 0x69, 0x43, 0x07] }
}
