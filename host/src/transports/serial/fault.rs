//! What can go wrong on a serial link, a sentence each that says what to do.

use crate::error::{DeviceFault, ErrorKind, TransportError};

/// Why the link gave up. Noise is repaired, or ends in [`Silent`](Self::Silent), [`Noise`](Self::Noise),
/// [`Lost`](Self::Lost), [`Reset`](Self::Reset), or the deadline.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SerialFault {
    /// Nothing came back at all.
    #[error(
        "nothing answers: check that this is the right port (`incircle devices` lists all), that the board has power and its \
         configuration, and that its transmit line is our receive line"
    )]
    Silent,
    /// Something came back, and no frame of ours.
    #[error(
        "{bytes} bytes came back, but no frame of an incircle device: another device is at this port, or noise on the line"
    )]
    Noise {
        /// Bytes received.
        bytes: u64,
    },
    /// The greeting has another magic word.
    #[error("the greeting starts with {found:#010x}, not {expected:#010x}: this is no incircle device")]
    Magic {
        /// Word received.
        found: u32,
        /// Word of every device.
        expected: u32,
    },
    /// The device speaks another major version of the link, or an older minor one.
    #[error("the device speaks version {}.{} of the link, this library {}.{}: update the {}",
        found >> 16, found & 0xffff, expected >> 16, expected & 0xffff,
        if found < expected { "device" } else { "host's incircle" })]
    Version {
        /// Version of the device.
        found: u32,
        /// Version of this library.
        expected: u32,
    },
    /// The greeting says what no sound device says.
    #[error("the device claims {found} {what}, but at least {least} are possible: distrust it")]
    Greeting {
        /// What is claimed.
        what: &'static str,
        /// The number claimed.
        found: u32,
        /// The least that is possible.
        least: u32,
    },
    /// The core's identity in the greeting is none of a sound device.
    #[error("{0}")]
    Identity(#[from] DeviceFault),
    /// Another host has opened a session.
    #[error(
        "another program opened session {session} on the same line in the middle of the job: end it, and run again"
    )]
    Taken {
        /// Its session.
        session: u8,
    },
    /// The device has forgotten the session.
    #[error(
        "the device lost the session in the middle of the job: it was reset, or heard nothing for {silence_ms} ms; what it \
         held is gone, so run the job again"
    )]
    Reset {
        /// Its silence.
        silence_ms: u32,
    },
    /// The device fell silent.
    #[error("the device fell silent in the middle of the job, for {milliseconds} ms: check cable and power, and run the job again")]
    Lost {
        /// Time since its last frame, in the time of the link.
        milliseconds: u64,
    },
    /// The port is gone.
    #[error("the port is gone ({reason}): was the cable pulled? Plug it in, and run the job again")]
    Unplugged {
        /// What the system said.
        reason: String,
    },
    /// The device accepted other bytes than were sent, though every frame's check sum held.
    #[error(
        "the device took other points than were sent: their check sum is {found:#010x}, not {expected:#010x}; that is no fault of \
         the line, so reset the device, and if it persists distrust it"
    )]
    PayloadDigest {
        /// Check sum the device has.
        found: u32,
        /// Check sum of what was sent.
        expected: u32,
    },
    /// An answer is not what its own check sum says, though every frame's held.
    #[error(
        "the device's answer has the check sum {found:#010x}, but it announces {expected:#010x}; that is no fault of the line, so \
         reset the device, and if it persists distrust it"
    )]
    AnswerDigest {
        /// Check sum of the words received.
        found: u32,
        /// Check sum the device announced.
        expected: u32,
    },
    /// The device claims more free room than its FIFO has.
    #[error("the device claims {free} free bytes in a FIFO of {fifo}: reset it, and if it persists distrust it")]
    Credit {
        /// Bytes claimed.
        free: u32,
        /// Bytes of the FIFO.
        fifo: u32,
    },
    /// The device answers what it has not taken.
    #[error(
        "the device answers a question that ends at byte {awaited} of what it was sent, but has taken {taken}: reset it, and if it \
         persists distrust it"
    )]
    Unasked {
        /// Bytes of the session up to the end of the question.
        awaited: u64,
        /// Bytes that the device has acknowledged.
        taken: u64,
    },
    /// The core's identity is not the one in the greeting.
    #[error(
        "the core says {found:#010x} in word {word} of its identity, but the greeting said {expected:#010x}: reset the device, and \
         if it persists distrust it"
    )]
    Contradiction {
        /// Word of the identity, from 0.
        word: usize,
        /// What the core says.
        found: u32,
        /// What the greeting said.
        expected: u32,
    },
    /// An answer is longer than any answer to its command.
    #[error("the device's answer has more than the {due} words it may have: reset it, and if it persists distrust it")]
    Endless {
        /// Words it may have.
        due: usize,
    },
    /// An answer ended with another number of words than it announced.
    #[error(
        "the device's answer announces {announced} words and has {came}: reset it, and if it persists distrust it"
    )]
    AnswerLength {
        /// Words announced.
        announced: u32,
        /// Words that came.
        came: usize,
    },
    /// What the caller asked for cannot be sent.
    #[error("{0}")]
    Command(&'static str),
}

impl SerialFault {
    /// Whose fault it is.
    pub const fn kind(&self) -> ErrorKind {
        match self {
            Self::Silent | Self::Noise { .. } | Self::Magic { .. } => ErrorKind::DeviceNotFound,
            Self::Taken { .. } | Self::Reset { .. } | Self::Lost { .. } | Self::Unplugged { .. } | Self::Command(_) => {
                ErrorKind::Link
            }
            Self::Version { .. }
            | Self::Greeting { .. }
            | Self::Identity(_)
            | Self::PayloadDigest { .. }
            | Self::AnswerDigest { .. }
            | Self::Credit { .. }
            | Self::Unasked { .. }
            | Self::Contradiction { .. }
            | Self::Endless { .. }
            | Self::AnswerLength { .. } => ErrorKind::Device,
        }
    }
}

impl From<SerialFault> for TransportError {
    fn from(fault: SerialFault) -> Self {
        Self::other(fault.kind(), fault)
    }
}
