//! The host's half of the link without a port and without a clock: bytes and times go in, bytes and times come out.

mod receive;
mod transmit;

use std::time::Duration;

use incircle_protocol::{
    answer_head, Command, Greeting, Layout, Opcode, ANSWER_HEAD_WORDS, FIRST_RATE, IDENTITY_WORDS,
};

use super::codec::Decoder;
use super::connect::Connect;
use super::fault::SerialFault;
use super::reader::Reader;
use super::sender::Sender;
use super::timing::{Line, RoundTrip};

/// Rate that is wished for unless chosen otherwise: what every newer USB adapter does.
pub const DEFAULT_RATE: u32 = 3_000_000;

/// Choices for an [`SerialProtocol`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Params {
    /// Rates to try after the first one, the best first: see [`Params::with_rate`]. Empty: the first rate stays.
    pub rates: Vec<u32>,
    /// The number of the first session comes after this one; it need not be right, but differ from one host to the
    /// next.
    pub session: u8,
}

impl Params {
    /// With this rate, and lower ones if it cannot be had.
    pub fn with_rate(rate: u32) -> Self {
        Self { rates: Connect::ladder(rate), session: 0 }
    }
}

impl Default for Params {
    fn default() -> Self {
        Self::with_rate(DEFAULT_RATE)
    }
}

/// What the link has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Bytes handed out.
    pub bytes_sent: u64,
    /// Bytes that came.
    pub bytes_received: u64,
    /// `Data` frames sent again.
    pub frames_resent: u64,
    /// Answers, or ranges of records, asked for again.
    pub answers_repeated: u64,
    /// Pieces between zeros that were no frame.
    pub frames_broken: u64,
    /// `Poll` frames.
    pub polls: u64,
}

/// What the host is at.
#[derive(Debug)]
enum Stage {
    /// Nothing was asked for, or the session is closed.
    Idle,
    Connecting(Connect),
    /// A session is open.
    Open,
    /// The device fell silent in an open session, at the time given: is there one that was reset?
    Searching {
        silent_for: Duration,
        until: Duration,
        due: Duration,
    },
    Closing {
        said: u32,
        due: Duration,
    },
}

/// A `Poll` whose answer is awaited.
#[derive(Clone, Copy, Debug)]
struct Polled {
    /// Frames acknowledged, and frames cut, at that time.
    base: u64,
    cut: u64,
    left_at: Duration,
}

/// The host's half of the link.
///
/// Whoever drives it hands over what came ([`SerialProtocol::receive`]), sends what is due
/// ([`SerialProtocol::transmit`]) at the rate that [`SerialProtocol::rate`] says, and comes back when something came or
/// at [`SerialProtocol::next_wake`]. Times count from any origin, never go back, and may be virtual. There is no
/// deadline for a command: its driver gives up when it wants to.
#[derive(Debug)]
pub struct SerialProtocol {
    params: Params,
    stage: Stage,
    fault: Option<SerialFault>,
    decoder: Decoder,
    line: Line,
    trips: RoundTrip,
    sender: Sender,
    reader: Reader,
    greeting: Option<Greeting>,
    silence: Duration,
    /// Number of the session, or of the last one: the next has another.
    session: u8,
    /// A command that waits for the session.
    queued: Option<Command<Vec<u32>>>,
    last_heard: Duration,
    last_said: Duration,
    polled: Option<Polled>,
    /// Frames that say there is no session, and frames of another.
    without_session: u32,
    foreign: u32,
    statistics: Statistics,
    /// Of the sessions before.
    resent_before: u64,
    repeated_before: u64,
}

impl SerialProtocol {
    /// Without a session; nothing is sent until something is asked.
    pub fn new(params: Params) -> Self {
        Self {
            session: params.session,
            params,
            stage: Stage::Idle,
            fault: None,
            decoder: Decoder::default(),
            line: Line::new(FIRST_RATE),
            trips: RoundTrip::default(),
            sender: Sender::new(),
            reader: Reader::new(Layout { point_words: 1, record_words: 3 }),
            greeting: None,
            silence: Duration::ZERO,
            queued: None,
            last_heard: Duration::ZERO,
            last_said: Duration::ZERO,
            polled: None,
            without_session: 0,
            foreign: 0,
            statistics: Statistics::default(),
            resent_before: 0,
            repeated_before: 0,
        }
    }

    /// Asks the device who it is, without a session: [`SerialProtocol::greeting`] has its answer.
    pub fn greet(&mut self, now: Duration) {
        self.connect(now, true);
    }

    /// Begins a command. Opens a session if there is none; one that the device has
    /// forgotten because nobody asked anything is opened again for a command that needs nothing of it.
    ///
    /// # Errors
    /// The fault the link has, or a command that cannot be sent.
    pub fn ask(&mut self, command: Command<&[u32]>, now: Duration) -> Result<(), SerialFault> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone());
        }
        if self.queued.is_some() || self.reader.is_waiting() || self.reader.has_answer() {
            return Err(SerialFault::Command("the answer to the command before was not taken yet"));
        }
        let needs_nothing = matches!(command, Command::Hello | Command::Clear { .. });
        match self.stage {
            // The device knows us still, or what it forgot is lost: the first answer tells.
            Stage::Open if !needs_nothing || now.saturating_sub(self.last_said) < self.silence * 3 / 4 => {
                self.last_heard = now;
                return self.reader.begin(&command, &mut self.sender);
            }
            Stage::Connecting(ref connect) if !connect.only_greets() => {}
            _ => self.connect(now, false),
        }
        self.queued = Some(command.map(<[u32]>::to_vec));
        Ok(())
    }

    fn connect(&mut self, now: Duration, only_greet: bool) {
        self.set_rate(FIRST_RATE, now);
        let connect = Connect::new(now, self.session, &self.params.rates, only_greet);
        self.stage = Stage::Connecting(connect);
    }

    /// Opens a session, unless one is open or being opened; commands do so by themselves.
    pub fn open(&mut self, now: Duration) {
        let is_wanted = match &self.stage {
            Stage::Idle => true,
            Stage::Connecting(connect) => connect.only_greets(),
            Stage::Open | Stage::Searching { .. } | Stage::Closing { .. } => false,
        };
        if is_wanted {
            self.connect(now, false);
        }
    }

    /// True if a session is open, at the rate that was found.
    pub fn is_open(&self) -> bool {
        matches!(self.stage, Stage::Open)
    }

    /// Whether the link still works.
    ///
    /// # Errors
    /// The fault that ended it.
    pub fn check(&self) -> Result<(), SerialFault> {
        self.fault.clone().map_or(Ok(()), Err)
    }

    /// The answer to the command, once, when all of it has come, and the device has proved by the digest that it took
    /// what was sent: header, length, payload. Its words are in order and no more than the command may bring; what they
    /// say is not checked.
    pub fn take_answer(&mut self) -> Option<Vec<u32>> {
        if self.fault.is_some() || !self.sender.is_proved() {
            return None;
        }
        let answer = self.reader.take_answer()?;
        self.fault = self.greeting.and_then(|greeting| contradiction(&answer, &greeting));
        self.fault.is_none().then_some(answer)
    }

    /// Ends the session, so that the next host finds the device at the first rate, and gives up a command under way.
    /// [`SerialProtocol::is_closed`] tells when it is done: after three tries at most, each of which waits for twice
    /// the mean round trip, and for 60 ms at least.
    pub fn close(&mut self, now: Duration) {
        self.queued = None;
        self.reader.abandon();
        self.stage = match &self.stage {
            Stage::Open => Stage::Closing { said: 0, due: now },
            Stage::Connecting(connect) if connect.may_be_open() && connect.greeting().is_some() => {
                self.session = connect.session();
                Stage::Closing { said: 0, due: now }
            }
            Stage::Closing { .. } => return,
            _ => Stage::Idle,
        };
    }

    /// True if no session is open, and none is being opened or closed.
    pub fn is_closed(&self) -> bool {
        matches!(self.stage, Stage::Idle)
    }

    /// The bits per second that the port must have for the next bytes. A call that changes it hands out none.
    pub fn rate(&self) -> u32 {
        self.line.rate()
    }

    /// What the device said of itself, checked.
    pub fn greeting(&self) -> Option<&Greeting> {
        self.greeting.as_ref()
    }

    /// What was done so far.
    pub fn statistics(&self) -> Statistics {
        Statistics {
            frames_resent: self.resent_before + self.sender.resent(),
            answers_repeated: self.repeated_before + self.reader.repeated(),
            ..self.statistics
        }
    }

    fn set_rate(&mut self, rate: u32, now: Duration) {
        if rate != self.line.rate() {
            self.line.set_rate(rate, now);
            self.decoder.clear();
        }
    }
}

/// What the core says of itself must be what the greeting said: by that the link knows how long points and records are.
fn contradiction(answer: &[u32], greeting: &Greeting) -> Option<SerialFault> {
    let (head, identity) = answer.split_first_chunk::<ANSWER_HEAD_WORDS>()?;
    let is_identity = *head == answer_head(Opcode::Hello, IDENTITY_WORDS as u32);
    let mut words = identity.iter().copied().zip(greeting.identity.to_words()).zip(0..);
    let ((found, expected), word) = words.find(|((found, expected), _)| is_identity && found != expected)?;
    Some(SerialFault::Contradiction { word, found, expected })
}
