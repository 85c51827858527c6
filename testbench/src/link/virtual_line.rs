//! The driver's protocol, a line with faults and delays, and a board, all in one virtual time.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::time::{Duration, Instant};

use incircle::serial::SerialFault;
use incircle::transports::parts::{Params, SerialProtocol, Statistics};
use incircle::transports::{receive_in_pieces, AnswerHead, Capabilities};
use incircle::{Transport, TransportError};
use incircle_protocol::Command;
use incircle_sim::faults::{FaultSpec, Proxy};
use incircle_sim::serial::Board;

/// Clocks between two looks at the line: fewer than a byte takes at any rate.
const SLICE: u64 = 80;

/// A driver, a line and a board.
pub struct VirtualLine {
    protocol: SerialProtocol,
    board: Box<dyn Board>,
    proxy: Proxy,
    /// Nanoseconds that a byte takes each way, besides its bits.
    delay: u64,
    /// Bytes on the line, each with its time of arrival in nanoseconds.
    to_device: VecDeque<(u64, u8)>,
    to_host: VecDeque<(u64, u8)>,
    /// Time at which the protocol wants to be called, even if nothing arrives.
    wakes_at: Option<u64>,
    out: Vec<u8>,
    came: Vec<u8>,
}

impl VirtualLine {
    /// Connects a driver that asks for `rate` to a board; each round trip takes `trip` besides the bits.
    pub fn new(board: Box<dyn Board>, rate: u32, trip: Duration, faults: &FaultSpec) -> Self {
        Self {
            protocol: SerialProtocol::new(Params::with_rate(rate)),
            board,
            proxy: Proxy::new(faults),
            delay: (trip.as_nanos() / 2) as u64,
            to_device: VecDeque::new(),
            to_host: VecDeque::new(),
            wakes_at: Some(0),
            out: Vec::new(),
            came: Vec::new(),
        }
    }

    /// The virtual time since the start.
    pub fn now(&self) -> Duration {
        Duration::from_nanos(self.nanoseconds())
    }

    /// Statistics of the driver.
    pub fn statistics(&self) -> Statistics {
        self.protocol.statistics()
    }

    /// Number of faults on the line so far.
    pub fn faults(&self) -> u64 {
        self.proxy.faults()
    }

    /// The current rate in bits per second.
    pub fn rate(&self) -> u32 {
        self.protocol.rate()
    }

    /// Replaces the driver by another one without a goodbye, as after the program was killed.
    pub fn restart_host(&mut self, rate: u32, session: u8) {
        self.protocol = SerialProtocol::new(Params { session, ..Params::with_rate(rate) });
        self.to_device.clear();
        self.wakes_at = Some(0);
    }

    /// Opens the session within this time.
    ///
    /// # Errors
    /// The errors of [`VirtualLine::ask`].
    pub fn open(&mut self, limit: Duration) -> Result<(), TransportError> {
        let now = self.now();
        self.protocol.open(now);
        self.drive(now + limit, |protocol| protocol.is_open().then_some(()))
    }

    /// Sends one command and returns its whole answer, within this time.
    ///
    /// # Errors
    /// The time is over, or the protocol stops trying.
    pub fn ask(&mut self, command: &Command<impl AsRef<[u32]>>, limit: Duration) -> Result<Vec<u32>, TransportError> {
        let now = self.now();
        self.protocol.ask(command.borrowed(), now)?;
        self.drive(now + limit, SerialProtocol::take_answer)
    }

    /// Ends the session with a goodbye.
    pub fn close(&mut self) {
        let now = self.now();
        self.protocol.close(now);
        // A goodbye that is lost does no harm: the next driver opens its session all the same.
        let _ = self.drive(now + Duration::from_secs(1), |protocol| protocol.is_closed().then_some(()));
    }

    fn drive<T>(
        &mut self,
        deadline: Duration,
        mut ready: impl FnMut(&mut SerialProtocol) -> Option<T>,
    ) -> Result<T, TransportError> {
        self.wakes_at = Some(0);
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

    /// Lets a slice of time pass.
    fn step(&mut self) {
        let now = self.nanoseconds();
        if self.wakes_at.is_some_and(|at| at <= now) {
            self.protocol.transmit(Duration::from_nanos(now), &mut self.out);
            let arrives = now + self.delay;
            self.to_device.extend(self.out.drain(..).map(|byte| (arrives, byte)));
            self.wakes_at = self.protocol.next_wake().map(|at| at.as_nanos() as u64);
        }
        while let Some((_, byte)) = self.to_device.pop_front_if(|(at, _)| *at <= now) {
            self.proxy.from_host(byte, now);
        }
        while let Some(symbol) = self.proxy.next_to_device(now) {
            self.board.send(symbol);
        }
        if self.to_device.is_empty() && self.board.waiting() == 0 {
            self.board.set_rate(self.protocol.rate());
        }
        self.board.run(SLICE);
        self.listen();
    }

    fn listen(&mut self) {
        let now = self.nanoseconds();
        while let Some((_, symbol)) = self.board.receive() {
            self.proxy.from_device(symbol, now);
        }
        while let Some(byte) = self.proxy.next_to_host(now) {
            self.to_host.push_back((now + self.delay, byte));
        }
        while let Some((_, byte)) = self.to_host.pop_front_if(|(at, _)| *at <= now) {
            self.came.push(byte);
        }
        if !self.came.is_empty() {
            self.protocol.receive(&self.came, Duration::from_nanos(now));
            self.came.clear();
            self.wakes_at = Some(now);
        }
    }

    fn nanoseconds(&self) -> u64 {
        let clock_hz = u128::from(self.board.link().clock_hz.max(1));
        (u128::from(self.board.clocks()) * 1_000_000_000 / clock_hz) as u64
    }
}

/// A [`VirtualLine`] as a transport of the library. Each command has a limit in virtual time;
/// deadlines in real time are ignored.
pub struct VirtualTransport {
    line: Rc<RefCell<VirtualLine>>,
    limit: Duration,
    answer: Vec<u32>,
    taken: usize,
}

impl VirtualTransport {
    /// Makes a transport over this line with this limit for each command.
    pub fn new(line: Rc<RefCell<VirtualLine>>, limit: Duration) -> Self {
        Self { line, limit, answer: Vec::new(), taken: 0 }
    }
}

impl VirtualTransport {
    /// Hands on the next words of the answer.
    fn hand_on(&mut self, words: &mut [u32]) -> Result<(), TransportError> {
        let rest = self.answer.get(self.taken..).unwrap_or_default();
        let next = rest.get(..words.len());
        let next = next.ok_or(TransportError::Closed { done: rest.len(), wanted: words.len() })?;
        words.copy_from_slice(next);
        self.taken += words.len();
        Ok(())
    }
}

impl Transport for VirtualTransport {
    fn name(&self) -> String {
        "virtual line".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], _deadline: Instant) -> Result<(), TransportError> {
        let [command] = commands else {
            return Err(SerialFault::Command("the virtual line takes one command at a time").into());
        };
        self.answer.clear();
        self.taken = 0;
        self.answer = self.line.borrow_mut().ask(command, self.limit)?;
        Ok(())
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        _deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        receive_in_pieces(head, payload, |words| self.hand_on(words))
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities::default()
    }
}
