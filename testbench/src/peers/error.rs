//! Why there is no comparison.

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// The set cannot be made.
    #[error("{0}")]
    Generate(#[from] incircle_testkit::GenerateError),
    /// Our own work failed.
    #[error("{0}")]
    Ours(#[from] incircle::Error),
    /// A peer stopped in the middle, or answered nonsense.
    #[error("{peer}: {reason}")]
    Peer {
        /// Its name.
        peer: &'static str,
        /// What happened.
        reason: String,
    },
    /// The results cannot be printed.
    #[error("{0}")]
    Print(#[from] std::io::Error),
}
