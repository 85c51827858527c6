//! What can go wrong with a card, in sentences that say what to do.

use std::time::Duration;

use incircle_protocol::{MAGIC, STREAM_VERSION};

use crate::error::{DeviceFault, ErrorKind, TransportError};

/// Why a card cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CardFault {
    /// One of its files does not exist.
    #[error("there is no {path}{}", known_cards(cards))]
    Missing {
        /// The file.
        path: String,
        /// The cards there are.
        cards: Vec<String>,
    },
    /// A file of a card in a directory of its own does not exist, so this is no matter of the driver.
    #[error("there is no {path}: name the directory with the files of a card, such as that of a simulated one ('incircle-sim serve-pcie --dir DIR'), or a number as in \"pcie:0\"")]
    MissingInDirectory {
        /// The file.
        path: String,
    },
    /// The user may not use it.
    #[error(
        "you may not use {path}: run as root, or add a udev rule, such as 'SUBSYSTEM==\"xdma\", MODE=\"0660\", GROUP=\"plugdev\"' in \
         /etc/udev/rules.d"
    )]
    NoPermission {
        /// The file.
        path: String,
    },
    /// Somebody else uses it.
    #[error(
        "{path} is locked: end the other program that uses the card ('fuser' or 'lsof' says which), or wait for a call of this one \
         that has not returned"
    )]
    Busy {
        /// The file with the registers.
        path: String,
    },
    /// The card is there, and its driver answers as if it were not.
    #[error("{path} says \"{reason}\": load the card, rescan the bus, and look at 'dmesg'")]
    NoCard {
        /// The file.
        path: String,
        /// What the system says.
        reason: String,
    },
    /// Opening takes too long.
    #[error("its files have not opened within {} s: look at 'dmesg', and reload the driver", within.as_secs_f64())]
    Hangs {
        /// The time allowed.
        within: Duration,
    },
    /// Anything else.
    #[error("{path}: {reason}: check the card and its driver")]
    Other {
        /// The file.
        path: String,
        /// What the system says.
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

/// Why a card failed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PcieFault {
    /// The driver's own time for a transfer is over.
    #[error(
        "the card's DMA engine timed out in {call} (errno {errno}), and a reset was no help: look at 'dmesg', and power-cycle the card"
    )]
    EngineTimedOut {
        /// What was under way.
        call: &'static str,
        /// What the driver returned.
        errno: i32,
    },
    /// It fell off the bus.
    #[error(
        "the card is gone: its registers read as all ones; check its seat and power, then rescan the bus or restart"
    )]
    Gone,
    /// It has forgotten a command.
    #[error("the card has forgotten the command under way, as after a reset: end the other program that resets it")]
    Forgotten,
    /// It is still in a reset.
    #[error("the card has not come out of its reset within {} s (status {status:#x}): load it again, and power-cycle it", within.as_secs_f64())]
    Reset {
        /// The time allowed.
        within: Duration,
        /// The status register.
        status: u32,
    },
    /// A call of the system does not return.
    #[error("{call} has not returned within {} s: it is left behind, and keeps the card locked; look at 'dmesg', and reload the driver", within.as_secs_f64())]
    Hangs {
        /// What was under way.
        call: &'static str,
        /// The time allowed.
        within: Duration,
    },
    /// The system refused a call.
    #[error("{call} failed with \"{reason}\": look at 'dmesg', and reload the driver")]
    Call {
        /// What was under way.
        call: &'static str,
        /// What the system says.
        reason: String,
    },
    /// A transfer moved nothing.
    #[error("{call} moved no byte, as if the stream had ended: check that these are the files of a DMA engine")]
    Ended {
        /// What was under way.
        call: &'static str,
    },
    /// The registers do not begin with the project's letters.
    #[error("its registers begin with {found:#010x}, not {MAGIC:#010x}: load the card with incircle, or choose another card")]
    Magic {
        /// Register read.
        found: u32,
    },
    /// It is of another major version.
    #[error(
        "it has version {}.{} of the stream device, this library {}.{}: update {}",
        found >> 16, found & 0xffff, STREAM_VERSION >> 16, STREAM_VERSION & 0xffff,
        if *found > STREAM_VERSION { "this program" } else { "the card" }
    )]
    Version {
        /// Register read.
        found: u32,
    },
    /// A register has a value that no sound card has.
    #[error("its register {name} reads {found}, but {wanted} are possible: load the card again, and if it persists distrust it")]
    Register {
        /// Name of the register.
        name: &'static str,
        /// Register read.
        found: u32,
        /// What would be right.
        wanted: &'static str,
    },
    /// The identity in its registers is none.
    #[error("in its registers {0}: update the card or this program")]
    Identity(DeviceFault),
    /// An answer goes on where it must have ended.
    #[error("an answer of {announced} words has {came} or more: load the card again, and if it persists distrust it")]
    Endless {
        /// Words it announced.
        announced: u64,
        /// Words that came.
        came: u64,
    },
}

impl PcieFault {
    /// Whose fault it is.
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

    /// True if a reset may help.
    pub(super) const fn is_passing(&self) -> bool {
        matches!(self, Self::EngineTimedOut { .. } | Self::Forgotten)
    }
}

impl From<PcieFault> for TransportError {
    fn from(fault: PcieFault) -> Self {
        Self::other(fault.kind(), fault)
    }
}
