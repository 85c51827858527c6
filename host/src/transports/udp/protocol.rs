//! The host's half of the UDP link, without a socket and without a clock: datagrams and times go in, datagrams and
//! times come out.

mod receive;
mod transmit;

use std::time::Duration;

use incircle_protocol::{answer_head, Command, Identity, Opcode, UdpGreeting, IDENTITY_WORDS, UDP_KEPT_WORDS};

use super::fault::UdpFault;
use super::reader::Reader;
use super::sender::Sender;
use super::unit::{Answer, MOST_PAYLOAD};
use crate::transports::round_trip::{RoundTrip, TripBounds};
use crate::transports::{is_begun_as, Capabilities};

/// Bytes of answers that are awaited at a time unless the socket says how much it keeps.
const WINDOW_BYTES: usize = 64 * 1024;
/// Fewest bytes of answers that are awaited at a time: two datagrams.
const LEAST_WINDOW_BYTES: usize = 3 * 1024;
/// The times that the host waits, on a local network.
const TRIP_BOUNDS: TripBounds = TripBounds {
    first_trip: Duration::from_millis(2),
    least_slack: Duration::from_micros(500),
    poll_every: Duration::from_millis(100),
};

/// Most jobs under way: enough small ones for the round trip through a switch.
const JOBS_AHEAD: usize = 8;

/// Choices for a [`UdpProtocol`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UdpParams {
    /// Random number from which the numbers of sessions are made. Two hosts must not have the same.
    pub random: u64,
    /// Most bytes of answers that are awaited at a time: a quarter of the buffer size that the system reports, which
    /// is half of what the socket surely keeps.
    pub window_bytes: usize,
}

impl UdpParams {
    /// Choices with this random number, for a socket that keeps 128 kB.
    pub fn of_random(random: u64) -> Self {
        Self { random, window_bytes: WINDOW_BYTES }
    }
}

/// Counts of the traffic on a UDP link so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UdpStatistics {
    /// Datagrams handed out to be sent.
    pub sent: u64,
    /// Datagrams received.
    pub received: u64,
    /// Datagrams received with a wrong check sum, or of no known kind.
    pub broken: u64,
    /// `Data` datagrams that were sent again.
    pub resent: u64,
    /// Answers that were asked for again.
    pub repeated: u64,
    /// Jobs that were sent again as a whole.
    pub restarted: u64,
    /// `Poll` datagrams that were sent.
    pub polls: u64,
}

/// The stage of the link.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// No session is open or wanted.
    Idle,
    /// The host greets the device.
    Greeting { since: Duration, due: Duration, opens: bool },
    /// The host opens a session. `old` is one that the device may still have.
    Opening { since: Duration, due: Duration, old: Option<u64>, was_busy: bool },
    /// A session is open.
    Open,
    /// The host closes the session.
    Closing { said: u32, due: Duration },
}

/// A `Poll` whose answer is awaited.
#[derive(Clone, Copy, Debug)]
struct Polled {
    /// Datagrams acknowledged when the `Poll` was sent.
    base: u64,
    /// Datagrams cut when the `Poll` was sent.
    cut: u64,
}

/// The host's half of the UDP link.
///
/// The driver hands over each datagram that came ([`UdpProtocol::receive`]) and sends those that are due
/// ([`UdpProtocol::transmit`]), whenever a datagram came and at the time of [`UdpProtocol::next_wake`]. Times count
/// from any origin, never go back, and may be virtual. Commands have no deadline here: a driver stops waiting when it
/// wants to.
#[derive(Debug)]
pub struct UdpProtocol {
    random: u64,
    stage: Stage,
    fault: Option<UdpFault>,
    trips: RoundTrip,
    sender: Sender,
    reader: Reader,
    greeting: Option<UdpGreeting>,
    silence: Duration,
    session: u64,
    last_heard: Duration,
    last_said: Duration,
    polled: Option<Polled>,
    statistics: UdpStatistics,
    /// Datagrams sent again in earlier sessions.
    resent_before: u64,
    /// Whether the device has opened a session for this host before.
    has_served: bool,
}

impl UdpProtocol {
    /// Makes a link without a session. Nothing is sent until a greeting, a session or a command is asked for.
    pub fn new(params: UdpParams) -> Self {
        let window = params.window_bytes.max(LEAST_WINDOW_BYTES) / 4;
        Self {
            random: params.random,
            stage: Stage::Idle,
            fault: None,
            trips: RoundTrip::new(TRIP_BOUNDS),
            sender: Sender::default(),
            reader: Reader::new(window),
            greeting: None,
            silence: Duration::ZERO,
            session: 0,
            last_heard: Duration::ZERO,
            last_said: Duration::ZERO,
            polled: None,
            statistics: UdpStatistics::default(),
            resent_before: 0,
            has_served: false,
        }
    }

    /// The abilities of a transport over this link.
    pub fn capabilities(&self) -> Capabilities {
        Capabilities {
            takes_ahead: true,
            jobs_ahead: JOBS_AHEAD,
            any_order: true,
            kept_words: UDP_KEPT_WORDS,
            run_words: MOST_PAYLOAD,
            ..Capabilities::default()
        }
    }

    /// Greets the device without opening a session. [`UdpProtocol::greeting`] will have its answer.
    pub fn greet(&mut self, now: Duration) {
        self.stage = Stage::Greeting { since: now, due: now, opens: false };
    }

    /// Takes commands, and opens a session if there is none. A session that the device may have forgotten in a pause is
    /// opened anew for commands that do not need the memory of the device.
    ///
    /// # Errors
    /// The fault of the link, if it has one.
    pub fn ask(&mut self, commands: &[Command<&[u32]>], now: Duration) -> Result<(), UdpFault> {
        self.check()?;
        let was_waiting = self.reader.is_waiting();
        self.reader.add(commands);
        match self.stage {
            Stage::Open if was_waiting => {}
            Stage::Open => {
                let is_stale = now.saturating_sub(self.last_heard) >= self.silence / 2;
                self.last_heard = now;
                if is_stale && self.reader.needs_no_memory() {
                    self.open(now, Some(self.session));
                }
            }
            Stage::Greeting { opens: true, .. } | Stage::Opening { .. } => {}
            _ if self.greeting.is_some() => self.open(now, None),
            _ => self.stage = Stage::Greeting { since: now, due: now, opens: true },
        }
        Ok(())
    }

    /// Begins to open a session with a new number.
    fn open(&mut self, now: Duration, old: Option<u64>) {
        self.session = self.next_random();
        self.stage = Stage::Opening { since: now, due: now, old, was_busy: false };
    }

    /// The next number of the generator SplitMix64, never 0.
    fn next_random(&mut self) -> u64 {
        self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.random ^ self.random >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ mixed >> 31).max(1)
    }

    /// Checks that the link still works.
    ///
    /// # Errors
    /// The fault that ended the link.
    pub fn check(&self) -> Result<(), UdpFault> {
        self.fault.clone().map_or(Ok(()), Err)
    }

    /// Forgets the fault and all commands, so that the next command opens a new session. Returns true if that may help:
    /// after a fault that passes, such as a device that was reset.
    pub fn recover(&mut self, now: Duration) -> bool {
        if !matches!(self.fault, Some(UdpFault::Reset { .. } | UdpFault::Lost { .. })) {
            return false;
        }
        self.fault = None;
        self.reader.abandon();
        self.open(now, Some(self.session));
        true
    }

    /// Whether a session is open.
    pub fn is_open(&self) -> bool {
        matches!(self.stage, Stage::Open)
    }

    /// Takes the next answer: its beginning and its payload. `None` until all answers of its job have come and the
    /// device has proved by its digest that it took what was sent. The content of the words is not checked here.
    pub fn take_answer(&mut self) -> Option<Answer> {
        if self.fault.is_some() {
            return None;
        }
        let answer = self.reader.take_answer(&self.sender)?;
        self.fault = self.greeting.and_then(|greeting| contradiction(&answer, &greeting));
        self.fault.is_none().then_some(answer)
    }

    /// Ends the session, so that the next host finds the device free, and abandons all commands.
    ///
    /// [`UdpProtocol::is_closed`] says when this is done. There are at most three tries, 20 ms apart.
    pub fn close(&mut self, now: Duration) {
        self.reader.abandon();
        self.stage = match self.stage {
            Stage::Open | Stage::Opening { .. } => Stage::Closing { said: 0, due: now },
            Stage::Closing { .. } => return,
            Stage::Idle | Stage::Greeting { .. } => Stage::Idle,
        };
    }

    /// Whether no session is open, being opened or being closed.
    pub fn is_closed(&self) -> bool {
        matches!(self.stage, Stage::Idle)
    }

    /// The greeting of the device, checked, once it has come.
    pub fn greeting(&self) -> Option<&UdpGreeting> {
        self.greeting.as_ref()
    }

    /// Hears that the machine at the address refuses datagrams to this port. This ends the greeting; a session goes on
    /// until the silence decides.
    pub fn refused(&mut self, port: u16) {
        if matches!(self.stage, Stage::Greeting { .. }) {
            self.fault.get_or_insert(UdpFault::Refused { port });
        }
    }

    /// Counts of the traffic so far.
    pub fn statistics(&self) -> UdpStatistics {
        let (repeated, restarted) = self.reader.repeats();
        UdpStatistics { resent: self.resent_before + self.sender.resent(), repeated, restarted, ..self.statistics }
    }
}

/// The fault of an identity that differs from the one in the greeting, if the answer is an identity. The link knows the
/// length of points and records from the greeting, so the two must agree.
fn contradiction((head, payload): &Answer, greeting: &UdpGreeting) -> Option<UdpFault> {
    let is_identity = is_begun_as(*head, answer_head(Opcode::Hello, IDENTITY_WORDS as u32));
    let identity = Identity::from_words(*payload.first_chunk().filter(|_| is_identity)?);
    let mut words = identity.to_words().into_iter().zip(greeting.identity.to_words()).zip(0..);
    let ((found, expected), word) = words.find(|((found, expected), _)| found != expected)?;
    Some(UdpFault::Contradiction { word, found, expected })
}

#[cfg(test)]
mod tests;
