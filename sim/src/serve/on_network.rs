//! Devices that can be put on a network: the software model of the link, around that of the core or around the
//! Verilated core with runs, and a board at the pins of its PHY, which needs time for each clock.

use std::net::SocketAddrV4;

use incircle_model::serial::{Instantly, WordDevice};
use incircle_model::udp::UdpModel;
use incircle_model::ModelError;
use incircle_protocol::{Config, Identity, UdpLinkConfig, SILENCE_MS};

use crate::error::SimError;
use crate::network::NetworkBoard;
use crate::serial::StreamCore;

/// Clock of the core that the greeting of the software model names.
const CLOCK_HZ: u32 = 120_000_000;
/// Bytes of the FIFO that the greeting of the software model names.
const FIFO_BYTES: u32 = 16_384;
/// Number of clocks between two looks at the answers of the software model of a core.
const SLICE: u64 = 4096;
/// The same of the Verilated core, whose clocks take real time. It goes on to the end of the slice behind an answer.
const VERILATED_SLICE: u64 = 256;
/// Most slices, or turns, before the network is looked at again.
const BURST: usize = 64;
/// Nanoseconds of a board's time between two looks at the network: about as long as a long datagram takes on the wire.
const SLICE_NS: u64 = 16_000;

/// A device between datagrams.
pub(super) trait OnNetwork {
    /// Takes a datagram that came from this address.
    fn take(&mut self, from: SocketAddrV4, datagram: &[u8]);

    /// Whether the device may be given another datagram. Without room, datagrams wait in the socket, and the system
    /// drops those beyond its limit.
    fn has_room(&self) -> bool;

    /// The next datagram for a host, and the address that it goes to.
    fn give(&mut self) -> Option<(SocketAddrV4, Vec<u8>)>;

    /// Works for a while.
    fn work(&mut self);

    /// Whether there is something to do.
    fn is_at_work(&self) -> bool;

    /// The number of times that the device may work before the network is looked at again.
    fn burst(&self) -> usize;

    /// Lets this much real time pass, in nanoseconds since the start.
    fn age(&mut self, now: u64);
}

/// The software model of the link around a core. Its silence passes in real time.
pub(super) struct FastDevice<D> {
    model: UdpModel<D>,
    /// Number of clocks between two looks at the answers of the core.
    slice: u64,
    /// Clocks by which the silence has grown.
    aged: u64,
}

impl FastDevice<Instantly> {
    /// The model of a core of this configuration. `port` makes its Ethernet address its own.
    pub(super) fn new(config: Config, port: u16) -> Result<Self, ModelError> {
        let core = Instantly::of(config)?;
        Ok(Self::around(core.identity(), core, SLICE, port))
    }
}

impl FastDevice<StreamCore> {
    /// The Verilated core with runs of this configuration. `port` makes the Ethernet address of the device its own.
    pub(super) fn living(config: Config, port: u16) -> Result<Self, SimError> {
        let core = StreamCore::new(config, true)?;
        Ok(Self::around(StreamCore::identity(config, true), core, VERILATED_SLICE, port))
    }
}

impl<D: WordDevice> FastDevice<D> {
    fn around(identity: Identity, core: D, slice: u64, port: u16) -> Self {
        let [high, low] = port.to_be_bytes();
        let mac = [2, 0, 0x69, 0x43, high, low];
        let link = UdpLinkConfig { clock_hz: CLOCK_HZ, fifo_bytes: FIFO_BYTES, silence_ms: SILENCE_MS, mac };
        Self { model: UdpModel::new(link, identity, core), slice, aged: 0 }
    }
}

impl<D: WordDevice> OnNetwork for FastDevice<D> {
    fn take(&mut self, from: SocketAddrV4, datagram: &[u8]) {
        self.model.take(from, false, datagram);
    }

    fn has_room(&self) -> bool {
        true
    }

    fn give(&mut self) -> Option<(SocketAddrV4, Vec<u8>)> {
        self.model.give()
    }

    fn work(&mut self) {
        self.model.work(self.slice);
    }

    fn is_at_work(&self) -> bool {
        self.model.is_at_work()
    }

    fn burst(&self) -> usize {
        BURST
    }

    fn age(&mut self, now: u64) {
        let clocks = now * u64::from(CLOCK_HZ / 1_000_000) / 1000;
        self.model.age(clocks - self.aged);
        self.aged = clocks;
    }
}

/// A board lives in its own time, which is slower than real time.
impl OnNetwork for NetworkBoard {
    fn take(&mut self, from: SocketAddrV4, datagram: &[u8]) {
        self.send(from, false, datagram);
    }

    fn has_room(&self) -> bool {
        Self::has_room(self)
    }

    fn give(&mut self) -> Option<(SocketAddrV4, Vec<u8>)> {
        self.receive()
    }

    fn work(&mut self) {
        self.run(SLICE_NS);
    }

    fn is_at_work(&self) -> bool {
        !self.is_at_rest()
    }

    fn burst(&self) -> usize {
        1
    }

    fn age(&mut self, _now: u64) {}
}
