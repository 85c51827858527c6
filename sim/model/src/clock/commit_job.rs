//! The job of the commit path: a finished boundary ring.

/// A finished ring, to be committed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CommitJob {
    pub context: usize,
    /// The new vertex.
    pub vertex: u32,
    /// Inner triangles.
    pub inners: u32,
    /// Locks in the log.
    pub locks: u32,
    /// When the point was taken.
    pub since: u32,
}
