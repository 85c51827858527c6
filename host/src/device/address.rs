//! Addresses of devices, as text and as a type.

use std::fmt;
use std::num::NonZeroU32;
use std::str::FromStr;

use incircle_protocol::{Config, NAMED};

use crate::error::Error;
use crate::transports::choices::{Choice, Choices};
use crate::transports::pcie::CardAddress;
use crate::transports::serial;
use crate::transports::udp::UdpAddress;

/// The address of a device: a name and, behind a question mark, choices.
///
/// Programs that take an address from a command line or a file parse it into this type, to refuse a bad one before any
/// device is opened. [`Device::open`](crate::Device::open) takes the text itself.
///
/// | address | device | when |
/// |---|---|---|
/// | `cpu` | the CPU triangulator with a thread for each processor; takes all numbers | for speed |
/// | `cpu?threads=N` | the same with at most `N` threads | |
/// | `model` | the software model with 16-bit coordinates; memory grows as points arrive | to test without hardware |
/// | `model?coord-bits=B` | the same with `B` bits, 1 to 31 | |
/// | `model?coord-bits=B&capacity=N` | a model that holds at most `N` points | |
/// | `clock` | the core's model, clock by clock, in the configuration `large` | to learn a core's records and cycles |
/// | `clock?config=NAME` | the same in the configuration `tiny`, `small`, `full`, `large`, `dual` or `quad` | |
/// | `sim`, `sim?config=NAME` | the Verilog of the core in Verilator | to simulate the hardware itself |
/// | `sim?living=yes`, `sim?config=small&living=yes` | the same core with runs | for a mesh that lives |
/// | `serial:PORT` | a board at a serial port, such as `serial:/dev/ttyUSB0` | |
/// | `serial:PORT?baud=B&slow=S` | the same at `B` bits per second, with times stretched `S` times | |
/// | `udp:HOST`, `udp:HOST:PORT` | a device on the network, at UDP port 26947 unless another is named | |
/// | `pcie:N` | the card `N` in a PCIe slot, behind the driver XDMA | |
/// | `pcie:DIR` | the card whose files `xdma0_h2c_0`, `xdma0_c2h_0` and `xdma0_user` are in a directory | |
///
/// `clock` is 20 to 50 times slower than `model`. The library itself cannot open `sim`; the command `incircle` can, if
/// the command was built with the feature `sim`. Opening a serial port sends nothing; opening a card locks and resets
/// it. `baud` is 3,000,000 unless given, and less where the port cannot reach it. `slow` suits a simulated board: all
/// times of the link, and those that the library chooses, become `S` times as long.
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
    /// The CPU triangulator in this program.
    Cpu {
        /// Upper bound on the threads; `None` for one thread a processor.
        threads: Option<NonZeroU32>,
    },
    /// The software model in this program.
    Model {
        /// Bits of a coordinate, 1 to 31; `None` for the choice of whoever opens the model.
        coord_bits: Option<u32>,
        /// Points that the model holds; `None` for the choice of whoever opens the model.
        capacity: Option<u32>,
    },
    /// The model of the core, clock by clock.
    Clock {
        /// Configuration of the core; `None` for the choice of whoever opens the model.
        config: Option<Config>,
    },
    /// The Verilog of the core.
    Sim {
        /// Configuration of the core; `None` for the choice of whoever opens the simulation.
        config: Option<Config>,
        /// Whether the core has runs, for a mesh that lives; `None` for the choice of whoever opens the simulation.
        living: Option<bool>,
    },
    /// A board at a serial port.
    Serial(serial::Address),
    /// A device on a network.
    Udp(UdpAddress),
    /// A card in a PCIe slot.
    Pcie(CardAddress),
}

impl DeviceAddress {
    /// One form of address for each kind of device, for a list in a help text.
    pub const FORMS: [&'static str; 7] = ["cpu", "model", "clock", "sim", "serial:PORT", "udp:HOST", "pcie:N"];

    /// The kind of device: `cpu`, `model`, `clock`, `sim`, `serial`, `udp` or `pcie`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Cpu { .. } => "cpu",
            Self::Model { .. } => "model",
            Self::Clock { .. } => "clock",
            Self::Sim { .. } => "sim",
            Self::Serial(_) => "serial",
            Self::Udp(_) => "udp",
            Self::Pcie(_) => "pcie",
        }
    }

    /// Parses an address. The error is a sentence that does not repeat the address.
    fn parse(text: &str) -> Result<Self, String> {
        if let Some(serial) = serial::Address::parse(text) {
            return serial.map(Self::Serial);
        }
        if let Some(device) = UdpAddress::parse(text) {
            return device.map(Self::Udp);
        }
        if let Some(card) = CardAddress::parse(text) {
            return card.map(Self::Pcie);
        }
        let choices = Choices::of(text);
        let mut address = match choices.name {
            "cpu" => Self::Cpu { threads: None },
            "model" => Self::Model { coord_bits: None, capacity: None },
            "clock" => Self::Clock { config: None },
            "sim" => Self::Sim { config: None, living: None },
            _ => {
                let forms = "there are 'cpu', 'model', 'clock', 'sim', 'serial:PORT', such as serial:/dev/ttyUSB0, \
                             'udp:HOST', such as udp:192.168.1.50, and 'pcie:N', such as pcie:0";
                return Err(forms.to_owned());
            }
        };
        choices.items()?.into_iter().try_for_each(|choice| address.choose(choice))?;
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
            (Self::Clock { config } | Self::Sim { config, .. }, "config") => {
                *config = Some(config_named(choice.value)?)
            }
            (Self::Clock { .. }, _) => return Err(choice.unknown(&["config"])),
            (Self::Sim { living, .. }, "living") => *living = Some(choice.yes()?),
            (Self::Sim { .. }, _) => return Err(choice.unknown(&["config", "living"])),
            // `parse` has returned before this point: the parsers of these take their own choices.
            (Self::Serial(_) | Self::Udp(_) | Self::Pcie(_), _) => return Err(choice.unknown(&[])),
        }
        Ok(())
    }
}

fn config_named(name: &str) -> Result<Config, String> {
    Config::named(name).ok_or_else(|| {
        let names = NAMED.map(|config| config.name).join(", ");
        format!("there is no configuration \"{name}\": choose one of {names}")
    })
}

impl FromStr for DeviceAddress {
    type Err = Error;

    /// # Errors
    /// [`Error::Address`], with the reason and what would be right.
    fn from_str(text: &str) -> Result<Self, Error> {
        Self::parse(text).map_err(|reason| Error::Address { address: text.to_owned(), reason })
    }
}

impl fmt::Display for DeviceAddress {
    /// Writes the address as text. Parsing that text gives a parsed address back; an address that a program put
    /// together may hold what no text can say, such as a configuration without a name.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut items = Vec::new();
        let mut add = |key: &str, value: Option<String>| items.extend(value.map(|value| format!("{key}={value}")));
        match self {
            Self::Cpu { threads } => add("threads", threads.map(|threads| threads.to_string())),
            Self::Model { coord_bits, capacity } => {
                add("coord-bits", coord_bits.map(|bits| bits.to_string()));
                add("capacity", capacity.map(|points| points.to_string()));
            }
            Self::Clock { config } => add("config", config.map(|config| config.name.to_owned())),
            Self::Sim { config, living } => {
                add("config", config.map(|config| config.name.to_owned()));
                add("living", living.map(|is_living| if is_living { "yes" } else { "no" }.to_owned()));
            }
            Self::Serial(address) => {
                let usual = serial::Address::of_port("");
                add("baud", (address.baud != usual.baud).then(|| address.baud.to_string()));
                add("slow", (address.slow != usual.slow).then(|| address.slow.to_string()));
            }
            Self::Udp(_) | Self::Pcie(_) => {}
        }
        match self {
            Self::Serial(address) => write!(f, "{address}")?,
            Self::Udp(address) => write!(f, "{address}")?,
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
            ("sim?config=full", DeviceAddress::Sim { config: Some(FULL), living: None }),
            ("sim?living=no", DeviceAddress::Sim { config: None, living: Some(false) }),
            ("sim?config=full&living=yes", DeviceAddress::Sim { config: Some(FULL), living: Some(true) }),
            ("serial:/dev/x", DeviceAddress::Serial(serial::Address::of_port("/dev/x"))),
            ("serial:COM3?baud=12000000&slow=40", DeviceAddress::Serial(serial)),
            ("udp:192.168.1.50", DeviceAddress::Udp(UdpAddress::of_host("192.168.1.50"))),
            ("udp:board:9", DeviceAddress::Udp(UdpAddress { host: "board".to_owned(), port: 9 })),
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
            "udp:",
            "udp:[::1]:9",
            "udp:board:none",
            "pcie:1000",
            "model?bits=3",
            "model?capacity=many",
            "model?capacity",
            "model?capacity=9&capacity=9",
            "clock?config=full&config=quad",
            "model?config=tiny",
            "clock?config=huge",
            "clock?config",
            "clock?capacity=8",
            "clock?living=yes",
            "sim?living",
            "sim?living=maybe",
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
