//! Faults of cards, in sentences that say what to do.

use std::time::Duration;

use incircle_protocol::{MAGIC, STREAM_VERSION};

use crate::error::{DeviceFault, ErrorKind, TransportError};

/// The reason why a card cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CardFault {
    /// A file of a card of the driver does not exist.
    #[error("there is no {path}{}", known_cards(cards))]
    Missing {
        /// File that does not exist.
        path: String,
        /// Addresses of the cards that the driver has found.
        cards: Vec<String>,
    },
    /// A file of a card in a directory of its own does not exist. The driver has no part in this.
    #[error(
        "there is no {path}: name the directory with the files of a card, such as that of a simulated one \
         ('incircle-sim serve-pcie --dir DIR'), or a number as in \"pcie:0\""
    )]
    MissingInDirectory {
        /// File that does not exist.
        path: String,
    },
    /// The user has no permission to use the card.
    #[error(
        "you may not use {path}: run as root, or add a udev rule, such as \
         'SUBSYSTEM==\"xdma\", MODE=\"0660\", GROUP=\"plugdev\"' in /etc/udev/rules.d"
    )]
    NoPermission {
        /// File that the system refused to open.
        path: String,
    },
    /// Another program uses the card, or a call of this one that has not returned.
    #[error(
        "{path} is locked: end the other program that uses the card ('fuser' or 'lsof' says which), \
         or wait for a call of this one that has not returned"
    )]
    Busy {
        /// File with the registers, which is locked.
        path: String,
    },
    /// The files of the card are there, but the driver answers as if the card were not.
    #[error("{path} says \"{reason}\": load the card, rescan the bus, and look at 'dmesg'")]
    NoCard {
        /// File that the driver refused to open.
        path: String,
        /// The reason that the system gives.
        reason: String,
    },
    /// Opening the files took too long.
    #[error("its files did not open within {} s: look at 'dmesg', and reload the driver", within.as_secs_f64())]
    Hangs {
        /// Time that was allowed.
        within: Duration,
    },
    /// The system refused to open a file for another reason.
    #[error("{path}: {reason}: check the card and its driver")]
    Other {
        /// File that the system refused to open.
        path: String,
        /// The reason that the system gives.
        reason: String,
    },
}

fn known_cards(cards: &[String]) -> String {
    if cards.is_empty() {
        ": the driver XDMA has found no card, so load it ('modprobe xdma'), and look at 'lspci' and 'dmesg'".to_owned()
    } else {
        format!(": choose one of {}", cards.join(", "))
    }
}

/// The reason why a card that was opened failed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PcieFault {
    /// A transfer took longer than the driver allows.
    #[error(
        "the card's DMA engine timed out in {call} (errno {errno}), and a reset did not help: \
         look at 'dmesg', and power-cycle the card"
    )]
    EngineTimedOut {
        /// Noun for the call under way.
        call: &'static str,
        /// Error number that the driver returned.
        errno: i32,
    },
    /// The card is no longer on the bus.
    #[error(
        "the card is gone: its registers read as all ones; check its seat and power, then rescan the bus or restart"
    )]
    Gone,
    /// The card has forgotten a command, as after a reset by another program.
    #[error("the card has forgotten the command under way, as after a reset: end the other program that resets it")]
    Forgotten,
    /// The card stays in its reset.
    #[error(
        "the card did not come out of its reset within {} s (status {status:#x}): load it again, and power-cycle it",
        within.as_secs_f64()
    )]
    Reset {
        /// Time that was allowed.
        within: Duration,
        /// Value of the status register.
        status: u32,
    },
    /// A call of the system does not return.
    #[error(
        "{call} did not return within {} s and keeps the card locked: look at 'dmesg', and reload the driver",
        within.as_secs_f64()
    )]
    Hangs {
        /// Noun for the call under way.
        call: &'static str,
        /// Time that was allowed.
        within: Duration,
    },
    /// The system refused a call.
    #[error("{call} failed with \"{reason}\": look at 'dmesg', and reload the driver")]
    Call {
        /// Noun for the call under way.
        call: &'static str,
        /// The reason that the system gives.
        reason: String,
    },
    /// A transfer moved no byte.
    #[error("{call} moved no byte, as if the stream had ended: check that these are the files of a DMA engine")]
    Ended {
        /// Noun for the call under way.
        call: &'static str,
    },
    /// The registers do not begin with the word that marks an incircle device.
    #[error(
        "its registers begin with {found:#010x}, not {MAGIC:#010x}: \
         load the card with incircle, or choose another card"
    )]
    Magic {
        /// First register of the card.
        found: u32,
    },
    /// The card has another major version of the stream device than this library, or an older minor version.
    #[error(
        "it has version {}.{} of the stream device, but this library has {}.{}: update {}",
        found >> 16, found & 0xffff, STREAM_VERSION >> 16, STREAM_VERSION & 0xffff,
        if *found > STREAM_VERSION { "this program" } else { "the card" }
    )]
    Version {
        /// Version of the card, `major << 16 | minor`.
        found: u32,
    },
    /// A register has a value that no sound card has.
    #[error(
        "its register {name} reads {found}, but {wanted} are possible: \
         load the card again, and if that does not help, do not trust it"
    )]
    Register {
        /// Name of the register.
        name: &'static str,
        /// Value that was read.
        found: u32,
        /// Values that a sound card may have.
        wanted: &'static str,
    },
    /// The identity in the registers is not one of a sound device.
    #[error("in its registers {0}: update the card or this program")]
    Identity(DeviceFault),
    /// An answer has more words than it announced.
    #[error(
        "an answer of {announced} words has {came} or more: \
         load the card again, and if that does not help, do not trust it"
    )]
    Endless {
        /// Words that the answer announced.
        announced: u64,
        /// Words that came so far.
        came: u64,
    },
}

impl PcieFault {
    /// The kind of this fault: whose fault it is.
    pub const fn kind(&self) -> ErrorKind {
        match self {
            Self::Magic { .. } => ErrorKind::DeviceNotFound,
            Self::EngineTimedOut { .. }
            | Self::Gone
            | Self::Forgotten
            | Self::Reset { .. }
            | Self::Call { .. }
            | Self::Ended { .. } => ErrorKind::Link,
            Self::Hangs { .. } => ErrorKind::Timeout,
            Self::Version { .. } | Self::Register { .. } | Self::Identity(_) | Self::Endless { .. } => {
                ErrorKind::Device
            }
        }
    }

    /// Whether a reset may help. It may after an answer that is too long: a reset by another program cuts an answer
    /// short, and the next answers come in the place of its rest.
    pub(super) const fn is_passing(&self) -> bool {
        matches!(self, Self::EngineTimedOut { .. } | Self::Forgotten | Self::Endless { .. })
    }
}

impl From<PcieFault> for TransportError {
    fn from(fault: PcieFault) -> Self {
        Self::other(fault.kind(), fault)
    }
}
