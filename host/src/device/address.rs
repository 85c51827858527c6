//! Addresses of devices.

use std::fmt;
use std::num::NonZeroU32;
use std::str::FromStr;

use incircle_protocol::{Config, NAMED};

use crate::error::Error;
use crate::transports::choices::{Choice, Choices};
use crate::transports::pcie::CardAddress;
use crate::transports::serial;

/// Where a device is, or what it is to be: a name, and choices behind a question mark.
///
/// - `cpu`: the fast engine in this process, with as many threads as there are processors. Coordinates up to 31 bits.
/// - `cpu?threads=N`: the same with `N` threads at most.
/// - `model`: the embedded software model with 16-bit coordinates. It takes memory as points arrive.
/// - `model?coord-bits=B`: the same with `B` bits, 1 to 31.
/// - `model?coord-bits=B&capacity=N`: a model that holds `N` points and no more.
/// - `clock`: the core's model, clock by clock, in the configuration `large`. It gives the answers, records and cycle
///   counts of the core, some thousand times slower than `model`.
/// - `clock?config=NAME`: the same in the configuration `tiny`, `small`, `full` or `large`.
/// - `sim`, `sim?config=NAME`: the Verilog of the core in Verilator. The library itself cannot open it; the command
///   can, if it was built so.
/// - `serial:PORT`: a board at a serial port, such as `serial:/dev/ttyUSB0`. Nothing is sent yet.
/// - `serial:PORT?baud=B&slow=S`: the same at `B` bits per second (3,000,000 unless given), or less where that cannot
///   be had, and with all times of the link, and those that the library chooses, stretched `S` times for a simulated
///   board.
/// - `pcie:N`: the card `N` in a PCIe slot, at the driver XDMA. It is locked and reset.
/// - `pcie:DIR`: the card whose three files are in a directory: `xdma0_h2c_0`, `xdma0_c2h_0` and `xdma0_user`.
///
/// ```
/// use incircle::DeviceAddress;
///
/// let address: DeviceAddress = "clock?config=full".parse()?;
/// assert_eq!(address.to_string(), "clock?config=full");
/// assert!("clock?config=huge".parse::<DeviceAddress>().is_err());
/// # Ok::<(), incircle::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DeviceAddress {
    /// The engine in this process.
    Cpu {
        /// Most threads; `None`: as many as there are processors.
        threads: Option<NonZeroU32>,
    },
    /// The software model.
    Model {
        /// Bits of a coordinate; `None`: whoever opens it chooses.
        coord_bits: Option<u32>,
        /// Points it holds; `None`: whoever opens it chooses.
        capacity: Option<u32>,
    },
    /// The model of the core, clock by clock.
    Clock {
        /// Its configuration; `None`: whoever opens it chooses.
        config: Option<Config>,
    },
    /// The Verilog of the core.
    Sim {
        /// Its configuration; `None`: whoever opens it chooses.
        config: Option<Config>,
    },
    /// A board at a serial port.
    Serial(serial::Address),
    /// A card in a PCIe slot.
    Pcie(CardAddress),
}

impl DeviceAddress {
    /// The forms that an address has, for a list.
    pub const FORMS: [&'static str; 6] = ["cpu", "model", "clock", "sim", "serial:PORT", "pcie:N"];

    /// What stands before the choices: `cpu`, `model`, `clock`, `sim`, `serial` or `pcie`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Cpu { .. } => "cpu",
            Self::Model { .. } => "model",
            Self::Clock { .. } => "clock",
            Self::Sim { .. } => "sim",
            Self::Serial(_) => "serial",
            Self::Pcie(_) => "pcie",
        }
    }

    /// Parses an address; the error is a sentence without it.
    fn parse(text: &str) -> Result<Self, String> {
        if let Some(serial) = serial::Address::parse(text) {
            return serial.map(Self::Serial);
        }
        if let Some(card) = CardAddress::parse(text) {
            return card.map(Self::Pcie);
        }
        let choices = Choices::of(text);
        let mut address = match choices.name {
            "cpu" => Self::Cpu { threads: None },
            "model" => Self::Model { coord_bits: None, capacity: None },
            "clock" => Self::Clock { config: None },
            "sim" => Self::Sim { config: None },
            _ => {
                let forms = "there are 'cpu', 'model', 'clock', 'sim', 'serial:PORT', such as serial:/dev/ttyUSB0, \
                             and 'pcie:N', such as pcie:0";
                return Err(forms.to_owned());
            }
        };
        choices.items().try_for_each(|choice| address.choose(choice))?;
        Ok(address)
    }

    fn choose(&mut self, choice: Choice<'_>) -> Result<(), String> {
        const ANY: std::ops::RangeInclusive<u32> = 0..=u32::MAX;
        match (self, choice.key) {
            (Self::Cpu { threads }, "threads") => *threads = NonZeroU32::new(choice.number(1..=u32::MAX)?),
            (Self::Cpu { .. }, _) => return Err(choice.unknown(&["threads"])),
            (Self::Model { coord_bits, .. }, "coord-bits") => *coord_bits = Some(choice.number(ANY)?),
            (Self::Model { capacity, .. }, "capacity") => *capacity = Some(choice.number(ANY)?),
            (Self::Model { .. }, _) => return Err(choice.unknown(&["coord-bits", "capacity"])),
            (Self::Clock { config } | Self::Sim { config }, "config") => *config = Some(config_named(choice.value)?),
            (Self::Clock { .. } | Self::Sim { .. }, _) => return Err(choice.unknown(&["config"])),
            // Their own parsers have taken their choices.
            (Self::Serial(_) | Self::Pcie(_), _) => return Err(choice.unknown(&[])),
        }
        Ok(())
    }
}

fn config_named(name: &str) -> Result<Config, String> {
    Config::named(name).ok_or_else(|| {
        let names = NAMED.map(|config| config.name).join(", ");
        format!("there is no configuration \"{name}\"; there are {names}")
    })
}

impl FromStr for DeviceAddress {
    type Err = Error;

    /// # Errors
    /// [`Error::Address`], with what would be right.
    fn from_str(text: &str) -> Result<Self, Error> {
        Self::parse(text).map_err(|reason| Error::Address { address: text.to_owned(), reason })
    }
}

impl fmt::Display for DeviceAddress {
    /// The address as text. Of an address that was parsed the text gives the same again; others may hold what no text
    /// says, such as a configuration without a name.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut items = Vec::new();
        let mut add = |key: &str, value: Option<String>| items.extend(value.map(|value| format!("{key}={value}")));
        match self {
            Self::Cpu { threads } => add("threads", threads.map(|threads| threads.to_string())),
            Self::Model { coord_bits, capacity } => {
                add("coord-bits", coord_bits.map(|bits| bits.to_string()));
                add("capacity", capacity.map(|points| points.to_string()));
            }
            Self::Clock { config } | Self::Sim { config } => add("config", config.map(|config| config.name.to_owned())),
            Self::Serial(address) => {
                let usual = serial::Address::of_port("");
                add("baud", (address.baud != usual.baud).then(|| address.baud.to_string()));
                add("slow", (address.slow != usual.slow).then(|| address.slow.to_string()));
            }
            Self::Pcie(_) => {}
        }
        match self {
            Self::Serial(address) => write!(f, "{address}")?,
            Self::Pcie(address) => write!(f, "{address}")?,
            named => f.write_str(named.name())?,
        }
        match items.is_empty() {
            true => Ok(()),
            false => write!(f, "?{}", items.join("&")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use incircle_protocol::FULL;

    #[test]
    fn addresses_are_parsed_and_shown() {
        let model = |coord_bits, capacity| DeviceAddress::Model { coord_bits, capacity };
        let serial = serial::Address { port: "COM3".to_owned(), baud: 12_000_000, slow: 40 };
        for (text, address) in [
            ("model", model(None, None)),
            ("model?coord-bits=20", model(Some(20), None)),
            ("model?coord-bits=8&capacity=99", model(Some(8), Some(99))),
            ("cpu", DeviceAddress::Cpu { threads: None }),
            ("cpu?threads=3", DeviceAddress::Cpu { threads: NonZeroU32::new(3) }),
            ("clock", DeviceAddress::Clock { config: None }),
            ("clock?config=full", DeviceAddress::Clock { config: Some(FULL) }),
            ("sim?config=full", DeviceAddress::Sim { config: Some(FULL) }),
            ("serial:/dev/x", DeviceAddress::Serial(serial::Address::of_port("/dev/x"))),
            ("serial:COM3?baud=12000000&slow=40", DeviceAddress::Serial(serial)),
            ("pcie:1", DeviceAddress::Pcie(CardAddress::of_number(1))),
            ("pcie:/tmp/card", DeviceAddress::Pcie(CardAddress::in_directory("/tmp/card"))),
        ] {
            assert_eq!(text.parse::<DeviceAddress>().expect(text), address);
            assert_eq!(address.to_string(), text);
        }
        for config in NAMED {
            let text = format!("clock?config={}", config.name);
            assert_eq!(text.parse::<DeviceAddress>().expect("named"), DeviceAddress::Clock { config: Some(config) });
        }
    }

    #[test]
    fn bad_addresses_are_refused_with_a_reason() {
        for address in [
            "",
            "modem",
            "serial:",
            "serial:/dev/x?baud=1",
            "pcie:",
            "pcie:1000",
            "model?bits=3",
            "model?capacity=many",
            "model?capacity",
            "model?config=tiny",
            "clock?config=huge",
            "clock?config",
            "clock?capacity=8",
            "cpu?threads=0",
            "cpu?threads=many",
            "cpu?contexts=2",
        ] {
            let error = address.parse::<DeviceAddress>().expect_err(address);
            assert_eq!(error.kind(), ErrorKind::DeviceNotFound, "{error}");
            assert!(error.to_string().contains(address));
        }
    }
}
