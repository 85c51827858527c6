//! Faults of UDP links, in sentences that say what to do.

use crate::error::{DeviceFault, ErrorKind, TransportError};

/// The reason why a link over a network failed.
///
/// Datagrams that are lost, doubled, swapped, late or damaged are repaired. If there are too many of them, the job ends
/// in [`Silent`](Self::Silent), [`Lost`](Self::Lost), [`Reset`](Self::Reset), or at its deadline.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum UdpFault {
    /// The name of the host has no IPv4 address.
    #[error("the host \"{host}\" has no IPv4 address that is known here ({reason}): check the name")]
    Unknown {
        /// Name in the address of the device.
        host: String,
        /// The reason that the system gives.
        reason: String,
    },
    /// The system refused a call.
    #[error("the network refuses to {what} ({reason}): check the network of this machine and the address")]
    Network {
        /// The call, as in "to send".
        what: &'static str,
        /// The reason that the system gives.
        reason: String,
    },
    /// The machine at the address says that nobody listens at the port.
    #[error("the machine is there, but nothing listens at UDP port {port}: check the port, or start the device")]
    Refused {
        /// UDP port.
        port: u16,
    },
    /// No datagram came back.
    #[error(
        "nothing answers within {milliseconds} ms: check address and cable (`incircle devices --network` lists \
         the devices that hear a broadcast), and that the board has power and its configuration"
    )]
    Silent {
        /// Milliseconds for which the host greeted.
        milliseconds: u64,
    },
    /// Another host has a session.
    #[error(
        "another program has a session with the device, and kept it for {milliseconds} ms: \
         wait until its work is done, or end it"
    )]
    Busy {
        /// Milliseconds for which the host asked.
        milliseconds: u64,
    },
    /// The greeting does not start with the word that marks an incircle device.
    #[error("the greeting starts with {found:#010x}, not {expected:#010x}: this is not an incircle device")]
    Magic {
        /// First word of the greeting received.
        found: u32,
        /// First word of the greeting of every incircle device.
        expected: u32,
    },
    /// The device speaks another major version of the UDP link than this library, or an older minor version.
    #[error("the device speaks version {}.{} of the link, but this library speaks {}.{}: update the {}",
        found >> 16, found & 0xffff, expected >> 16, expected & 0xffff,
        if found < expected { "device" } else { "host's incircle" })]
    Version {
        /// Version of the device, `major << 16 | minor`.
        found: u32,
        /// Version of this library, `major << 16 | minor`.
        expected: u32,
    },
    /// A number in the greeting is smaller or larger than on any sound device.
    #[error("the device claims {found} {what}, but a sound device has {least} to {most}: do not trust it")]
    Greeting {
        /// Noun for the things claimed.
        what: &'static str,
        /// Number that the device claims.
        found: u32,
        /// Least number of a sound device.
        least: u32,
        /// Largest number of a sound device.
        most: u32,
    },
    /// The identity of the core in the greeting is not one of a sound device.
    #[error("{0}")]
    Identity(#[from] DeviceFault),
    /// The device has forgotten the session.
    #[error(
        "the device lost the session in the middle of the job, since it was reset or heard nothing \
         for {silence_ms} ms: its memory is empty now, so run the job again"
    )]
    Reset {
        /// Silence of the device in milliseconds: the time without a datagram after which it forgets the session.
        silence_ms: u32,
    },
    /// The device fell silent in the middle of a session.
    #[error(
        "the device fell silent in the middle of the job, for {milliseconds} ms: \
         check cable and power, and run the job again"
    )]
    Lost {
        /// Milliseconds since the last datagram of the device.
        milliseconds: u64,
    },
    /// The device took other words than were sent, although the check sum of every datagram held.
    #[error(
        "the device took other points than were sent: their check sum is {found:#010x}, not {expected:#010x}. \
         The network is not at fault: reset the device, and if that does not help, do not trust it"
    )]
    PayloadDigest {
        /// Check sum that the device reports.
        found: u32,
        /// Check sum of the words that were sent.
        expected: u32,
    },
    /// The check sum of an answer is wrong, although the check sum of every datagram held.
    #[error(
        "the device's answer has the check sum {found:#010x}, but it announces {expected:#010x}. \
         The network is not at fault: reset the device, and if that does not help, do not trust it"
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
        "the device sends answer {number}, but it has not taken the command yet: \
         reset it, and if that does not help, do not trust it"
    )]
    Unasked {
        /// Number of the answer.
        number: u64,
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
    /// An answer has another number of words than it announced, or than its command may bring.
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
    /// The command cannot be sent over a network.
    #[error("{0}")]
    Command(&'static str),
}

impl UdpFault {
    /// The kind of this fault: whose fault it is.
    pub const fn kind(&self) -> ErrorKind {
        match self {
            Self::Unknown { .. }
            | Self::Network { .. }
            | Self::Refused { .. }
            | Self::Silent { .. }
            | Self::Busy { .. }
            | Self::Magic { .. } => ErrorKind::DeviceNotFound,
            Self::Reset { .. } | Self::Lost { .. } | Self::Command(_) => ErrorKind::Link,
            Self::Version { .. }
            | Self::Greeting { .. }
            | Self::Identity(_)
            | Self::PayloadDigest { .. }
            | Self::AnswerDigest { .. }
            | Self::Credit { .. }
            | Self::Unasked { .. }
            | Self::Contradiction { .. }
            | Self::AnswerLength { .. } => ErrorKind::Device,
        }
    }
}

impl From<UdpFault> for TransportError {
    fn from(fault: UdpFault) -> Self {
        Self::other(fault.kind(), fault)
    }
}
