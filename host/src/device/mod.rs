//! Devices: opened by address, or made around a transport.

use std::num::NonZeroU32;
use std::time::Duration;

use incircle_protocol::{Config, CORE_COORD_BITS, LARGE, MAX_COORD_BITS, MAX_MODEL_POINTS, MIN_COORD_BITS, NAMED};

use crate::commands::Link;
use crate::cpu::{self, CPU_NAME};
use crate::error::Error;
use crate::limit::Limit;
use crate::session::Session;
use crate::transports::clock::{ClockTransport, CLOCK_NAME};
use crate::transports::model::{ModelTransport, MODEL_NAME};
use crate::transports::pcie::{CardAddress, PcieTransport};
use crate::transports::serial::{Address, SerialTransport, LONGEST};
use crate::transports::Transport;

/// Time for the greeting unless chosen otherwise.
const GREETING_TIMEOUT: Duration = Duration::from_secs(15);
const _: () =
    assert!(GREETING_TIMEOUT.as_millis() > LONGEST.as_millis(), "a board on a bad line is found in this time");

/// Most threads of the engine in this process.
const MAX_THREADS: u32 = 256;

/// Something that triangulates: the engine in this process, an embedded software model, or what is behind a [`Transport`].
pub struct Device {
    engine: Engine,
}

/// What does the work.
enum Engine {
    /// The engine in this process, with so many threads.
    Cpu(u32),
    /// A device that is spoken to in words.
    Link(Box<Link>),
}

impl Device {
    /// Opens the device at `address`.
    ///
    /// - `cpu`: the fast engine in this process, with as many threads as there are processors. Coordinates up to 31 bits.
    /// - `cpu?threads=N`: the same with `N` threads at most.
    /// - `model`: the embedded software model with 16-bit coordinates. It takes memory as points arrive.
    /// - `model?coord-bits=B`: the same with `B` bits, 1 to 31.
    /// - `model?coord-bits=B&capacity=N`: a model that holds `N` points and no more.
    /// - `clock`: the core's model, clock by clock, in the configuration `large`. It gives the answers, records and cycle counts of
    ///   the core, some thousand times slower than `model`.
    /// - `clock?config=NAME`: the same in the configuration `tiny`, `small`, `full` or `large`.
    /// - `serial:PORT`: a board at a serial port, such as `serial:/dev/ttyUSB0`. Nothing is sent yet.
    /// - `serial:PORT?baud=B&slow=S`: the same at `B` bits per second (3,000,000 unless given), or less where that cannot be had, and with
    ///   all times of the link, and those that the library chooses, stretched `S` times for a simulated board.
    ///
    /// - `pcie:N`: the card `N` in a PCIe slot, at the driver XDMA. It is locked and reset.
    /// - `pcie:DIR`: the card whose three files are in a directory: `xdma0_h2c_0`, `xdma0_c2h_0` and `xdma0_user`.
    ///
    /// Other devices come through [`Device::from_transport`].
    ///
    /// # Errors
    /// [`Error::Address`] for an unknown address, [`Error::Port`] and [`Error::Card`] for a port or a card that cannot be opened,
    /// [`Error::Link`] for a card whose registers are not those of a sound one, and the errors of [`Device::model`].
    pub fn open(address: &str) -> Result<Self, Error> {
        match Choice::parse(address).map_err(|reason| Error::Address { address: address.to_owned(), reason })? {
            Choice::Cpu(threads) => Ok(Self::cpu(threads)),
            Choice::Model { coord_bits, capacity } => Self::model(coord_bits, capacity),
            Choice::Clock(config) => Self::clock_model(config),
            Choice::Serial(address) => Ok(Self::from_transport(Box::new(SerialTransport::open(&address)?))),
            Choice::Pcie(address) => Ok(Self::from_transport(Box::new(PcieTransport::open(&address)?))),
        }
    }

    /// The fast engine in this process: coordinates up to 31 bits, as many points as memory holds, and up to so many threads,
    /// which are its contexts; `None`: as many as there are processors. Small jobs take fewer. The order of the options is
    /// for devices that insert points one after the other; this one has its own.
    pub fn cpu(threads: Option<NonZeroU32>) -> Self {
        let processors = || std::thread::available_parallelism().map_or(1, usize::from);
        let threads = threads.map_or_else(|| u32::try_from(processors()).unwrap_or(MAX_THREADS), NonZeroU32::get);
        Self { engine: Engine::Cpu(threads.min(MAX_THREADS)) }
    }

    /// The software model for `capacity` points of `coord_bits` bits. It takes memory as points arrive.
    ///
    /// # Errors
    /// [`Error::CoordBits`] outside 1 to 31, [`Error::Model`] for a capacity below 4 or above 2^30 - 1, the most
    /// that record ids have room for.
    pub fn model(coord_bits: u32, capacity: u32) -> Result<Self, Error> {
        check_coord_bits(coord_bits)?;
        let transport = ModelTransport::new(coord_bits, capacity)?;
        Ok(Self::from_transport(Box::new(transport)))
    }

    /// The core's model, clock by clock: it gives the answers, records and cycle counts of the core of this configuration.
    ///
    /// # Errors
    /// [`Error::Model`] for a configuration that no core can be built with.
    pub fn clock_model(config: Config) -> Result<Self, Error> {
        Ok(Self::from_transport(Box::new(ClockTransport::new(config)?)))
    }

    /// The device behind a transport: a simulation, a board, a test double. Nothing is sent yet.
    pub fn from_transport(transport: Box<dyn Transport>) -> Self {
        Self { engine: Engine::Link(Box::new(Link::new(transport))) }
    }

    /// Greets the device and checks what it says of itself; gives it fifteen seconds, stretched for a simulation by its
    /// [`Pace`](crate::Pace).
    ///
    /// # Errors
    /// [`Error::Link`], [`Error::Timeout`], or [`Error::Device`] for one that is no incircle device, speaks another
    /// major version or an older minor one, or claims coordinate bits, a capacity or contexts that cannot be.
    pub fn session(&mut self) -> Result<Session<'_>, Error> {
        let slow = match &self.engine {
            Engine::Cpu(_) => 1,
            Engine::Link(link) => link.pace().slow,
        };
        self.session_within(GREETING_TIMEOUT.saturating_mul(slow))
    }

    /// As [`Device::session`], with another time for the greeting.
    ///
    /// # Errors
    /// As [`Device::session`].
    pub fn session_within(&mut self, timeout: Duration) -> Result<Session<'_>, Error> {
        match &mut self.engine {
            Engine::Cpu(threads) => Ok(Session::of_cpu(cpu::identity(*threads))),
            Engine::Link(link) => {
                let limit = Limit::of(timeout);
                let identity = match link.hello(limit) {
                    Err(error) if link.recover(&error, limit)? => link.hello(limit)?,
                    result => result?,
                };
                Ok(Session::new(link, identity))
            }
        }
    }
}

/// Coordinate bits must be possible.
pub(crate) fn check_coord_bits(coord_bits: u32) -> Result<(), Error> {
    if (MIN_COORD_BITS..=MAX_COORD_BITS).contains(&coord_bits) {
        Ok(())
    } else {
        Err(Error::CoordBits(coord_bits))
    }
}

/// What an address asks for.
#[derive(Debug, PartialEq, Eq)]
enum Choice {
    Cpu(Option<NonZeroU32>),
    Model { coord_bits: u32, capacity: u32 },
    Clock(Config),
    Serial(Address),
    Pcie(CardAddress),
}

impl Choice {
    /// Parses a name with choices behind a question mark; the error is a sentence without the address.
    fn parse(address: &str) -> Result<Self, String> {
        if let Some(serial) = Address::parse(address) {
            return serial.map(Self::Serial);
        }
        if let Some(card) = CardAddress::parse(address) {
            return card.map(Self::Pcie);
        }
        let (name, choices) = address.split_once('?').unwrap_or((address, ""));
        let items = choices.split('&').filter(|item| !item.is_empty());
        let items = items.map(|item| item.split_once('=').unwrap_or((item, "")));
        match name {
            CPU_NAME => Self::parse_cpu(items),
            MODEL_NAME => Self::parse_model(items),
            CLOCK_NAME => Self::parse_clock(items),
            _ => Err(
                "this library opens \"cpu\", \"model\", \"clock\", \"serial:PORT\" and \"pcie:N\" by name, other devices from a \
                 transport"
                    .to_owned(),
            ),
        }
    }

    fn parse_cpu<'a>(items: impl Iterator<Item = (&'a str, &'a str)>) -> Result<Self, String> {
        let mut threads = None;
        for (key, value) in items {
            if key != "threads" {
                return Err(format!("\"{key}\" is unknown; \"threads\" is known"));
            }
            let parsed = value.parse::<NonZeroU32>();
            threads = Some(parsed.map_err(|_| format!("\"{key}\" wants a whole number from 1 on, not \"{value}\""))?);
        }
        Ok(Self::Cpu(threads))
    }

    fn parse_model<'a>(items: impl Iterator<Item = (&'a str, &'a str)>) -> Result<Self, String> {
        let (mut coord_bits, mut capacity) = (CORE_COORD_BITS, MAX_MODEL_POINTS);
        for (key, value) in items {
            let number = || {
                let parsed = value.parse::<u32>();
                parsed.map_err(|_| format!("\"{key}\" wants a whole number, not \"{value}\""))
            };
            match key {
                "coord-bits" => coord_bits = number()?,
                "capacity" => capacity = number()?,
                _ => return Err(format!("\"{key}\" is unknown; \"coord-bits\" and \"capacity\" are known")),
            }
        }
        Ok(Self::Model { coord_bits, capacity })
    }

    fn parse_clock<'a>(items: impl Iterator<Item = (&'a str, &'a str)>) -> Result<Self, String> {
        let mut config = LARGE;
        for (key, value) in items {
            if key != "config" {
                return Err(format!("\"{key}\" is unknown; \"config\" is known"));
            }
            let named = Config::named(value);
            config = named.ok_or_else(|| {
                let names = NAMED.map(|config| config.name).join(", ");
                format!("there is no configuration \"{value}\"; there are {names}")
            })?;
        }
        Ok(Self::Clock(config))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn addresses_are_parsed() {
        let model = |coord_bits, capacity| Ok(Choice::Model { coord_bits, capacity });
        assert_eq!(Choice::parse("model"), model(16, MAX_MODEL_POINTS));
        assert_eq!(Choice::parse("model?coord-bits=20"), model(20, MAX_MODEL_POINTS));
        assert_eq!(Choice::parse("model?coord-bits=8&capacity=99"), model(8, 99));
        assert_eq!(Choice::parse("cpu"), Ok(Choice::Cpu(None)));
        assert_eq!(Choice::parse("cpu?threads=3"), Ok(Choice::Cpu(NonZeroU32::new(3))));
        assert_eq!(Choice::parse("clock"), Ok(Choice::Clock(LARGE)));
        for config in NAMED {
            assert_eq!(Choice::parse(&format!("clock?config={}", config.name)), Ok(Choice::Clock(config)));
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
            "pcie:/nowhere",
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
            let error = Device::open(address).err().expect(address);
            assert_eq!(error.kind(), ErrorKind::DeviceNotFound, "{error}");
            assert!(error.to_string().contains(address));
        }
        for bits in [0, 32] {
            let error = Device::model(bits, 8).err().expect("impossible bits");
            assert!(matches!(error, Error::CoordBits(given) if given == bits));
        }
    }

    #[test]
    fn a_model_that_is_made_also_greets() {
        for capacity in [4, MAX_MODEL_POINTS] {
            let mut device = Device::model(16, capacity).expect("possible");
            assert!(device.session().is_ok(), "{capacity}");
        }
        for capacity in [0, 3, MAX_MODEL_POINTS + 1, u32::MAX] {
            let error = Device::model(16, capacity).err().expect("impossible");
            assert!(matches!(error, Error::Model(_)), "{error}");
            assert!(error.to_string().contains(&capacity.to_string()), "{error}");
        }
    }
}
