//! The serial protocol and a board on a line with a delay and faults, in virtual time, and a transport of
//! the two for whole jobs.

use std::cell::Cell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::time::{Duration, Instant};

use incircle::serial::SerialFault;
use incircle::transports::parts::{Params, SerialProtocol};
use incircle::transports::{receive_in_pieces, AnswerHead, Capabilities};
use incircle::{Transport, TransportError};
use incircle_protocol::Command;

use super::board::Board;
use super::Random;

/// One direction of the line.
#[derive(Default)]
struct Wire {
    free_at: Duration,
    /// Frames on the line, each with its time of arrival, its rate and its bytes.
    under_way: VecDeque<(Duration, u32, Vec<u8>)>,
}

/// The fate of a frame on the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    Passes,
    Lost,
    Twice,
    /// The next frame overtakes this one.
    Overtaken,
    Changed,
}

/// Chooses the fate of a frame by its direction, which is true towards the host, and its number in that direction.
pub type Faults = Box<dyn FnMut(bool, usize) -> Fate>;

pub struct Rig {
    pub protocol: SerialProtocol,
    pub board: Board,
    pub now: Duration,
    pub delay: Duration,
    /// Whether the line carries bytes at once, as the pseudo-terminal of a simulated board does. The protocol reckons
    /// by the rate all the same.
    pub is_instant: bool,
    /// Errors per bit.
    pub noise: f64,
    pub faults: Faults,
    /// Time from which on nothing passes any more.
    pub cut_at: Duration,
    /// Time at which the board is reset.
    pub reset_at: Option<Duration>,
    pub random: Random,
    /// Number of bits that noise has changed.
    pub flipped: Rc<Cell<usize>>,
    pub frames: [usize; 2],
    wires: [Wire; 2],
    held: [Option<Vec<u8>>; 2],
    speaks_until: Duration,
    speaks: bool,
    answer: VecDeque<u32>,
    /// Time limit for a command, in virtual time.
    pub patience: Duration,
    pub last_fault: Option<SerialFault>,
}

impl Rig {
    pub fn new(params: Params, fifo: u32) -> Self {
        Self {
            protocol: SerialProtocol::new(params),
            board: Board::new(fifo),
            now: Duration::from_secs(5),
            delay: Duration::from_micros(500),
            is_instant: false,
            noise: 0.0,
            faults: Box::new(|_, _| Fate::Passes),
            cut_at: Duration::MAX,
            reset_at: None,
            random: Random(1),
            flipped: Rc::default(),
            frames: [0; 2],
            wires: [Wire::default(), Wire::default()],
            held: [None, None],
            speaks_until: Duration::ZERO,
            speaks: false,
            answer: VecDeque::new(),
            patience: Duration::from_secs(60),
            last_fault: None,
        }
    }

    /// Puts bytes on the line.
    fn carry(&mut self, to_host: bool, bytes: &[u8], rate: u32) -> Duration {
        let direction = usize::from(to_host);
        for piece in bytes.split_inclusive(|&byte| byte == 0) {
            let bits = if self.is_instant { 0 } else { 10 * piece.len() as u64 };
            let time = Duration::from_nanos(bits * 1_000_000_000 / u64::from(rate));
            self.wires[direction].free_at = self.wires[direction].free_at.max(self.now) + time;
            let fate = if piece.len() > 1 {
                self.frames[direction] += 1;
                (self.faults)(to_host, self.frames[direction] - 1)
            } else {
                Fate::Passes
            };
            let mut bytes = piece.to_vec();
            self.disturb(&mut bytes, fate == Fate::Changed);
            let mut pieces = match fate {
                Fate::Lost => vec![],
                Fate::Twice => vec![bytes.clone(), bytes],
                Fate::Overtaken => {
                    self.held[direction] = Some(bytes);
                    vec![]
                }
                Fate::Passes | Fate::Changed => vec![bytes],
            };
            if fate != Fate::Overtaken && piece.len() > 1 {
                pieces.extend(self.held[direction].take());
            }
            let arrival = self.wires[direction].free_at + self.delay;
            if self.now < self.cut_at {
                self.wires[direction].under_way.extend(pieces.into_iter().map(|bytes| (arrival, rate, bytes)));
            }
        }
        self.wires[direction].free_at
    }

    fn disturb(&mut self, bytes: &mut [u8], must: bool) {
        if must {
            let place = self.random.below(bytes.len() as u32) as usize;
            bytes[place] ^= 1 << self.random.below(8);
        }
        if self.noise > 0.0 {
            for byte in bytes {
                for bit in 0..8 {
                    if (self.random.next() >> 11) as f64 / (1u64 << 53) as f64 <= self.noise {
                        *byte ^= 1 << bit;
                        self.flipped.set(self.flipped.get() + 1);
                    }
                }
            }
        }
    }

    fn arrive(&mut self, to_host: bool) {
        let rate = if to_host { self.protocol.rate() } else { self.board.rate };
        while let Some((arrival, _, _)) = self.wires[usize::from(to_host)].under_way.front() {
            if *arrival > self.now {
                return;
            }
            let Some((_, sent, mut bytes)) = self.wires[usize::from(to_host)].under_way.pop_front() else { return };
            // Rates that differ by less than a fiftieth are equal for a UART.
            if sent.abs_diff(rate) > rate / 50 || sent > self.board.usable {
                for byte in &mut bytes {
                    *byte = self.random.next() as u8;
                }
            }
            if to_host {
                self.protocol.receive(&bytes, self.now);
            } else {
                self.board.take(&bytes, self.now);
            }
        }
    }

    /// Runs until `done` holds. Returns false if the time is over before that.
    pub fn run(&mut self, until: Duration, mut done: impl FnMut(&mut SerialProtocol) -> bool) -> bool {
        loop {
            if self.reset_at.is_some_and(|at| at <= self.now) {
                self.reset_at = None;
                self.board.reset();
            }
            self.arrive(false);
            self.board.tick(self.now);
            if self.now >= self.speaks_until {
                if std::mem::take(&mut self.speaks) {
                    self.board.said();
                }
                if let Some(frame) = self.board.say() {
                    let rate = self.board.rate;
                    self.speaks_until = self.carry(true, &frame, rate);
                    self.speaks = true;
                }
            }
            self.arrive(true);
            if done(&mut self.protocol) {
                return true;
            }
            let mut out = Vec::new();
            let before = self.protocol.rate();
            self.protocol.transmit(self.now, &mut out);
            assert!(out.is_empty() || before == self.protocol.rate(), "bytes with a change of rate");
            self.carry(false, &out, before);
            if done(&mut self.protocol) {
                return true;
            }
            let next = [
                self.protocol.next_wake(),
                self.wires[0].under_way.front().map(|(arrival, _, _)| *arrival),
                self.wires[1].under_way.front().map(|(arrival, _, _)| *arrival),
                self.speaks.then_some(self.speaks_until),
                self.board.is_eating().then(|| self.now + Duration::from_micros(100)),
                self.reset_at,
            ];
            let next = next.into_iter().flatten().min().unwrap_or(until);
            self.now = next.max(self.now + Duration::from_nanos(100));
            if self.now >= until {
                self.now = until;
                return false;
            }
        }
    }

    /// Number of frames, and of zeros between them, on the line.
    pub fn under_way(&self, to_host: bool) -> usize {
        self.wires[usize::from(to_host)].under_way.len()
    }

    /// Sends a command and receives its answer.
    pub fn ask(&mut self, command: &Command<impl AsRef<[u32]>>) -> Result<Vec<u32>, TransportError> {
        self.protocol.ask(command.borrowed(), self.now)?;
        self.finish()
    }

    /// Receives the answer to the command that was sent.
    pub fn finish(&mut self) -> Result<Vec<u32>, TransportError> {
        let mut answer = None;
        let until = self.now + self.patience;
        let is_done = self.run(until, |protocol| {
            answer = protocol.take_answer();
            answer.is_some() || protocol.check().is_err()
        });
        self.protocol.check()?;
        answer.filter(|_| is_done).ok_or(TransportError::Timeout { done: 0, wanted: 0 })
    }
}

impl Transport for Rig {
    fn name(&self) -> String {
        "rig".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], _: Instant) -> Result<(), TransportError> {
        let [command] = commands else { panic!("one command at a time") };
        let result = self.ask(command);
        if let Some(fault) = result.as_ref().err().and_then(TransportError::fault) {
            self.last_fault = Some(SerialFault::clone(fault));
        }
        self.answer = result?.into();
        Ok(())
    }

    fn receive(&mut self, head: AnswerHead, payload: &mut [u32], _: Instant) -> Result<AnswerHead, TransportError> {
        receive_in_pieces(head, payload, |words| {
            assert!(self.answer.len() >= words.len());
            words.fill_with(|| self.answer.pop_front().expect("enough"));
            Ok(())
        })
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities { run_words: 766, ..Capabilities::default() }
    }

    fn repeats(&self) -> u64 {
        self.protocol.statistics().answers_repeated
    }
}
