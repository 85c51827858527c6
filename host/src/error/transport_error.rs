//! Why words did not get through.

use std::error::Error as StdError;

use super::kind::ErrorKind;

/// Why words did not get through.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TransportError {
    /// The deadline passed with this many words of the call done.
    #[error("the deadline passed after {done} of {wanted} words")]
    Timeout {
        /// Words carried before the deadline.
        done: usize,
        /// Words the call asked for.
        wanted: usize,
    },
    /// The device has nothing more to say, and more was expected.
    #[error("the device ended its answer after {done} of {wanted} words")]
    Closed {
        /// Words carried before the end.
        done: usize,
        /// Words the call asked for.
        wanted: usize,
    },
    /// The operating system refused.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// The way itself has found what is wrong, and says it in a type of its own.
    #[error("{source}")]
    Other {
        /// Whose fault it is.
        kind: ErrorKind,
        /// What is wrong, in one sentence.
        source: Box<dyn StdError + Send + Sync>,
    },
}

impl TransportError {
    /// What a way says of itself: an error of its own type, or a sentence.
    pub fn other(kind: ErrorKind, source: impl Into<Box<dyn StdError + Send + Sync>>) -> Self {
        Self::Other { kind, source: source.into() }
    }

    /// The fault that a way has found, if it is of this type.
    pub fn fault<F: StdError + 'static>(&self) -> Option<&F> {
        match self {
            Self::Other { source, .. } => source.downcast_ref(),
            _ => None,
        }
    }

    /// Whose fault it is.
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::Timeout { .. } => ErrorKind::Timeout,
            Self::Closed { .. } | Self::Io(_) => ErrorKind::Link,
            Self::Other { kind, .. } => *kind,
        }
    }
}
