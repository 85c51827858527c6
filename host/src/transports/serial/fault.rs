//! Faults of serial links, in sentences that say what to do.

use crate::error::{DeviceFault, ErrorKind, TransportError};

/// The reason why a serial link failed.
///
/// Noise on the line is repaired. If there is too much of it, the job ends in [`Silent`](Self::Silent),
/// [`Noise`](Self::Noise), [`Lost`](Self::Lost), [`Reset`](Self::Reset), or at its deadline.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SerialFault {
    /// No byte came back.
    #[error(
        "nothing answers: check that this is the right port (`incircle devices` lists all), \
         that the board has power and its configuration, and that its transmit line leads to the receive line here"
    )]
    Silent,
    /// Bytes came back, but no frame of an incircle device.
    #[error(
        "{bytes} bytes came back, but no frame of an incircle device: \
         another device is at this port, or there is noise on the line"
    )]
    Noise {
        /// Number of bytes received.
        bytes: u64,
    },
    /// The greeting does not start with the word that marks an incircle device.
    #[error("the greeting starts with {found:#010x}, not {expected:#010x}: this is not an incircle device")]
    Magic {
        /// First word of the greeting received.
        found: u32,
        /// First word of the greeting of every incircle device.
        expected: u32,
    },
    /// The device speaks another major version of the serial link than this library, or an older minor version.
    #[error("the device speaks version {}.{} of the link, but this library speaks {}.{}: update the {}",
        found >> 16, found & 0xffff, expected >> 16, expected & 0xffff,
        if found < expected { "device" } else { "host's incircle" })]
    Version {
        /// Version of the device, `major << 16 | minor`.
        found: u32,
        /// Version of this library, `major << 16 | minor`.
        expected: u32,
    },
    /// A number in the greeting is smaller than on any sound device.
    #[error("the device claims {found} {what}, but a sound device has at least {least}: do not trust it")]
    Greeting {
        /// Noun for the things claimed.
        what: &'static str,
        /// Number that the device claims.
        found: u32,
        /// Least number of a sound device.
        least: u32,
    },
    /// The identity of the core in the greeting is not one of a sound device.
    #[error("{0}")]
    Identity(#[from] DeviceFault),
    /// Another host has opened a session.
    #[error(
        "another program opened session {session} on the same line in the middle of the job: end it, and run again"
    )]
    Taken {
        /// Number of the other host's session.
        session: u8,
    },
    /// The device has forgotten the session.
    #[error(
        "the device lost the session in the middle of the job, since it was reset or heard nothing \
         for {silence_ms} ms: its memory is empty now, so run the job again"
    )]
    Reset {
        /// Silence of the device in milliseconds: the time without a frame after which it forgets the session.
        silence_ms: u32,
    },
    /// The device fell silent in the middle of a session.
    #[error(
        "the device fell silent in the middle of the job, for {milliseconds} ms: \
         check cable and power, and run the job again"
    )]
    Lost {
        /// Milliseconds since the last frame of the device, in the time of the link.
        milliseconds: u64,
    },
    /// The port is gone.
    #[error("the port is gone ({reason}): was the cable pulled? Plug it in, and run the job again")]
    Unplugged {
        /// The reason that the system gives.
        reason: String,
    },
    /// The device took other bytes than were sent, although the check sum of every frame held.
    #[error(
        "the device took other points than were sent: their check sum is {found:#010x}, not {expected:#010x}. \
         The line is not at fault: reset the device, and if that does not help, do not trust it"
    )]
    PayloadDigest {
        /// Check sum that the device reports.
        found: u32,
        /// Check sum of the bytes that were sent.
        expected: u32,
    },
    /// The check sum of an answer is wrong, although the check sum of every frame held.
    #[error(
        "the device's answer has the check sum {found:#010x}, but it announces {expected:#010x}. \
         The line is not at fault: reset the device, and if that does not help, do not trust it"
    )]
    AnswerDigest {
        /// Check sum of the words received.
        found: u32,
        /// Check sum that the device announced.
        expected: u32,
    },
    /// The device claims more free room than its FIFO has.
    #[error(
        "the device claims {free} free bytes in a FIFO of {fifo}: \
         reset it, and if that does not help, do not trust it"
    )]
    Credit {
        /// Free bytes that the device claims.
        free: u32,
        /// Bytes of the FIFO.
        fifo: u32,
    },
    /// The device answers a command that it has not taken.
    #[error(
        "the device answers a command that ends at byte {awaited} of the session, but it has taken {taken} bytes: \
         reset it, and if that does not help, do not trust it"
    )]
    Unasked {
        /// Bytes of the session up to the end of the command.
        awaited: u64,
        /// Bytes that the device has acknowledged.
        taken: u64,
    },
    /// The identity of the core is not the one in the greeting.
    #[error(
        "the core says {found:#010x} in word {word} of its identity, but the greeting said {expected:#010x}: \
         reset the device, and if that does not help, do not trust it"
    )]
    Contradiction {
        /// Number of the word within the identity, from 0.
        word: usize,
        /// Word in the core's answer.
        found: u32,
        /// Word in the greeting.
        expected: u32,
    },
    /// An answer is longer than any answer to its command.
    #[error(
        "the device's answer has more than {due} words, the most for this command: \
         reset it, and if that does not help, do not trust it"
    )]
    Endless {
        /// Most words of an answer to this command.
        due: usize,
    },
    /// An answer ended with another number of words than it announced.
    #[error(
        "the device's answer announces {announced} words, but has {came}: \
         reset the device, and if that does not help, do not trust it"
    )]
    AnswerLength {
        /// Words of payload that the answer announced.
        announced: u32,
        /// Words of payload that came.
        came: usize,
    },
    /// The command cannot be sent over a serial link.
    #[error("{0}")]
    Command(&'static str),
}

impl SerialFault {
    /// The kind of this fault: whose fault it is.
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
