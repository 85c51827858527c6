//! The serial protocol over a port of the operating system, in real time.

use std::time::{Duration, Instant};

use incircle_protocol::{Command, Greeting, FIRST_RATE};

use super::address::Address;
use super::fault::SerialFault;
use super::port::Port;
use super::protocol::{Params, SerialProtocol, Statistics};
use super::reader::RUN_WORDS;
use crate::error::{Error, TransportError};
use crate::limit::Limit;
use crate::transports::transport::{
    receive_in_pieces, receive_next_in_pieces, AnswerHead, Capabilities, Pace, Transport,
};

/// Most bytes of one read.
const READ_BYTES: usize = 16 * 1024;
/// Longest time in one call of the system.
const LONGEST_WAIT: Duration = Duration::from_millis(100);
/// Time to wait for bytes while the port takes no more of the host's.
const WRITE_AGAIN: Duration = Duration::from_millis(1);
/// Time limit for closing the session, in the time of the link.
const GOODBYE: Duration = Duration::from_millis(400);
/// Time limit for closing the session, in real time.
const LONGEST_GOODBYE: Duration = Duration::from_secs(4);
/// Bits of a word on the line, start and stop bits included.
const WORD_BITS: u32 = 40;

/// The transport to a board at a serial port.
///
/// The first command opens a session with the board, and dropping the transport closes it. All times of the link itself
/// are stretched by [`Address::slow`]; deadlines of the caller are in real time.
pub struct SerialTransport {
    port: Port,
    protocol: SerialProtocol,
    name: String,
    slow: u32,
    origin: Instant,
    /// Bytes that the port has not taken yet.
    out: Vec<u8>,
    /// Answer to the last command.
    answer: Vec<u32>,
    /// Words of `answer` that were handed on.
    taken: usize,
}

impl SerialTransport {
    /// Opens the port. Nothing is sent yet.
    ///
    /// # Errors
    /// [`Error::Open`] with a [`PortFault`](super::PortFault) if the system refuses, and [`Error::Link`] if the port is
    /// gone while its rates are tried.
    pub fn open(address: &Address) -> Result<Self, Error> {
        let name = address.to_string();
        let port = Port::open(&address.port)
            .map_err(|fault| Error::Open { device: address.port.clone(), source: fault.into() })?;
        let origin = Instant::now();
        let mut transport = Self {
            port,
            protocol: SerialProtocol::new(Params::default()),
            name,
            slow: address.slow.max(1),
            origin,
            out: Vec::new(),
            answer: Vec::new(),
            taken: 0,
        };
        let params = transport.params(address.baud).map_err(|fault| transport.failed(fault))?;
        transport.protocol = SerialProtocol::new(params);
        Ok(transport)
    }

    fn params(&mut self, baud: u32) -> Result<Params, SerialFault> {
        let wanted = Params::with_rate(baud);
        let rates = self.port.possible(&wanted.rates)?;
        // Any number will do, so long as the next program has another one.
        let time = std::time::SystemTime::UNIX_EPOCH.elapsed().map_or(0, |elapsed| elapsed.subsec_nanos() >> 8);
        Ok(Params { rates, session: (time ^ std::process::id()) as u8 })
    }

    fn failed(&self, fault: SerialFault) -> Error {
        Error::Link { device: self.name.clone(), during: "the opening", source: fault.into() }
    }

    /// Opens the session, unless it is open. The timeout is in the time of the link. Commands open the session by
    /// themselves, so this is only for those who want to know the [rate](Self::rate) before.
    ///
    /// # Errors
    /// [`Error::Link`] or [`Error::Timeout`] if no sound device answers.
    pub fn connect(&mut self, timeout: Duration) -> Result<(), Error> {
        self.protocol.open(self.now());
        self.drive_for(timeout, |protocol| protocol.is_open().then_some(()))
    }

    fn drive_for<T>(
        &mut self,
        timeout: Duration,
        ready: impl FnMut(&mut SerialProtocol) -> Option<T>,
    ) -> Result<T, Error> {
        const DURING: &str = "the greeting";
        let limit = Limit::of(timeout.saturating_mul(self.slow));
        let result = self.drive(limit.deadline(), 0, ready);
        result.map_err(|source| match source {
            TransportError::Timeout { .. } => limit.missed(self.name(), DURING),
            source => Error::Link { device: self.name(), during: DURING, source },
        })
    }

    /// The greeting of the device, once it has come.
    pub fn greeting(&self) -> Option<&Greeting> {
        self.protocol.greeting()
    }

    /// The present rate in bits per second.
    pub fn rate(&self) -> u32 {
        self.protocol.rate()
    }

    /// Counts of the traffic so far.
    pub fn statistics(&self) -> Statistics {
        self.protocol.statistics()
    }

    /// The time of the link: real time, divided by `slow`.
    fn now(&self) -> Duration {
        self.origin.elapsed() / self.slow
    }

    /// Runs the link until `ready` gives a result, or until the deadline.
    fn drive<T>(
        &mut self,
        deadline: Instant,
        wanted: usize,
        mut ready: impl FnMut(&mut SerialProtocol) -> Option<T>,
    ) -> Result<T, TransportError> {
        loop {
            self.protocol.check()?;
            if let Some(result) = ready(&mut self.protocol) {
                return Ok(result);
            }
            if Instant::now() >= deadline {
                return Err(TransportError::Timeout { done: 0, wanted });
            }
            self.step(deadline)?;
        }
    }

    /// Writes the bytes that are due, and reads the bytes that came or waits for some.
    fn step(&mut self, deadline: Instant) -> Result<(), SerialFault> {
        if self.out.is_empty() {
            self.follow_rate()?;
            let now = self.now();
            self.protocol.transmit(now, &mut self.out);
            if self.out.is_empty() {
                self.follow_rate()?;
            }
        }
        let written = self.port.write(&self.out)?;
        self.out.drain(..written);
        let wait = self.time_to_wait(deadline);
        let mut bytes = [0; READ_BYTES];
        let read = self.port.read(&mut bytes, wait)?;
        self.protocol.receive(&bytes[..read], self.now());
        Ok(())
    }

    /// Sets the port to the rate of the link.
    fn follow_rate(&mut self) -> Result<(), SerialFault> {
        if self.port.rate() != self.protocol.rate() {
            self.port.set_rate(self.protocol.rate())?;
        }
        Ok(())
    }

    fn time_to_wait(&self, deadline: Instant) -> Duration {
        if !self.out.is_empty() {
            return WRITE_AGAIN;
        }
        let wake = self.protocol.next_wake().unwrap_or(Duration::MAX);
        let wait = wake.saturating_sub(self.now()).min(LONGEST_WAIT).saturating_mul(self.slow);
        wait.min(LONGEST_WAIT).min(deadline.saturating_duration_since(Instant::now()))
    }
}

impl SerialTransport {
    /// Hands on the next words of the answer.
    fn hand_on(&mut self, words: &mut [u32]) -> Result<(), TransportError> {
        let rest = self.answer.get(self.taken..).unwrap_or_default();
        let Some(next) = rest.get(..words.len()) else {
            return Err(TransportError::Closed { done: rest.len(), wanted: words.len() });
        };
        words.copy_from_slice(next);
        self.taken += words.len();
        Ok(())
    }
}

impl Transport for SerialTransport {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        let [command] = commands else {
            return Err(SerialFault::Command("the serial link takes one command at a time").into());
        };
        self.protocol.ask(*command, self.now())?;
        self.answer.clear();
        self.taken = 0;
        // Only the answer tells that a command is through, and its lost parts are asked for again. So the whole
        // answer is received here.
        self.answer = self.drive(deadline, command.words(), SerialProtocol::take_answer)?;
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

    fn receive_next(
        &mut self,
        words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
        payload: &mut Vec<u32>,
        _deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        receive_next_in_pieces(words_of, payload, |words| self.hand_on(words))
    }

    fn capabilities(&self) -> Capabilities {
        let words = self.protocol.rate() / WORD_BITS / self.slow;
        let pace = Pace { slow: self.slow, words_per_second: Some(words.max(1)) };
        Capabilities { any_order: true, run_words: RUN_WORDS, pace, ..Capabilities::default() }
    }

    fn repeats(&self) -> u64 {
        self.protocol.statistics().answers_repeated
    }
}

impl Drop for SerialTransport {
    /// Closes the session, so that the next program finds the device at the first rate without waiting.
    fn drop(&mut self) {
        self.out.clear();
        self.protocol.close(self.now());
        let deadline = Instant::now() + GOODBYE.saturating_mul(self.slow).min(LONGEST_GOODBYE);
        while !self.protocol.is_closed() && Instant::now() < deadline {
            if self.step(deadline).is_err() {
                return;
            }
        }
    }
}

/// Asks which device is at a port, at the first rate and without opening a session.
///
/// Use it to list devices: the device keeps its state. `timeout` bounds the wait for the answer, in the
/// time of the link.
///
/// # Errors
/// [`Error::Open`] if the system refuses to open the port, and [`Error::Link`] or [`Error::Timeout`] if
/// no sound device answers.
pub fn greet(address: &Address, timeout: Duration) -> Result<Greeting, Error> {
    let mut transport = SerialTransport::open(&Address { baud: FIRST_RATE, ..address.clone() })?;
    let now = transport.now();
    transport.protocol.greet(now);
    transport.drive_for(timeout, |protocol| protocol.greeting().copied())
}
