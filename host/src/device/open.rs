//! Opening devices, by address or around a transport.

use std::num::NonZeroU32;
use std::time::Duration;

use incircle_protocol::{Config, CORE_COORD_BITS, LARGE, MAX_MODEL_POINTS};

use super::address::DeviceAddress;
use super::backend::Backend;
use super::cpu_backend::CpuBackend;
use super::device_backend::DeviceBackend;
use super::session::Session;
use crate::error::Error;
use crate::limit::{check_coord_bits, Limit};
use crate::transports::pcie::PcieTransport;
use crate::transports::serial::{SerialTransport, LONGEST};
use crate::transports::udp::UdpTransport;
use crate::transports::{ClockTransport, ModelTransport, Transport};

/// Time limit for the greeting unless the caller sets another.
const GREETING_TIMEOUT: Duration = Duration::from_secs(15);
const _: () =
    assert!(GREETING_TIMEOUT.as_millis() > LONGEST.as_millis(), "a board on a bad line is found in this time");

/// Most threads of the CPU triangulator.
const MAX_THREADS: u32 = 256;

/// A carrier of jobs: the CPU triangulator, a model of the core, a board or a card.
///
/// Reach for a device when [`triangulate`](crate::triangulate) is not enough: for hardware, for several jobs, for
/// options, or for a report. Opening a device does not talk to it, except that a card is locked and reset;
/// [`session`](Self::session) greets the device, and all jobs go through the [`Session`].
///
/// ```
/// use incircle::{Config, Device};
///
/// let mut by_address = Device::open("clock?config=tiny")?;
/// let mut by_hand = Device::clock_model(Config::named("tiny").expect("a named configuration"))?;
/// assert_eq!(by_address.session()?.identity(), by_hand.session()?.identity());
/// # Ok::<(), incircle::Error>(())
/// ```
pub struct Device {
    backend: Box<dyn Backend>,
}

impl Device {
    /// Opens the device at an address, such as `cpu`, `clock?config=full` or `serial:/dev/ttyUSB0`.
    ///
    /// [`DeviceAddress`] lists all forms. For a device that has no address, see [`Device::from_transport`].
    ///
    /// # Errors
    /// [`Error::Address`] for text that is not an address, and the errors of [`Device::at`].
    pub fn open(address: &str) -> Result<Self, Error> {
        Self::at(&address.parse()?)
    }

    /// Opens the device at an address that is already parsed.
    ///
    /// Choices that the address leaves open are made here: a model has 16 coordinate bits and holds 2^30 - 1 points,
    /// and a core has the configuration `large`.
    ///
    /// # Errors
    /// [`Error::Open`] for a port or a card that cannot be opened, [`Error::Link`] for a card whose registers are not
    /// those of a sound one, [`Error::Address`] for `sim`, which is not part of the library, and
    /// the errors of [`Device::model`].
    pub fn at(address: &DeviceAddress) -> Result<Self, Error> {
        match address {
            &DeviceAddress::Cpu { threads } => Ok(Self::cpu(threads)),
            &DeviceAddress::Model { coord_bits, capacity } => {
                Self::model(coord_bits.unwrap_or(CORE_COORD_BITS), capacity.unwrap_or(MAX_MODEL_POINTS))
            }
            &DeviceAddress::Clock { config } => Self::clock_model(config.unwrap_or(LARGE)),
            DeviceAddress::Sim { .. } => Err(Error::Address {
                address: address.to_string(),
                reason:
                    "the simulated core is part of the command 'incircle', not of the library: use \"clock\", which \
                         gives the same answers and cycles, or make a device from a transport"
                        .to_owned(),
            }),
            DeviceAddress::Serial(address) => Ok(Self::from_transport(Box::new(SerialTransport::open(address)?))),
            DeviceAddress::Udp(address) => Ok(Self::from_transport(Box::new(UdpTransport::open(address)?))),
            DeviceAddress::Pcie(address) => Ok(Self::from_transport(Box::new(PcieTransport::open(address)?))),
        }
    }

    /// Makes a device of the CPU triangulator, the fastest without hardware.
    ///
    /// Points may be of any type that is a [`PlanePoint`](crate::PlanePoint). `threads` is an upper bound, from 1 to
    /// 256; `None` allows one thread a processor. Small jobs use fewer. In [`Identity`](crate::Identity) and
    /// [`Options::contexts`](crate::Options::contexts) the threads stand in the place of contexts.
    /// [`Options::order`](crate::Options::order) has no effect: the order of insertion is for devices that insert
    /// points one after the other.
    pub fn cpu(threads: Option<NonZeroU32>) -> Self {
        let processors = || std::thread::available_parallelism().map_or(1, usize::from);
        let threads = threads.map_or_else(|| u32::try_from(processors()).unwrap_or(MAX_THREADS), NonZeroU32::get);
        Self { backend: Box::new(CpuBackend { threads: threads.min(MAX_THREADS) }) }
    }

    /// Makes a device of the software model, for `capacity` points of `coord_bits` bits.
    ///
    /// Use it to test a program without hardware, or as a second opinion: the model runs the algorithm of the core, one
    /// insertion after the other. Memory grows as points arrive.
    ///
    /// # Errors
    /// [`Error::CoordBits`] outside 1 to 31, [`Error::Model`] for a capacity below 4 or above 2^30 - 1, the most that
    /// record ids have room for.
    pub fn model(coord_bits: u32, capacity: u32) -> Result<Self, Error> {
        check_coord_bits(coord_bits)?;
        let transport = ModelTransport::new(coord_bits, capacity)?;
        Ok(Self::from_transport(Box::new(transport)))
    }

    /// Makes a device of the core's model, clock by clock.
    ///
    /// Use it to learn what a core of this configuration would do: answers, records and cycle counts are the core's.
    /// The model is 20 to 50 times slower than [`Device::model`].
    ///
    /// # Errors
    /// [`Error::Model`] for a configuration that no core can be built with.
    pub fn clock_model(config: Config) -> Result<Self, Error> {
        Ok(Self::from_transport(Box::new(ClockTransport::new(config)?)))
    }

    /// Makes a device of a transport, such as a simulation, a board with a link of its own, or a test double.
    /// Nothing is sent yet.
    pub fn from_transport(transport: Box<dyn Transport>) -> Self {
        Self { backend: Box::new(DeviceBackend::new(transport)) }
    }

    /// Greets the device, checks its identity, and opens a session.
    ///
    /// The device has 15 seconds to answer; a simulation has more, by the factor of its
    /// [`Pace`](crate::transports::Pace). A device has one session at a time.
    ///
    /// # Errors
    /// [`Error::Link`] or [`Error::Timeout`] if the greeting fails, and [`Error::Device`] for a device that is not an
    /// incircle device, speaks another major version or an older minor version of the protocol, or claims an impossible
    /// number of coordinate bits, points or contexts.
    pub fn session(&mut self) -> Result<Session<'_>, Error> {
        self.session_within(GREETING_TIMEOUT.saturating_mul(self.backend.slow()))
    }

    /// Does what [`Device::session`] does, with another time limit for the greeting.
    ///
    /// # Errors
    /// The errors of [`Device::session`].
    pub fn session_within(&mut self, timeout: Duration) -> Result<Session<'_>, Error> {
        let identity = self.backend.greet(Limit::of(timeout))?;
        Ok(Session::new(&mut *self.backend, identity))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn what_cannot_be_opened_is_refused_with_a_reason() {
        for address in ["modem", "pcie:/nowhere", "sim", "sim?config=full"] {
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
    fn an_address_without_choices_opens_what_is_documented() {
        let mut device = Device::open("clock").expect("the clock model");
        let core = *device.session().expect("a session").identity();
        assert_eq!((core.capacity, core.ring_capacity, core.contexts), (LARGE.points, LARGE.ring, LARGE.contexts));
        assert_eq!(core.coord_bits, 16);
        let mut device = Device::open("model").expect("the model");
        let model = *device.session().expect("a session").identity();
        assert_eq!((model.coord_bits, model.capacity), (16, (1 << 30) - 1));
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
