//! What can go wrong with a simulated core.

use verilated::{PortError, TraceError};

/// What a device did not do in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Awaited {
    /// Take command words.
    CommandWords,
    /// Give answer words.
    AnswerWords,
}

impl std::fmt::Display for Awaited {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::CommandWords => "took",
            Self::AnswerWords => "gave",
        })
    }
}

/// Why a simulated core did not do what was asked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SimError {
    /// Not one of the configurations this program was built with.
    #[error(
        "there is no simulated core {name:?} of {points} points with {contexts} contexts and {ring} boundary edges: choose one of {built}"
    )]
    NotBuilt {
        /// Name asked for.
        name: &'static str,
        /// Points asked for.
        points: u32,
        /// Contexts asked for.
        contexts: u32,
        /// Boundary edges asked for.
        ring: u32,
        /// The names there are.
        built: String,
    },
    /// No board of this configuration was built.
    #[error("there is no simulated board {name:?}: choose one of {built}")]
    NoBoard {
        /// Name asked for.
        name: &'static str,
        /// The names there are.
        built: String,
    },
    /// No card of this configuration was built, or it does not start.
    #[error("there is no simulated card {name:?} that starts: choose one of {built}, or the software model (--fast)")]
    NoCard {
        /// Configuration and bits of a beat.
        name: String,
        /// The names there are.
        built: String,
    },
    /// The clocks allowed have passed.
    #[error("the simulated core {awaited} {done} of {wanted} words in {clocks} clocks, {total} since its start: allow more clocks, or look at a waveform if it stands still")]
    Timeout {
        /// What it should have done.
        awaited: Awaited,
        /// Words that it did.
        done: usize,
        /// Words that it should have.
        wanted: usize,
        /// Clocks of this call.
        clocks: u64,
        /// Clocks since the device was made.
        total: u64,
    },
    /// The model lacks a port of the two streams.
    #[error(transparent)]
    Port(#[from] PortError),
    /// No waveform can be written.
    #[error(transparent)]
    Trace(#[from] TraceError),
}
