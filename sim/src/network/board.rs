//! A board on a network: the Verilated `incircle_udp_top`, with the pins of its PHY driven and sampled byte by byte.

use std::collections::VecDeque;
use std::net::{Ipv4Addr, SocketAddrV4};

use incircle_protocol::{Config, UdpLinkConfig};
use verilated::{Model, ModelDescription, PortId};

use super::frame::{datagram_of, frame_of, framed, on_cable};
use super::parameters::{network_link, ADDRESS, PORT};
use crate::device::{built, find};
use crate::error::SimError;

/// Picoseconds of a clock of the PHY.
const PORT_PS: u64 = 8_000;
/// Clocks of a gap between frames.
const GAP: usize = 12;
/// Clocks for which the reset is held, and after which a board has cleared its memories.
const RESET_CLOCKS: u64 = 32;
const SETTLING: u64 = 20_000;
/// Number of clocks for which the cable may be taken before no more should be sent: 43 of the longest frames.
const MOST_WAITING: usize = 1 << 16;
/// Clocks of the PHY, beyond the silence, after which a board on a silent cable has nothing to say any more.
const QUIET: u64 = 20_000;

/// A board at the pins of its PHY. Every clock is simulated.
#[derive(Debug)]
pub struct NetworkBoard {
    link: UdpLinkConfig,
    model: Model,
    ports: Ports,
    /// Picoseconds of a clock of the core.
    core_ps: u64,
    /// Time of the next edge of the port's clock and of the core's, in picoseconds.
    next: [u64; 2],
    /// The bytes that the PHY gives in the coming clocks, or `None` for a gap.
    wire: VecDeque<Option<u8>>,
    /// The bytes of the frame that the board is sending.
    line: Vec<u8>,
    /// Frames that the board has sent, with preamble and check sum.
    sent: VecDeque<Vec<u8>>,
    /// Clocks of the PHY since something was on the cable.
    quiet: u64,
}

/// Prefixes that the build script puts before the name of a configuration, without and with runs.
const NETWORK: &str = "network_";
const LIVING: &str = "living_network_";

#[derive(Clone, Copy, Debug)]
struct Ports {
    port_clock: PortId,
    core_clock: PortId,
    reset: PortId,
    rx_valid: PortId,
    rx_error: PortId,
    rx_data: PortId,
    tx_valid: PortId,
    tx_data: PortId,
}

impl NetworkBoard {
    /// A board with the core of this configuration and the link of [`network_link`](super::network_link).
    ///
    /// # Errors
    /// The board is not part of this build.
    pub fn new(config: Config) -> Result<Self, SimError> {
        Self::at_clock(config, network_link(config).clock_hz)
    }

    /// A board whose core has a clock of its own, in Hz. The board still counts its silence in clocks of
    /// [`network_link`](super::network_link), so a faster clock makes the silence shorter.
    ///
    /// # Errors
    /// The board is not part of this build.
    pub fn at_clock(config: Config, clock_hz: u32) -> Result<Self, SimError> {
        let missing = || SimError::NoBoard { name: config.name, built: built(NETWORK).join(", ") };
        Self::of(find(NETWORK, config).ok_or_else(missing)?, config, clock_hz)
    }

    /// A board with the core with runs of this configuration, and the same link.
    ///
    /// # Errors
    /// [`SimError::NoRuns`]: boards of this configuration with runs were not translated when this crate was built.
    pub fn living(config: Config) -> Result<Self, SimError> {
        let missing = || SimError::NoRuns { name: config.name, built: built(LIVING).join(", ") };
        Self::of(find(LIVING, config).ok_or_else(missing)?, config, network_link(config).clock_hz)
    }

    fn of(description: &'static ModelDescription, config: Config, clock_hz: u32) -> Result<Self, SimError> {
        let model = Model::new(description);
        let ports = Ports {
            port_clock: model.port("port_clock")?,
            core_clock: model.port("core_clock")?,
            reset: model.port("reset")?,
            rx_valid: model.port("rx_valid")?,
            rx_error: model.port("rx_error")?,
            rx_data: model.port("rx_data")?,
            tx_valid: model.port("tx_valid")?,
            tx_data: model.port("tx_data")?,
        };
        let link = network_link(config);
        let mut board = Self {
            link,
            model,
            ports,
            core_ps: 1_000_000_000_000 / u64::from(clock_hz.max(1)),
            next: [0, 0],
            wire: VecDeque::new(),
            line: Vec::new(),
            sent: VecDeque::new(),
            quiet: 0,
        };
        board.press_reset();
        Ok(board)
    }

    /// Presses the reset for as long as both clocks need, and waits until the memories are cleared.
    fn press_reset(&mut self) {
        self.model.set(self.ports.reset, 1);
        self.model.set(self.ports.rx_error, 0);
        self.run(RESET_CLOCKS * self.core_ps.max(PORT_PS) / 1000);
        self.model.set(self.ports.reset, 0);
        self.run(SETTLING * self.core_ps / 1000);
        self.line.clear();
        self.sent.clear();
        // After a reset no session is open, so no silence must pass before the board is at rest.
        self.quiet = self.rests_after() + 1;
    }

    /// Clocks of the PHY after which a board on a silent cable has nothing to say any more.
    fn rests_after(&self) -> u64 {
        u64::from(self.link.silence_ms) * 1_000_000_000 / PORT_PS + QUIET
    }

    /// Parameters of the link.
    pub fn link(&self) -> UdpLinkConfig {
        self.link
    }

    /// Nanoseconds since the board was made.
    pub fn now(&self) -> u64 {
        self.next[0] / 1000
    }

    /// Puts a datagram of a host on the cable, behind those that wait for it. `is_broadcast` sends it to all devices.
    pub fn send(&mut self, from: SocketAddrV4, is_broadcast: bool, datagram: &[u8]) {
        let (to, mac) = if is_broadcast {
            (SocketAddrV4::new(Ipv4Addr::BROADCAST, PORT), [0xff; 6])
        } else {
            (SocketAddrV4::new(ADDRESS, PORT), self.link.mac)
        };
        self.send_frame(&framed(from, to, mac, datagram));
    }

    /// Puts a sound frame on the cable; `frame` has neither preamble nor check sum.
    pub fn send_sound_frame(&mut self, frame: &[u8]) {
        self.send_frame(&on_cable(frame));
    }

    /// Puts the bytes of any frame on the cable, with its preamble and its check sum.
    pub fn send_frame(&mut self, bytes: &[u8]) {
        self.wire.extend(bytes.iter().map(|byte| Some(*byte)));
        self.wire.extend([None; GAP]);
    }

    /// Number of clocks for which the cable to the board is taken.
    pub fn waiting(&self) -> usize {
        self.wire.len()
    }

    /// Whether more should be sent now. The board keeps whatever is sent, so a sender that does not ask fills memory.
    pub fn has_room(&self) -> bool {
        self.waiting() < MOST_WAITING
    }

    /// Takes the next datagram of the board, and the address to which it goes. Other frames before it are dropped.
    pub fn receive(&mut self) -> Option<(SocketAddrV4, Vec<u8>)> {
        loop {
            let datagram = datagram_of(&self.sent.pop_front()?);
            if datagram.is_some() {
                return datagram;
            }
        }
    }

    /// Takes the next sound frame of the board, of any kind, without preamble and check sum.
    pub fn receive_frame(&mut self) -> Option<Vec<u8>> {
        loop {
            let line = self.sent.pop_front()?;
            if let Some(frame) = frame_of(&line) {
                return Some(frame.to_vec());
            }
        }
    }

    /// Whether nothing passes the cable and no session is open, so that passing time would change nothing. The pins do
    /// not show the session, so the board is at rest only when the silence must have ended it.
    pub fn is_at_rest(&self) -> bool {
        self.wire.is_empty() && self.line.is_empty() && self.sent.is_empty() && self.quiet > self.rests_after()
    }

    /// Lets this many nanoseconds pass.
    pub fn run(&mut self, nanoseconds: u64) {
        let end = self.next[0] + nanoseconds * 1000;
        while self.next[0] < end {
            self.edge();
        }
    }

    /// Passes the next rising edge of either clock, or of both.
    fn edge(&mut self) {
        let Ports { port_clock, core_clock, .. } = self.ports;
        let at = self.next[0].min(self.next[1]);
        let rises = [self.next[0] == at, self.next[1] == at];
        if rises[0] {
            self.drive();
            self.sample();
            self.next[0] += PORT_PS;
        }
        if rises[1] {
            self.next[1] += self.core_ps;
        }
        for level in [1, 0] {
            if rises[0] {
                self.model.set(port_clock, level);
            }
            if rises[1] {
                self.model.set(core_clock, level);
            }
            self.model.eval();
        }
    }

    /// Gives the board the next byte of the cable.
    fn drive(&mut self) {
        let byte = self.wire.pop_front().flatten();
        self.quiet = if byte.is_some() { 0 } else { self.quiet + 1 };
        self.model.set(self.ports.rx_valid, u64::from(byte.is_some()));
        self.model.set(self.ports.rx_data, u64::from(byte.unwrap_or(0)));
    }

    /// Takes the byte that the board sends, if it sends one.
    fn sample(&mut self) {
        if self.model.get(self.ports.tx_valid) == 1 {
            self.line.push(self.model.get(self.ports.tx_data) as u8);
            self.quiet = 0;
            return;
        }
        if !self.line.is_empty() {
            self.sent.push_back(std::mem::take(&mut self.line));
        }
    }
}
