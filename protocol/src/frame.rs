//! The frames of the serial link. `protocol/SERIAL.md` says how host and device use them.
//!
//! A frame to the device is `session, type, number, length (2), payload, CRC-32`, encoded in COBS and closed by a zero
//! byte. A frame to the host is `session, type, expected, answers, free (2), status, body, CRC-32`, encoded in reverse
//! COBS and closed by a zero byte. In numbers of several bytes the low byte comes first.

/// Version of the serial link, `major << 16 | minor`. A host refuses a device with another major version, or with
/// an older minor version.
pub const LINK_VERSION: u32 = 1 << 16;
/// First word of the greeting: the letters `inCl`.
pub const LINK_MAGIC: u32 = 0x696e_436c;
/// The byte that closes every frame. The encoding keeps it out of the frame itself.
pub const FRAME_END: u8 = 0;
/// Number of bytes before the payload of a frame to the device.
pub const HOST_HEADER_BYTES: usize = 5;
/// Number of bytes before the body of a frame to the host.
pub const DEVICE_HEADER_BYTES: usize = 7;
/// Number of bytes of a check sum.
pub const CRC_BYTES: usize = 4;
/// Largest payload of a frame to the device in bytes, and largest number of bytes of answer words in a
/// frame to the host.
pub const MAX_PAYLOAD: usize = 1024;
/// Number of bytes before the words in an answer's frame: the number of the answer (1), the index of
/// the first word (2).
pub const ANSWER_HEADER_BYTES: usize = 3;
/// Largest frame to the host in bytes before encoding: the last frame of an answer.
pub const MAX_DEVICE_FRAME: usize = DEVICE_HEADER_BYTES + ANSWER_HEADER_BYTES + MAX_PAYLOAD + 4 + CRC_BYTES;
/// Largest number of frames that may be unacknowledged at a time.
pub const WINDOW: u8 = 16;
/// Number of words of a greeting.
pub const GREETING_WORDS: usize = 13;
/// Bits per second after a reset, a `Close`, a silence or a break.
pub const FIRST_RATE: u32 = 115_200;
/// Milliseconds without a valid frame after which a device forgets the session and the rate.
pub const SILENCE_MS: u32 = 2_000;
/// Milliseconds with the line low after which a device forgets the session and the rate.
pub const BREAK_MS: u32 = 1;
/// Bits of the phase of the baud generator. A bit on the line takes `2^24 / step` clocks.
pub const PHASE_BITS: u32 = 24;
/// Largest step of the baud generator, with which a bit takes eight clocks.
pub const MAX_STEP: u32 = 1 << (PHASE_BITS - 3);

/// The step of the baud generator for a rate, rounded to the nearest; `None` if a bit would take fewer than eight
/// clocks or the step would be 0.
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

/// The type of a frame to the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum HostFrame {
    /// Ask for the greeting. Needs no session, and changes nothing.
    Hello = 0x01,
    /// Begin the session of this number: the device forgets all frames and resets the core.
    Open = 0x02,
    /// Change the rate. The payload is the step of the baud generator, 4 bytes.
    Rate = 0x03,
    /// Ask the device for its state.
    Poll = 0x04,
    /// Carry words of commands.
    Data = 0x05,
    /// End the session, and return to the first rate.
    Close = 0x06,
}

impl HostFrame {
    /// The type of this number, if there is one.
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

/// The type of a frame to the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum DeviceFrame {
    /// The greeting, of [`GREETING_WORDS`] words.
    Hello = 0x81,
    /// The session is now open.
    Opened = 0x82,
    /// All frames before `expected` have been accepted. The body is the CRC-32 of the payload accepted in
    /// this session, 4 bytes.
    Ack = 0x83,
    /// A frame is missing, and the host must send again from `expected` on. The body is that of `Ack`.
    Nak = 0x84,
    /// Words of an answer that is not complete yet.
    Answer = 0x85,
    /// The last words of an answer, followed by the CRC-32 of all its words.
    AnswerEnd = 0x86,
    /// No session is open, because the device was reset or heard no valid frame for too long.
    NoSession = 0x87,
    /// The session is now closed.
    Closed = 0x88,
}

impl DeviceFrame {
    /// The type of this number, if there is one.
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
/// Status bit: the device refused the last `Rate` and kept its rate.
pub const STATUS_BAD_RATE: u8 = 1 << 1;
/// Status bit: since the device began its last frame, it dropped a frame for its check sum, its length or line noise.
pub const STATUS_DROPPED: u8 = 1 << 2;
/// Status bit: the core has taken a word of a command, and the answer has not ended.
pub const STATUS_BUSY: u8 = 1 << 3;

/// The properties of a device's serial link and core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Greeting {
    /// The letters `inCl`, [`LINK_MAGIC`].
    pub magic: u32,
    /// Version of the serial link, as [`LINK_VERSION`] packs it.
    pub link_version: u32,
    /// Clock of the link and the core in Hz.
    pub clock_hz: u32,
    /// Size of the receive FIFO in bytes.
    pub fifo_bytes: u32,
    /// Largest rate in bits per second.
    pub max_rate: u32,
    /// Milliseconds of silence after which the device forgets the session.
    pub silence_ms: u32,
    /// The identity of the core.
    pub identity: crate::layout::Identity,
}

impl Greeting {
    /// The greeting as words, in the order of the fields.
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

    /// The greeting from words in the order of the fields. No value is checked.
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

/// The parameters of a serial link in hardware.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LinkConfig {
    /// Clock of the link and the core in Hz.
    pub clock_hz: u32,
    /// Size of the receive FIFO in bytes, a power of two from 2,048 to 32,768.
    pub fifo_bytes: u32,
    /// Milliseconds of silence after which the device forgets the session: [`SILENCE_MS`], or less in simulations.
    pub silence_ms: u32,
}

/// Slowest clock of a serial link, with eight clocks a bit at the first rate.
pub const MIN_LINK_CLOCK_HZ: u32 = 8 * FIRST_RATE;
/// Fastest clock of a serial link.
pub const MAX_LINK_CLOCK_HZ: u32 = 500_000_000;
/// Smallest receive FIFO in bytes.
pub const MIN_FIFO_BYTES: u32 = 2_048;
/// Largest receive FIFO in bytes.
pub const MAX_FIFO_BYTES: u32 = 32_768;
/// Longest silence in milliseconds. A host that meets a device at an unknown rate sends greetings for this time
/// and a second more.
pub const MAX_SILENCE_MS: u32 = SILENCE_MS;

/// A parameter with which no serial link can be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkConfigError {
    /// The clock is outside `MIN_LINK_CLOCK_HZ..=MAX_LINK_CLOCK_HZ`.
    Clock(u32),
    /// The size of the FIFO is not a power of two in `MIN_FIFO_BYTES..=MAX_FIFO_BYTES`.
    Fifo(u32),
    /// The silence is outside `1..=MAX_SILENCE_MS`.
    Silence(u32),
}

impl core::fmt::Display for LinkConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Clock(given) => write!(
                f,
                "a serial link cannot run at {given} Hz: choose {MIN_LINK_CLOCK_HZ} to {MAX_LINK_CLOCK_HZ} Hz"
            ),
            Self::Fifo(given) => write!(
                f,
                "a receive FIFO cannot have {given} bytes: choose a power of two, {MIN_FIFO_BYTES} to {MAX_FIFO_BYTES}"
            ),
            Self::Silence(given) => write!(
                f,
                "a silence of {given} milliseconds cannot end a session: choose a number from 1 to {MAX_SILENCE_MS}"
            ),
        }
    }
}

impl core::error::Error for LinkConfigError {}

impl LinkConfig {
    /// Checks every parameter, and returns the parameters if all are valid.
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

    /// Largest rate in bits per second, with eight clocks a bit.
    pub const fn max_rate(self) -> u32 {
        self.clock_hz / 8
    }
}
