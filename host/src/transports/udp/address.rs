//! Addresses of devices on a network.

use std::fmt;

use incircle_protocol::UDP_PORT;

/// Text in front of every address of a device on a network.
const PREFIX: &str = "udp:";

/// The address of a device on a network: `udp:HOST` or `udp:HOST:PORT`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UdpAddress {
    /// Name of the host, or its IPv4 address, such as `192.168.1.50`.
    pub host: String,
    /// UDP port, 26947 unless the text names another.
    pub port: u16,
}

impl UdpAddress {
    /// The address of the device at the usual port of this host.
    pub fn of_host(host: impl Into<String>) -> Self {
        Self { host: host.into(), port: UDP_PORT }
    }

    /// Parses an address; `None` if it is not that of a device on a network.
    ///
    /// # Errors
    /// A sentence that does not repeat the address.
    pub fn parse(address: &str) -> Option<Result<Self, String>> {
        address.strip_prefix(PREFIX).map(Self::parse_host)
    }

    fn parse_host(text: &str) -> Result<Self, String> {
        if text.starts_with('[') || text.matches(':').count() > 1 {
            return Err(
                "a device has an IPv4 address: write it as in \"udp:192.168.1.50\"; IPv6 is not served".to_owned()
            );
        }
        if text.contains('?') {
            return Err("an address on a network takes no choices behind a question mark".to_owned());
        }
        let (host, port) = text.split_once(':').map_or((text, None), |(host, port)| (host, Some(port)));
        if host.is_empty() {
            return Err("no host is named: write it as in \"udp:192.168.1.50\"".to_owned());
        }
        let Some(port) = port else { return Ok(Self::of_host(host)) };
        let parsed = port.parse().ok().filter(|&port: &u16| port != 0);
        let port = parsed.ok_or_else(|| format!("the port must be a whole number from 1 to 65535, not \"{port}\""))?;
        Ok(Self { host: host.to_owned(), port })
    }
}

impl fmt::Display for UdpAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{PREFIX}{}", self.host)?;
        match self.port {
            UDP_PORT => Ok(()),
            port => write!(f, ":{port}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_parsed() {
        assert_eq!(UdpAddress::parse("serial:x"), None);
        assert_eq!(UdpAddress::parse("udp:board"), Some(Ok(UdpAddress::of_host("board"))));
        let other = UdpAddress { host: "192.168.1.50".to_owned(), port: 9 };
        assert_eq!(UdpAddress::parse("udp:192.168.1.50:9"), Some(Ok(other)));
        for bad in ["udp:", "udp::9", "udp:x:0", "udp:x:65536", "udp:x:", "udp:x?slow=3", "udp:[::1]:9", "udp:fe80::1"]
        {
            let reason = UdpAddress::parse(bad).expect("udp").expect_err(bad);
            assert!(!reason.is_empty());
        }
    }
}
