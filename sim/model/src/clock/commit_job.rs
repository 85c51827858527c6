//! The job of the commit path, passed from the attempts through the ring reader to the commit and the release.

/// A complete ring, to be committed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CommitJob {
    pub context: usize,
    /// Id of the new vertex.
    pub vertex: u32,
    /// Number of inner records.
    pub inners: u32,
    /// Number of locks in the log.
    pub locks: u32,
    /// Clock in which the context took the point.
    pub since: u32,
}
