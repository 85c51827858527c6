//! The errors of a simulated core.

use verilated::{PortError, TraceError};

/// The part of an exchange that a device did not finish in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Awaited {
    /// The device was to take command words.
    CommandWords,
    /// The device was to give answer words.
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

/// The reason why a simulated core did not do what was asked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SimError {
    /// The configuration is none of those with which this program was built.
    #[error(
        "there is no simulated core {name:?} of {points} points with {contexts} contexts and {ring} boundary edges: \
         choose one of {built}"
    )]
    NotBuilt {
        /// Name that was asked for.
        name: &'static str,
        /// Number of points that was asked for.
        points: u32,
        /// Number of contexts that was asked for.
        contexts: u32,
        /// Length of the boundary lists that was asked for.
        ring: u32,
        /// Names of the configurations that were built.
        built: String,
    },
    /// No core of this configuration with runs was built.
    #[error(
        "there is no simulated core {name:?} with runs: choose {built}, or the back end clock, which has all of them"
    )]
    NoRuns {
        /// Name that was asked for.
        name: &'static str,
        /// Names of the configurations that were built.
        built: String,
    },
    /// No board of this configuration was built.
    #[error("there is no simulated board {name:?}: choose one of {built}")]
    NoBoard {
        /// Name that was asked for.
        name: &'static str,
        /// Names of the configurations that were built.
        built: String,
    },
    /// No card of this configuration was built, or the card does not start.
    #[error("there is no simulated card {name:?} that starts: choose one of {built}, or the software model (--fast)")]
    NoCard {
        /// Name of the configuration and bits of a beat.
        name: String,
        /// Names of the cards that were built.
        built: String,
    },
    /// The allowed clocks have passed.
    #[error(
        "the simulated core {awaited} {done} of {wanted} words in {clocks} clocks, {total} since its start: allow more \
         clocks, or record a waveform to see why it stands still"
    )]
    Timeout {
        /// The part of the exchange that was not finished.
        awaited: Awaited,
        /// Number of words that passed.
        done: usize,
        /// Number of words that should have passed.
        wanted: usize,
        /// Number of clocks of this call.
        clocks: u64,
        /// Number of clocks since the device was made.
        total: u64,
    },
    /// The core cannot write waveforms.
    #[error("the simulated core {name} cannot write waveforms: make it by SimDevice::traced")]
    NotTraced {
        /// Name of the core.
        name: &'static str,
    },
    /// There is no job number 0.
    #[error("a waveform of job 0 was asked for: jobs count from 1")]
    NoJob,
    /// The model has no port of the expected name.
    #[error(transparent)]
    Port(#[from] PortError),
    /// The waveform cannot be written.
    #[error(transparent)]
    Trace(#[from] TraceError),
}
