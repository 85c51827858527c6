//! The host's half of the serial link, without a port and without a clock: bytes and times go in, bytes
//! and times come out.

mod receive;
mod transmit;

use std::time::Duration;

use incircle_protocol::{
    answer_head, Command, Greeting, Identity, Layout, Opcode, ANSWER_HEAD_WORDS, FIRST_RATE, IDENTITY_WORDS,
};

use super::codec::Decoder;
use super::connect::Connect;
use super::fault::SerialFault;
use super::reader::Reader;
use super::sender::Sender;
use super::timing::{Line, TRIP_BOUNDS};
use crate::transports::is_begun_as;
use crate::transports::round_trip::RoundTrip;

/// Rate to ask for unless the caller chooses another, in bits per second. Every newer USB adapter reaches it.
pub const DEFAULT_RATE: u32 = 3_000_000;

/// Choices for a [`SerialProtocol`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Params {
    /// Rates to try after the first rate, in bits per second, the best first, as [`Params::with_rate`] makes them. With
    /// an empty list the link stays at the first rate.
    pub rates: Vec<u32>,
    /// Number before that of the first session. Any number will do, so long as successive hosts have different ones.
    pub session: u8,
}

impl Params {
    /// Choices with this rate, and lower ones to try if it does not work.
    pub fn with_rate(rate: u32) -> Self {
        Self { rates: Connect::ladder(rate), session: 0 }
    }
}

impl Default for Params {
    fn default() -> Self {
        Self::with_rate(DEFAULT_RATE)
    }
}

/// Counts of the traffic on a serial link so far. Many repeats and broken frames are signs of a noisy line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Bytes handed out to be sent.
    pub bytes_sent: u64,
    /// Bytes received from the line.
    pub bytes_received: u64,
    /// `Data` frames that were sent again.
    pub frames_resent: u64,
    /// Answers, or ranges of records, that were asked for again.
    pub answers_repeated: u64,
    /// Pieces between zeros that were not a frame.
    pub frames_broken: u64,
    /// `Poll` frames that were sent.
    pub polls: u64,
}

/// The stage of the link.
#[derive(Debug)]
enum Stage {
    /// No session is open or wanted.
    Idle,
    Connecting(Connect),
    /// A session is open.
    Open,
    /// The device fell silent in an open session. The host looks at the first rate for a device that was reset.
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
    /// Frames acknowledged when the `Poll` was sent.
    base: u64,
    /// Frames cut when the `Poll` was sent.
    cut: u64,
    /// Time at which the `Poll` is off the line.
    left_at: Duration,
}

/// The host's half of the serial link.
///
/// The driver of a protocol hands over received bytes ([`SerialProtocol::receive`]) and sends the bytes that are due
/// ([`SerialProtocol::transmit`]) at the rate of [`SerialProtocol::rate`]. The driver does so whenever bytes came, and
/// at the time of [`SerialProtocol::next_wake`]. Times count from any origin, never go back, and may be virtual.
/// Commands have no deadline here: a driver stops waiting when it wants to.
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
    /// Number of the open session, or of the last one. The next session gets another number.
    session: u8,
    /// Command that waits for the session to open.
    queued: Option<Command<Vec<u32>>>,
    last_heard: Duration,
    last_said: Duration,
    polled: Option<Polled>,
    /// Frames in a row that say that no session is open.
    without_session: u32,
    /// Frames in a row of a session of another host.
    foreign: u32,
    statistics: Statistics,
    /// Frames sent again in earlier sessions.
    resent_before: u64,
    /// Answers asked for again in earlier sessions.
    repeated_before: u64,
}

impl SerialProtocol {
    /// Makes a link without a session. Nothing is sent until a greeting, a session or a command is asked for.
    pub fn new(params: Params) -> Self {
        Self {
            session: params.session,
            params,
            stage: Stage::Idle,
            fault: None,
            decoder: Decoder::default(),
            line: Line::new(FIRST_RATE),
            trips: RoundTrip::new(TRIP_BOUNDS),
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

    /// Greets the device without opening a session. [`SerialProtocol::greeting`] will have its answer.
    pub fn greet(&mut self, now: Duration) {
        self.connect(now, true);
    }

    /// Begins a command, and opens a session if there is none. A session that the device may have forgotten in a pause
    /// is opened anew for a command that does not need the memory of the device.
    ///
    /// # Errors
    /// The fault of the link, if it has one, or [`SerialFault::Command`] for a command that cannot be sent.
    pub fn ask(&mut self, command: Command<&[u32]>, now: Duration) -> Result<(), SerialFault> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone());
        }
        if self.queued.is_some() || self.reader.is_waiting() || self.reader.has_answer() {
            return Err(SerialFault::Command("the answer to the previous command has not been taken yet"));
        }
        let needs_nothing = matches!(command, Command::Hello | Command::Clear(_));
        match self.stage {
            // Either the device still knows the session, or the memory that the command needs is lost anyway. The
            // first answer will tell.
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

    /// Opens a session, unless one is open or being opened. Commands do so by themselves.
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

    /// Whether a session is open, at the best rate that works.
    pub fn is_open(&self) -> bool {
        matches!(self.stage, Stage::Open)
    }

    /// Checks that the link still works.
    ///
    /// # Errors
    /// The fault that ended the link.
    pub fn check(&self) -> Result<(), SerialFault> {
        self.fault.clone().map_or(Ok(()), Err)
    }

    /// Takes the answer to the command: header, length and payload. `None` until all of it has come and the device has
    /// proved by its digest that it took what was sent.
    ///
    /// The words are in order, and no more than the command may bring. Their content is not checked here.
    pub fn take_answer(&mut self) -> Option<Vec<u32>> {
        if self.fault.is_some() || !self.sender.is_proved() {
            return None;
        }
        let answer = self.reader.take_answer()?;
        self.fault = self.greeting.and_then(|greeting| contradiction(&answer, &greeting));
        self.fault.is_none().then_some(answer)
    }

    /// Ends the session, so that the next host finds the device at the first rate, and abandons a command under way.
    ///
    /// [`SerialProtocol::is_closed`] says when this is done. There are at most three tries, each of which waits for
    /// twice the mean round trip, and for 60 ms at least.
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

    /// Whether no session is open, being opened or being closed.
    pub fn is_closed(&self) -> bool {
        matches!(self.stage, Stage::Idle)
    }

    /// The rate, in bits per second, that the port must have for the next bytes. A call that changes the rate
    /// hands out no bytes.
    pub fn rate(&self) -> u32 {
        self.line.rate()
    }

    /// The greeting of the device, checked, once it has come.
    pub fn greeting(&self) -> Option<&Greeting> {
        self.greeting.as_ref()
    }

    /// Counts of the traffic so far.
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

/// The fault of an identity that differs from the one in the greeting, if `answer` is an identity. The link knows the
/// length of points and records from the greeting, so the two must agree.
fn contradiction(answer: &[u32], greeting: &Greeting) -> Option<SerialFault> {
    let (head, identity) = answer.split_first_chunk::<ANSWER_HEAD_WORDS>()?;
    let is_identity = is_begun_as(*head, answer_head(Opcode::Hello, IDENTITY_WORDS as u32));
    let identity = Identity::from_words(*identity.first_chunk()?);
    let mut words = identity.to_words().into_iter().zip(greeting.identity.to_words()).zip(0..);
    let ((found, expected), word) = words.find(|((found, expected), _)| is_identity && found != expected)?;
    Some(SerialFault::Contradiction { word, found, expected })
}
