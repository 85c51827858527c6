//! The parameters of a device with a UDP link, and what may be wrong with them.

use crate::ethernet::types::Station;
use incircle_protocol::{
    ConfigError, LinkConfig, LinkConfigError, UdpLinkConfig, MAX_LINK_CLOCK_HZ, MIN_LINK_CLOCK_HZ, UDP_PORT,
};
use std::fmt;
use std::net::Ipv4Addr;

/// The parameters of a device with a UDP link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UdpParameters {
    /// Clock of the core, FIFO, silence and Ethernet address.
    pub link: UdpLinkConfig,
    /// IPv4 address of the device, and the number of bits of it that name its network, 8 to 30.
    pub address: Ipv4Addr,
    pub prefix: u8,
    /// UDP port at which the device listens, [`UDP_PORT`] unless another is chosen.
    pub port: u16,
}

/// Parameters with which no device with a UDP link can be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UdpError {
    /// A parameter of the core is out of range.
    Core(ConfigError),
    /// The size of the FIFO or the silence is out of range.
    Link(LinkConfigError),
    /// The clock of the core is out of range.
    Clock(u32),
    /// The Ethernet address is that of a group, or 0.
    Mac([u8; 6]),
    /// The IPv4 address is none that a device can have.
    Address(Ipv4Addr),
    /// The prefix is outside `8..=30`.
    Prefix(u8),
    /// The UDP port is 0.
    Port,
}

impl fmt::Display for UdpError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core(error) => error.fmt(f),
            Self::Link(error) => error.fmt(f),
            Self::Clock(given) => write!(
                f,
                "a core behind a UDP link cannot run at {given} Hz: choose {MIN_LINK_CLOCK_HZ} to {MAX_LINK_CLOCK_HZ} Hz"
            ),
            Self::Mac([a, b, c, d, e, g]) => write!(
                f,
                "no device can have the Ethernet address {a:02x}:{b:02x}:{c:02x}:{d:02x}:{e:02x}:{g:02x}: choose one \
                 with an even first byte that is not all 0, such as 02:00:00:69:43:01"
            ),
            Self::Address(given) => write!(
                f,
                "no device can have the IPv4 address {given}: choose one of your network, such as 192.168.1.50"
            ),
            Self::Prefix(given) => write!(f, "a network cannot have a prefix of {given} bits: choose 8 to 30"),
            Self::Port => write!(f, "a device cannot listen at UDP port 0: choose 1 to 65535, {UDP_PORT} as a rule"),
        }
    }
}

impl std::error::Error for UdpError {}

impl From<ConfigError> for UdpError {
    fn from(error: ConfigError) -> Self {
        Self::Core(error)
    }
}

impl From<LinkConfigError> for UdpError {
    fn from(error: LinkConfigError) -> Self {
        Self::Link(error)
    }
}

impl UdpParameters {
    /// Checks every parameter, and returns the parameters if all are valid.
    ///
    /// # Errors
    /// If one is out of range; the error says which one and what is possible.
    pub fn check(self) -> Result<Self, UdpError> {
        let Self { link, address, prefix, port } = self;
        times(link)?;
        if link.mac[0] & 1 == 1 || link.mac == [0; 6] {
            return Err(UdpError::Mac(link.mac));
        }
        if !(8..=30).contains(&prefix) {
            return Err(UdpError::Prefix(prefix));
        }
        let host_bits = u32::MAX >> prefix;
        let host = address.to_bits() & host_bits;
        // From 224 on there are groups, addresses that are kept back, and the broadcast address; no cable carries 127.
        let is_outside = matches!(address.octets()[0], 0 | 127 | 224..);
        if is_outside || host == 0 || host == host_bits {
            return Err(UdpError::Address(address));
        }
        if port == 0 {
            return Err(UdpError::Port);
        }
        Ok(self)
    }

    /// The broadcast address of the network.
    pub fn broadcast(self) -> Ipv4Addr {
        Ipv4Addr::from_bits(self.address.to_bits() | u32::MAX.checked_shr(self.prefix.into()).unwrap_or(0))
    }

    /// The addresses for the Ethernet port.
    pub(crate) fn station(self) -> Station {
        let [a, b, c, d, e, f] = self.link.mac;
        Station {
            mac: u64::from_be_bytes([0, 0, a, b, c, d, e, f]).into(),
            address: u64::from(self.address.to_bits()).into(),
            port: u64::from(self.port).into(),
            broadcast: u64::from(self.broadcast().to_bits()).into(),
        }
    }
}

/// Checks clock, FIFO and silence, and returns them in the form of the serial link, with which the UDP link shares its
/// timers.
///
/// # Errors
/// If one is out of range.
pub(super) fn times(link: UdpLinkConfig) -> Result<LinkConfig, UdpError> {
    let UdpLinkConfig { clock_hz, fifo_bytes, silence_ms, .. } = link;
    match (LinkConfig { clock_hz, fifo_bytes, silence_ms }).check() {
        Err(LinkConfigError::Clock(given)) => Err(UdpError::Clock(given)),
        checked => Ok(checked?),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINK: UdpLinkConfig =
        UdpLinkConfig { clock_hz: 125_000_000, fifo_bytes: 16_384, silence_ms: 2000, mac: [2, 0, 0, 0x69, 0x43, 1] };
    const DEVICE: UdpParameters =
        UdpParameters { link: LINK, address: Ipv4Addr::new(192, 168, 1, 50), prefix: 24, port: UDP_PORT };

    #[test]
    fn parameters_in_range_are_taken() {
        assert_eq!(DEVICE.check(), Ok(DEVICE));
        assert_eq!(DEVICE.broadcast(), Ipv4Addr::new(192, 168, 1, 255));
        assert_eq!(UdpParameters { prefix: 20, ..DEVICE }.broadcast(), Ipv4Addr::new(192, 168, 15, 255));
    }

    #[test]
    fn each_parameter_out_of_range_is_named() {
        let link = |link: UdpLinkConfig| UdpParameters { link, ..DEVICE }.check();
        assert_eq!(link(UdpLinkConfig { clock_hz: 7, ..LINK }), Err(UdpError::Clock(7)));
        assert_eq!(link(UdpLinkConfig { fifo_bytes: 7, ..LINK }), Err(UdpError::Link(LinkConfigError::Fifo(7))));
        assert_eq!(link(UdpLinkConfig { mac: [1; 6], ..LINK }), Err(UdpError::Mac([1; 6])));
        assert_eq!(link(UdpLinkConfig { mac: [0; 6], ..LINK }), Err(UdpError::Mac([0; 6])));
        let outside = [[224, 0, 0, 1], [240, 0, 0, 1], [255, 1, 0, 1], [127, 0, 0, 1], [0, 0, 0, 1]];
        for address in [[192, 168, 1, 0], [192, 168, 1, 255]].into_iter().chain(outside) {
            let address = Ipv4Addr::from(address);
            assert_eq!(UdpParameters { address, ..DEVICE }.check(), Err(UdpError::Address(address)));
        }
        assert_eq!(UdpParameters { prefix: 31, ..DEVICE }.check(), Err(UdpError::Prefix(31)));
        assert_eq!(UdpParameters { port: 0, ..DEVICE }.check(), Err(UdpError::Port));
        assert!(UdpError::Mac([1; 6]).to_string().contains("01:01:01:01:01:01"));
    }
}
