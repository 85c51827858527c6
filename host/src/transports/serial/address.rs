//! Addresses of boards at a serial port: `serial:PORT?baud=N&slow=N`.

use std::fmt;

use incircle_protocol::FIRST_RATE;

use super::protocol::DEFAULT_RATE;
use crate::transports::choices::Choices;

/// Beginning of every address of a serial port.
const PREFIX: &str = "serial:";
/// Highest rate that may be asked for, in bits per second: more than any adapter reaches.
const MAX_RATE: u32 = 50_000_000;
/// Largest factor by which deadlines may be stretched.
const MAX_SLOW: u32 = 100_000;

/// The address of a board at a serial port, with the rate to use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address {
    /// Name of the port, such as `/dev/ttyUSB0` or `COM3`.
    pub port: String,
    /// Highest rate to try, in bits per second. Lower rates are tried if this one does not work.
    pub baud: u32,
    /// Factor by which the device is slower than a real board: 1, or more for a simulation of every pin.
    pub slow: u32,
}

impl Address {
    /// The address of a port with the default rate, for a real board.
    pub fn of_port(port: impl Into<String>) -> Self {
        Self { port: port.into(), baud: DEFAULT_RATE, slow: 1 }
    }

    /// Parses an address; `None` if it is the address of another kind of device.
    ///
    /// # Errors
    /// A sentence that does not repeat the address.
    pub fn parse(address: &str) -> Option<Result<Self, String>> {
        address.strip_prefix(PREFIX).map(Self::parse_port)
    }

    /// Parses the name of a port with choices behind a question mark: an address without `serial:`.
    ///
    /// # Errors
    /// A sentence that does not repeat the address.
    pub fn parse_port(text: &str) -> Result<Self, String> {
        let choices = Choices::of(text);
        let port = choices.name;
        if port.is_empty() {
            return Err("no port is named: write it as in \"serial:/dev/ttyUSB0\"".to_owned());
        }
        let mut address = Self::of_port(port);
        for choice in choices.items()? {
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
            "serial:x?slow=2&slow=3",
            "serial:x?parity=odd",
            "serial:x?baud",
        ] {
            let reason = Address::parse(bad).expect("serial").expect_err(bad);
            assert!(!reason.is_empty());
        }
    }
}
