//! Addresses of serial devices: `serial:PORT?baud=N&slow=N`.

use std::fmt;

use incircle_protocol::FIRST_RATE;

use super::protocol::DEFAULT_RATE;
use crate::transports::choices::Choices;

/// Before the name of the port.
const PREFIX: &str = "serial:";
/// Highest rate that may be wished for: above what any adapter does.
const MAX_RATE: u32 = 50_000_000;
/// Most that deadlines are stretched.
const MAX_SLOW: u32 = 100_000;

/// Where a device is, and how it is talked to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address {
    /// Name of the port: `/dev/ttyUSB0`, `COM3`.
    pub port: String,
    /// Bits per second that are wished for; lower ones are taken where they cannot be had.
    pub baud: u32,
    /// How many times slower than real the device is: a simulation of every pin needs much more time than a board.
    pub slow: u32,
}

impl Address {
    /// A port with the usual choices.
    pub fn of_port(port: impl Into<String>) -> Self {
        Self { port: port.into(), baud: DEFAULT_RATE, slow: 1 }
    }

    /// Parses an address; `None` if it is of another kind.
    ///
    /// # Errors
    /// A sentence without the address.
    pub fn parse(address: &str) -> Option<Result<Self, String>> {
        address.strip_prefix(PREFIX).map(Self::parse_port)
    }

    /// Parses a port with choices behind a question mark.
    ///
    /// # Errors
    /// A sentence without the address.
    pub fn parse_port(text: &str) -> Result<Self, String> {
        let choices = Choices::of(text);
        let port = choices.name;
        if port.is_empty() {
            return Err("it names no port; \"serial:/dev/ttyUSB0\" would".to_owned());
        }
        let mut address = Self::of_port(port);
        for choice in choices.items() {
            match choice.key {
                "baud" => address.baud = choice.number(FIRST_RATE..=MAX_RATE)?,
                "slow" => address.slow = choice.number(1..=MAX_SLOW)?,
                _ => return Err(choice.unknown(&["baud", "slow"])),
            }
        }
        Ok(address)
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{PREFIX}{}", self.port)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_parsed() {
        assert_eq!(Address::parse("model"), None);
        assert_eq!(Address::parse("serial:/dev/ttyUSB0"), Some(Ok(Address::of_port("/dev/ttyUSB0"))));
        let all = Address { port: "COM3".to_owned(), baud: 12_000_000, slow: 40 };
        assert_eq!(Address::parse("serial:COM3?baud=12000000&slow=40"), Some(Ok(all)));
        for bad in [
            "serial:",
            "serial:?baud=115200",
            "serial:x?baud=9600",
            "serial:x?slow=0",
            "serial:x?parity=odd",
            "serial:x?baud",
        ] {
            let reason = Address::parse(bad).expect("serial").expect_err(bad);
            assert!(!reason.is_empty());
        }
    }
}
