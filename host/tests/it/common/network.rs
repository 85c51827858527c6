//! The UDP protocol, a network with faults, and the model of a device, all in one virtual time.

use std::cell::RefCell;
use std::net::{Ipv4Addr, SocketAddrV4};
use std::rc::Rc;
use std::time::{Duration, Instant};

use incircle::transports::parts::{UdpParams, UdpProtocol, UdpStatistics};
use incircle::transports::{AnswerHead, Capabilities};
use incircle::{Transport, TransportError};
use incircle_model::serial::{core_identity, Instantly, Passed, WordDevice};
use incircle_model::udp::UdpModel;
use incircle_model::ChipModel;
use incircle_protocol::{signed_header, Command, Config, Identity, UdpLinkConfig, FULL};
use incircle_testkit::{Network, NetworkFaults};

/// Clocks of the device in a microsecond, and in the whole time that passes at once while it works.
const CLOCKS_PER_US: u64 = 120;
const SLICE_NS: u64 = 5_000;
const LINK: UdpLinkConfig =
    UdpLinkConfig { clock_hz: 120_000_000, fifo_bytes: 16_384, silence_ms: 2000, mac: [2, 0, 0, 0, 0, 1] };

/// The model by commands, which takes a word of a command only in one clock of `every`: a point takes about as long as
/// in a core.
pub struct Paced {
    core: Instantly,
    every: u32,
    left: u32,
}

impl WordDevice for Paced {
    fn reset(&mut self) {
        self.core.reset();
    }

    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed {
        self.left = self.left.saturating_sub(1);
        let passed = self.core.step(command.filter(|_| self.left == 0), takes_answer);
        if passed.is_taken {
            self.left = self.every;
        }
        passed
    }
}

/// The device behind the link.
pub enum Core {
    /// The model by commands, which takes its time.
    Paced(Box<Paced>),
    /// A chip of several engines, clock by clock.
    Chip(Box<ChipModel>),
}

impl WordDevice for Core {
    fn reset(&mut self) {
        match self {
            Self::Paced(core) => core.reset(),
            Self::Chip(core) => core.reset(),
        }
    }

    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed {
        match self {
            Self::Paced(core) => core.step(command, takes_answer),
            Self::Chip(core) => core.step(command, takes_answer),
        }
    }

    fn owes_answers(&self) -> bool {
        match self {
            Self::Paced(core) => core.owes_answers(),
            Self::Chip(core) => core.owes_answers(),
        }
    }
}

/// Makes the datagrams of a stranger, one after another.
pub type Stranger = Box<dyn FnMut() -> Vec<u8>>;

/// A host, a network and a device.
pub struct VirtualNetwork {
    pub protocol: UdpProtocol,
    pub board: UdpModel<Core>,
    down: Network<SocketAddrV4>,
    up: Network<SocketAddrV4>,
    now: u64,
    /// Time up to which the device has worked.
    board_at: u64,
    out: Vec<Vec<u8>>,
    host: SocketAddrV4,
    /// Datagrams of others that reach the device while the host works.
    pub stranger: Option<Stranger>,
    /// Number of datagrams that strangers got.
    pub to_strangers: u64,
    /// Whether the cable is pulled.
    pub is_cut: bool,
    /// Number of the one datagram to the host that is lost, if any, and number of those that were sent.
    pub loses: Option<u64>,
    pub to_host: u64,
    /// Number of datagrams to the host after which the device forgets its session.
    forgets_at: Option<u64>,
}

impl VirtualNetwork {
    /// Connects a host to a device; each round trip takes `trip` besides the time on the wire.
    pub fn new(faults: &NetworkFaults, trip: Duration) -> Self {
        let core = Instantly::of(FULL).expect("a named configuration");
        let identity = core.identity();
        Self::around(Core::Paced(Box::new(Paced { core, every: 15, left: 0 })), identity, faults, trip)
    }

    /// Connects a host to a device with runs.
    pub fn living(faults: &NetworkFaults, trip: Duration) -> Self {
        let core = Instantly::of(FULL).expect("a named configuration").with_runs();
        let identity = core.identity();
        Self::around(Core::Paced(Box::new(Paced { core, every: 15, left: 0 })), identity, faults, trip)
    }

    /// Connects a host to a chip.
    pub fn of_chip(config: Config, faults: &NetworkFaults, trip: Duration) -> Self {
        let chip = ChipModel::new(config).expect("a possible chip");
        Self::around(Core::Chip(Box::new(chip)), core_identity(config), faults, trip)
    }

    fn around(core: Core, identity: Identity, faults: &NetworkFaults, trip: Duration) -> Self {
        let latency = trip.as_nanos() as u64 / 2;
        Self {
            protocol: UdpProtocol::new(UdpParams::of_random(faults.seed)),
            board: UdpModel::new(LINK, identity, core),
            down: Network::new(faults, latency, 0),
            up: Network::new(faults, latency, 1),
            now: 0,
            board_at: 0,
            out: Vec::new(),
            host: SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 2), 40_000),
            stranger: None,
            to_strangers: 0,
            is_cut: false,
            loses: None,
            to_host: 0,
            forgets_at: None,
        }
    }

    pub fn now(&self) -> Duration {
        Duration::from_nanos(self.now)
    }

    pub fn statistics(&self) -> UdpStatistics {
        self.protocol.statistics()
    }

    /// Number of faults so far.
    pub fn met(&self) -> u64 {
        self.down.met() + self.up.met()
    }

    /// Replaces the host by another one at another port, without a goodbye, as after the program was killed.
    pub fn restart_host(&mut self, random: u64) {
        self.protocol = UdpProtocol::new(UdpParams::of_random(random));
        self.host.set_port(self.host.port() + 1);
    }

    /// Lets time pass until the host has received so many datagrams since it began. Panics if they do not come.
    pub fn run_to_datagram(&mut self, datagrams: u64) {
        for _ in 0..1_000_000 {
            if self.protocol.statistics().received >= datagrams {
                return;
            }
            self.step();
        }
        panic!("the host got only {} datagrams", self.protocol.statistics().received);
    }

    /// Makes the device forget its session behind the next datagram that it sends to the host.
    pub fn forgets_soon(&mut self) {
        self.forgets_at = Some(self.to_host + 1);
    }

    /// Lets this time pass without the host.
    pub fn rest(&mut self, time: Duration) {
        self.now += time.as_nanos() as u64;
        self.run_board();
    }

    fn drive<T>(
        &mut self,
        limit: Duration,
        mut ready: impl FnMut(&mut UdpProtocol) -> Option<T>,
    ) -> Result<T, TransportError> {
        let deadline = self.now + limit.as_nanos() as u64;
        loop {
            self.protocol.check()?;
            if let Some(result) = ready(&mut self.protocol) {
                return Ok(result);
            }
            if self.now >= deadline {
                return Err(TransportError::Timeout { done: 0, wanted: 1 });
            }
            self.step();
        }
    }

    /// Does everything that is due, and goes on to the next time at which something is.
    fn step(&mut self) {
        self.protocol.transmit(Duration::from_nanos(self.now), &mut self.out);
        for datagram in self.out.drain(..) {
            if !self.is_cut {
                self.down.send(self.now, self.host, &datagram);
            }
        }
        if let Some(datagram) = self.stranger.as_mut().map(|stranger| stranger()) {
            self.board.take(SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 9), 40_000), false, &datagram);
        }
        self.run_board();
        while let Some((from, datagram)) = self.down.next(self.now) {
            self.board.take(from, false, &datagram);
        }
        while self.up.free_at() <= self.now {
            let Some((to, datagram)) = self.board.give() else { break };
            if to.ip() != self.host.ip() {
                self.to_strangers += 1;
            } else {
                if !self.is_cut && self.loses != Some(self.to_host) {
                    self.up.send(self.now, to, &datagram);
                }
                self.to_host += 1;
            }
        }
        if self.forgets_at.take_if(|at| *at <= self.to_host).is_some() {
            self.board.age(u64::from(LINK.clock_hz) * u64::from(LINK.silence_ms));
        }
        let mut has_come = false;
        while let Some((to, datagram)) = self.up.next(self.now) {
            has_come = true;
            if to == self.host {
                self.protocol.receive(&datagram, Duration::from_nanos(self.now));
            }
        }
        // What came may have made something due.
        let wake = if has_come { Some(self.now) } else { self.protocol.next_wake().map(|wake| wake.as_nanos() as u64) };
        let work = self.board.is_at_work().then_some(self.now + SLICE_NS);
        let wire = Some(self.up.free_at()).filter(|&at| at > self.now);
        let next = [wake, self.down.next_at(), self.up.next_at(), work, wire].into_iter().flatten().min();
        self.now = next.unwrap_or(self.now + 10 * SLICE_NS).max(self.now + 100);
    }

    fn run_board(&mut self) {
        let clocks = (self.now - self.board_at) * CLOCKS_PER_US / 1000;
        self.board.pass(clocks);
        self.board_at = self.now;
    }
}

/// A [`VirtualNetwork`] as a transport. Each answer has a limit in virtual time; deadlines in real time are ignored.
pub struct VirtualTransport {
    pub network: Rc<RefCell<VirtualNetwork>>,
    pub limit: Duration,
}

impl Transport for VirtualTransport {
    fn name(&self) -> String {
        "virtual network".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], _deadline: Instant) -> Result<(), TransportError> {
        let mut network = self.network.borrow_mut();
        let now = network.now();
        network.protocol.ask(commands, now)?;
        network.step();
        Ok(())
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        _deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let answer = self.network.borrow_mut().drive(self.limit, UdpProtocol::take_answer);
        let (came, words) = answer?;
        if signed_header(came[0], 0, 0) == signed_header(head[0], 0, 0) && words.len() == payload.len() {
            payload.copy_from_slice(&words);
        }
        Ok(came)
    }

    fn receive_next(
        &mut self,
        words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
        payload: &mut Vec<u32>,
        _deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let (came, words) = self.network.borrow_mut().drive(self.limit, UdpProtocol::take_answer)?;
        *payload = if words_of(came) == Some(words.len()) { words } else { Vec::new() };
        Ok(came)
    }

    fn capabilities(&self) -> Capabilities {
        self.network.borrow().protocol.capabilities()
    }

    fn repeats(&self) -> u64 {
        let UdpStatistics { repeated, restarted, .. } = self.network.borrow().statistics();
        repeated + restarted
    }
}

impl Drop for VirtualTransport {
    fn drop(&mut self) {
        let Ok(mut network) = self.network.try_borrow_mut() else { return };
        let now = network.now();
        network.protocol.close(now);
        let _ = network.drive(Duration::from_secs(1), |protocol| protocol.is_closed().then_some(()));
    }
}
