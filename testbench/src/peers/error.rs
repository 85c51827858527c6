//! The reasons why there is no comparison.

/// The reasons why there is no comparison.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// The set cannot be made.
    #[error("{0}")]
    Generate(#[from] incircle_testkit::GenerateError),
    /// Our own triangulator failed.
    #[error("{0}")]
    Ours(#[from] incircle::Error),
    /// A peer stopped in the middle of a run, or its answer is malformed.
    #[error("{peer}: {reason}")]
    Peer {
        /// Name of the peer.
        peer: &'static str,
        /// The event in words.
        reason: String,
    },
    /// The results cannot be printed.
    #[error("{0}")]
    Print(#[from] std::io::Error),
}
