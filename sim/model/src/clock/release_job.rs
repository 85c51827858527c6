//! The job of the release, passed from the attempts and from the fill of holes.

/// The locks of an attempt, to be released.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReleaseJob {
    pub context: usize,
    /// Number of locks in the log, at least one.
    pub locks: u32,
}
