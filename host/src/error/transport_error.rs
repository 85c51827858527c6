//! The error that every transport returns.

use std::error::Error as StdError;

use super::kind::ErrorKind;

/// The reason why words did not get through: the error that a [`Transport`](crate::Transport) returns.
///
/// A session wraps it in [`Error::Link`](crate::Error::Link) or [`Error::Timeout`](crate::Error::Timeout). Whoever
/// writes a transport returns the first three where they fit, and [`other`](Self::other) for everything else.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TransportError {
    /// The deadline passed before all words of the call were carried.
    #[error("the deadline passed after {done} of {wanted} words")]
    Timeout {
        /// Words carried before the deadline.
        done: usize,
        /// Words that the call asked for.
        wanted: usize,
    },
    /// The device ended its answer, but more words were expected.
    #[error("the device ended its answer after {done} of {wanted} words")]
    Closed {
        /// Words carried before the end.
        done: usize,
        /// Words that the call asked for.
        wanted: usize,
    },
    /// The operating system refused a call.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// The transport has found a fault, which has a type of its own.
    #[error("{source}")]
    Other {
        /// Kind of the fault.
        kind: ErrorKind,
        /// The fault, whose text is one sentence.
        source: Box<dyn StdError + Send + Sync>,
    },
}

impl TransportError {
    /// Makes an error of a fault that the transport has found: an error type of its own, or a sentence.
    pub fn other(kind: ErrorKind, source: impl Into<Box<dyn StdError + Send + Sync>>) -> Self {
        Self::Other { kind, source: source.into() }
    }

    /// The fault that the transport has found, if it is of type `F`.
    pub fn fault<F: StdError + 'static>(&self) -> Option<&F> {
        match self {
            Self::Other { source, .. } => source.downcast_ref(),
            _ => None,
        }
    }

    /// The kind of this error: whose fault it is.
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::Timeout { .. } => ErrorKind::Timeout,
            Self::Closed { .. } | Self::Io(_) => ErrorKind::Link,
            Self::Other { kind, .. } => *kind,
        }
    }
}
