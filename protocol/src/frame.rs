//! Frames of the serial link; `protocol/SERIAL.md` says what they mean.
//!
//! A frame towards the device is `session, type, number, length (2), payload, CRC-32`, in COBS, closed by a zero. One towards the host is
//! `session, type, expected, answers, free (2), status, body, CRC-32`, in reverse COBS, closed by a zero. Numbers of several bytes
//! begin with the low one.

/// Version of the link, `major << 16 | minor`. A host refuses a device of another major version, or of an older minor one.
pub const LINK_VERSION: u32 = 1 << 16;
/// First word of the greeting: the letters `inCl`.
pub const LINK_MAGIC: u32 = 0x696e_436c;
/// Closes every frame, and appears nowhere inside one.
pub const FRAME_END: u8 = 0;
/// Bytes before the payload of a frame towards the device.
pub const HOST_HEADER_BYTES: usize = 5;
/// Bytes before the body of a frame towards the host.
pub const DEVICE_HEADER_BYTES: usize = 7;
/// Bytes of a check sum.
pub const CRC_BYTES: usize = 4;
/// Most bytes of the payload of a frame, and most bytes of answer words in one.
pub const MAX_PAYLOAD: usize = 1024;
/// Bytes before the words of an answer's frame: number of the answer (1), index of its first word (2).
pub const ANSWER_HEADER_BYTES: usize = 3;
/// Most bytes of a frame towards the host before it is encoded: an answer's last one.
pub const MAX_DEVICE_FRAME: usize = DEVICE_HEADER_BYTES + ANSWER_HEADER_BYTES + MAX_PAYLOAD + 4 + CRC_BYTES;
/// Frames that may be under way unacknowledged.
pub const WINDOW: u8 = 16;
/// Words of a greeting.
pub const GREETING_WORDS: usize = 13;
/// Bits per second after reset, after `Close`, and after a silence or a break.
pub const FIRST_RATE: u32 = 115_200;
/// Milliseconds without a valid frame after which a device forgets session and rate.
pub const SILENCE_MS: u32 = 2_000;
/// Milliseconds of low line after which it does.
pub const BREAK_MS: u32 = 1;
/// Bits of the phase of the baud generator: a bit takes `2^24 / step` clocks.
pub const PHASE_BITS: u32 = 24;
/// Largest step: a bit takes at least eight clocks.
pub const MAX_STEP: u32 = 1 << (PHASE_BITS - 3);

/// The step of the baud generator for a rate, rounded to the nearest; `None` where a bit would take less than eight clocks or the step is 0.
pub const fn rate_step(rate: u32, clock_hz: u32) -> Option<u32> {
    if clock_hz == 0 {
        return None;
    }
    let step = (((rate as u64) << PHASE_BITS) + clock_hz as u64 / 2) / clock_hz as u64;
    if step == 0 || step > MAX_STEP as u64 {
        None
    } else {
        Some(step as u32)
    }
}

/// What a host's frame is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum HostFrame {
    /// Who are you? Changes nothing, and needs no session.
    Hello = 0x01,
    /// Begin the session of this number: forget all frames and reset the core.
    Open = 0x02,
    /// Change the rate; the payload is the step, 4 bytes.
    Rate = 0x03,
    /// Say where you are.
    Poll = 0x04,
    /// Command words.
    Data = 0x05,
    /// End the session and return to the first rate.
    Close = 0x06,
}

impl HostFrame {
    /// The type with this number.
    pub const fn from_u8(value: u8) -> Option<Self> {
        Some(match value {
            0x01 => Self::Hello,
            0x02 => Self::Open,
            0x03 => Self::Rate,
            0x04 => Self::Poll,
            0x05 => Self::Data,
            0x06 => Self::Close,
            _ => return None,
        })
    }
}

/// What a device's frame is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum DeviceFrame {
    /// The greeting, [`GREETING_WORDS`] words.
    Hello = 0x81,
    /// The session is open.
    Opened = 0x82,
    /// All is well up to `expected`; body: CRC-32 of the payload accepted in this session (4).
    Ack = 0x83,
    /// A frame is missing: go back to `expected`. Body as of `Ack`.
    Nak = 0x84,
    /// Words of an answer, and more will come.
    Answer = 0x85,
    /// The last words of an answer, then the CRC-32 of all its words.
    AnswerEnd = 0x86,
    /// There is no session: the device was reset, or heard nothing for too long.
    NoSession = 0x87,
    /// The session is closed.
    Closed = 0x88,
}

impl DeviceFrame {
    /// The type with this number.
    pub const fn from_u8(value: u8) -> Option<Self> {
        Some(match value {
            0x81 => Self::Hello,
            0x82 => Self::Opened,
            0x83 => Self::Ack,
            0x84 => Self::Nak,
            0x85 => Self::Answer,
            0x86 => Self::AnswerEnd,
            0x87 => Self::NoSession,
            0x88 => Self::Closed,
            _ => return None,
        })
    }
}

/// Status bit: a session is open.
pub const STATUS_OPEN: u8 = 1 << 0;
/// Status bit: the last `Rate` was refused, and the rate is as before.
pub const STATUS_BAD_RATE: u8 = 1 << 1;
/// Status bit: a frame was dropped since the last frame to the host began: check sum, length or line noise.
pub const STATUS_DROPPED: u8 = 1 << 2;
/// Status bit: the core has taken a word of a command whose answer has not ended.
pub const STATUS_BUSY: u8 = 1 << 3;

/// What a device says of its link and its core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Greeting {
    /// [`LINK_MAGIC`].
    pub magic: u32,
    /// [`LINK_VERSION`].
    pub link_version: u32,
    /// Clock of link and core in Hz.
    pub clock_hz: u32,
    /// Bytes of the receive FIFO.
    pub fifo_bytes: u32,
    /// Most bits per second.
    pub max_rate: u32,
    /// Milliseconds of silence after which it forgets the session.
    pub silence_ms: u32,
    /// The core's identity.
    pub identity: crate::layout::Identity,
}

impl Greeting {
    /// As words on the link.
    pub const fn to_words(self) -> [u32; GREETING_WORDS] {
        let core = self.identity.to_words();
        [
            self.magic,
            self.link_version,
            self.clock_hz,
            self.fifo_bytes,
            self.max_rate,
            self.silence_ms,
            core[0],
            core[1],
            core[2],
            core[3],
            core[4],
            core[5],
            core[6],
        ]
    }

    /// From words on the link; nothing is checked.
    pub const fn from_words(words: [u32; GREETING_WORDS]) -> Self {
        Self {
            magic: words[0],
            link_version: words[1],
            clock_hz: words[2],
            fifo_bytes: words[3],
            max_rate: words[4],
            silence_ms: words[5],
            identity: crate::layout::Identity::from_words([
                words[6], words[7], words[8], words[9], words[10], words[11], words[12],
            ]),
        }
    }
}

/// Parameters of a serial link in hardware.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LinkConfig {
    /// Clock in Hz.
    pub clock_hz: u32,
    /// Bytes of the receive FIFO, a power of two from 2,048 to 32,768.
    pub fifo_bytes: u32,
    /// Milliseconds of silence after which the session is forgotten: [`SILENCE_MS`], less in simulations.
    pub silence_ms: u32,
}

/// Slowest clock of a link: eight clocks a bit at the first rate.
pub const MIN_LINK_CLOCK_HZ: u32 = 8 * FIRST_RATE;
/// Fastest clock of a link.
pub const MAX_LINK_CLOCK_HZ: u32 = 500_000_000;
/// Least bytes of a receive FIFO.
pub const MIN_FIFO_BYTES: u32 = 2_048;
/// Most bytes of a receive FIFO.
pub const MAX_FIFO_BYTES: u32 = 32_768;
/// Most milliseconds of silence: a host that finds a device at another rate greets for so long and a second more.
pub const MAX_SILENCE_MS: u32 = SILENCE_MS;

/// A parameter that no link can be built with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkConfigError {
    /// Outside `MIN_LINK_CLOCK_HZ..=MAX_LINK_CLOCK_HZ`.
    Clock(u32),
    /// Not a power of two in `MIN_FIFO_BYTES..=MAX_FIFO_BYTES`.
    Fifo(u32),
    /// Outside `1..=MAX_SILENCE_MS`.
    Silence(u32),
}

impl core::fmt::Display for LinkConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Clock(given) => write!(
                f,
                "the clock of a serial link has {MIN_LINK_CLOCK_HZ} to {MAX_LINK_CLOCK_HZ} Hz, not {given}: choose a rate between them"
            ),
            Self::Fifo(given) => write!(
                f,
                "a receive FIFO holds a power of two of bytes, {MIN_FIFO_BYTES} to {MAX_FIFO_BYTES}, not {given}: choose the next larger one"
            ),
            Self::Silence(given) => write!(
                f,
                "a session is forgotten after 1 to {MAX_SILENCE_MS} milliseconds of silence, not {given}: choose a number between them"
            ),
        }
    }
}

impl core::error::Error for LinkConfigError {}

impl LinkConfig {
    /// Checks every parameter.
    pub const fn check(self) -> Result<Self, LinkConfigError> {
        let Self { clock_hz, fifo_bytes, silence_ms } = self;
        if clock_hz < MIN_LINK_CLOCK_HZ || clock_hz > MAX_LINK_CLOCK_HZ {
            return Err(LinkConfigError::Clock(clock_hz));
        }
        if fifo_bytes < MIN_FIFO_BYTES || fifo_bytes > MAX_FIFO_BYTES || !fifo_bytes.is_power_of_two() {
            return Err(LinkConfigError::Fifo(fifo_bytes));
        }
        if silence_ms < 1 || silence_ms > MAX_SILENCE_MS {
            return Err(LinkConfigError::Silence(silence_ms));
        }
        Ok(self)
    }

    /// Most bits per second: eight clocks a bit.
    pub const fn max_rate(self) -> u32 {
        self.clock_hz / 8
    }
}
