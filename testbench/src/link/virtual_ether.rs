//! The host's half of the UDP link, a network with faults and delays, and a board at the pins of its PHY, all in the
//! simulated time of the board.

use std::cell::RefCell;
use std::net::{Ipv4Addr, SocketAddrV4};
use std::rc::Rc;
use std::time::{Duration, Instant};

use incircle::transports::parts::{UdpParams, UdpProtocol, UdpStatistics};
use incircle::transports::{AnswerHead, Capabilities};
use incircle::{Transport, TransportError};
use incircle_protocol::Command;
use incircle_sim::network::NetworkBoard;
use incircle_testkit::{Network, NetworkFaults};

/// Nanoseconds between two looks at the host and the network.
const SLICE_NS: u64 = 1000;
/// Slices after which a silent cable means that only the host can go on, unless others are asked for: longer than the
/// core takes for the jobs of most tests.
const QUIET: u32 = 250;

/// A host, a network and a board.
pub struct VirtualEther {
    protocol: UdpProtocol,
    board: NetworkBoard,
    down: Network<SocketAddrV4>,
    up: Network<SocketAddrV4>,
    host: SocketAddrV4,
    out: Vec<Vec<u8>>,
    /// Slices since something was on its way, and nanoseconds that passed for host and network but not for the board.
    quiet: u32,
    most_quiet: u32,
    skipped: u64,
}

impl VirtualEther {
    /// Connects a host to a board; each round trip takes `trip` besides the time on the wire.
    pub fn new(board: NetworkBoard, trip: Duration, faults: &NetworkFaults) -> Self {
        let latency = trip.as_nanos() as u64 / 2;
        Self {
            protocol: UdpProtocol::new(UdpParams::of_random(faults.seed)),
            board,
            down: Network::new(faults, latency, 0),
            up: Network::new(faults, latency, 1),
            host: SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 2), 40_000),
            out: Vec::new(),
            quiet: 0,
            most_quiet: QUIET,
            skipped: 0,
        }
    }

    /// Simulates every clock for up to this many microseconds of a silent cable. The core must not take longer for a
    /// job: time without clocks would pass for it.
    pub fn set_longest_job(&mut self, microseconds: u32) {
        self.most_quiet = microseconds;
    }

    /// The virtual time since the start.
    pub fn now(&self) -> Duration {
        Duration::from_nanos(self.nanoseconds())
    }

    fn nanoseconds(&self) -> u64 {
        self.board.now() + self.skipped
    }

    /// Counts of the host.
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

    /// Lets time pass until the host has received so many datagrams since it began, or for this long. Returns whether
    /// they came.
    pub fn run_to_datagram(&mut self, datagrams: u64, limit: Duration) -> bool {
        let deadline = self.now() + limit;
        while self.protocol.statistics().received < datagrams && self.now() < deadline {
            self.step();
        }
        self.protocol.statistics().received >= datagrams
    }

    fn drive<T>(
        &mut self,
        limit: Duration,
        mut ready: impl FnMut(&mut UdpProtocol) -> Option<T>,
    ) -> Result<T, TransportError> {
        let deadline = self.now() + limit;
        loop {
            self.protocol.check()?;
            if let Some(result) = ready(&mut self.protocol) {
                return Ok(result);
            }
            if self.now() >= deadline {
                return Err(TransportError::Timeout { done: 0, wanted: 1 });
            }
            self.step();
        }
    }

    /// Lets a slice of time pass, or more if the host waits and nothing is on its way: no clock of the board need be
    /// simulated for that.
    fn step(&mut self) {
        let now = self.nanoseconds();
        self.quiet += 1;
        self.protocol.transmit(Duration::from_nanos(now), &mut self.out);
        for datagram in self.out.drain(..) {
            self.down.send(now, self.host, &datagram);
        }
        while let Some((from, datagram)) = self.down.next(now) {
            self.board.send(from, false, &datagram);
            self.quiet = 0;
        }
        self.board.run(SLICE_NS);
        let now = self.nanoseconds();
        while let Some((to, datagram)) = self.board.receive() {
            self.up.send(now, to, &datagram);
            self.quiet = 0;
        }
        while let Some((to, datagram)) = self.up.next(now) {
            if to == self.host {
                self.protocol.receive(&datagram, Duration::from_nanos(now));
            }
            self.quiet = 0;
        }
        if self.quiet > self.most_quiet && self.board.waiting() == 0 {
            let wake = self.protocol.next_wake().map(|wake| wake.as_nanos() as u64);
            let next = [wake, self.down.next_at(), self.up.next_at()].into_iter().flatten().min();
            self.skipped += next.map_or(0, |next| next.saturating_sub(now));
        }
    }
}

/// A [`VirtualEther`] as a transport of the library. Each answer has a limit in virtual time; deadlines in real time
/// are ignored.
pub struct EtherTransport {
    ether: Rc<RefCell<VirtualEther>>,
    limit: Duration,
}

impl EtherTransport {
    /// Makes a transport over this network with this limit for each answer.
    pub fn new(ether: Rc<RefCell<VirtualEther>>, limit: Duration) -> Self {
        Self { ether, limit }
    }
}

impl Transport for EtherTransport {
    fn name(&self) -> String {
        "virtual Ethernet".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], _deadline: Instant) -> Result<(), TransportError> {
        let mut ether = self.ether.borrow_mut();
        let now = ether.now();
        Ok(ether.protocol.ask(commands, now)?)
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        _deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let (came, words) = self.ether.borrow_mut().drive(self.limit, UdpProtocol::take_answer)?;
        // An answer of another length is not the one that was asked for; its head tells the library.
        if came[1] == head[1] && words.len() == payload.len() {
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
        let (came, words) = self.ether.borrow_mut().drive(self.limit, UdpProtocol::take_answer)?;
        *payload = if words_of(came) == Some(words.len()) { words } else { Vec::new() };
        Ok(came)
    }

    fn capabilities(&self) -> Capabilities {
        self.ether.borrow().protocol.capabilities()
    }
}

impl Drop for EtherTransport {
    fn drop(&mut self) {
        let Ok(mut ether) = self.ether.try_borrow_mut() else { return };
        let now = ether.now();
        ether.protocol.close(now);
        // A goodbye that is lost does no harm: the board forgets the session after its silence.
        let _ = ether.drive(Duration::from_secs(1), |protocol| protocol.is_closed().then_some(()));
    }
}
