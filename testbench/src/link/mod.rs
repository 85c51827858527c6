//! The driver of the serial link in front of simulated boards, in virtual time, and the goodput that it reaches there.
//!
//! [`VirtualLine`] joins the protocol that runs over ports of the operating system to a board with its pins or without,
//! with faults and a delay each way in between. No real time is involved, so every run can be repeated.
//! [`VirtualEther`] does the same for the UDP link and a board behind the pins of its PHY. [`Served`] is a board behind
//! a pseudo-terminal, in real time.

mod goodput;
mod jobs;
mod served;
mod soak;
mod throughput;
mod virtual_ether;
mod virtual_line;

pub use goodput::{document, measure, Goodput, Way, RATES, TARGET};
pub use jobs::{is_one_mesh, random_points};
pub use served::Served;
pub use soak::{soak, Soak, SoakReport};
pub use throughput::{throughput_document, throughput_rows, Load};
pub use virtual_ether::{EtherTransport, VirtualEther};
pub use virtual_line::{VirtualLine, VirtualTransport};

use incircle_protocol::Config;
use incircle_sim::serial::{board_link, Board, PinBoard, QuickBoard};
use incircle_sim::SimError;

/// Level of detail at which a board is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Every clock of the pins.
    Pins,
    /// Bytes, and the core's clocks while it works.
    Bytes,
}

impl Detail {
    /// Name of the level in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pins => "pins",
            Self::Bytes => "bytes",
        }
    }

    /// Makes a board with the core of this configuration.
    ///
    /// # Errors
    /// The board is not part of this build.
    pub fn board(self, config: Config) -> Result<Box<dyn Board>, SimError> {
        Ok(match self {
            Self::Pins => Box::new(PinBoard::new(config)?),
            Self::Bytes => Box::new(QuickBoard::new(config, board_link(config))?),
        })
    }
}
