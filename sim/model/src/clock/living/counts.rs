//! Numbers of events of the last run.

/// What a run of the living engine did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RunCounts {
    /// Number of clocks from the opcode to the last word of the answer.
    pub clocks: u64,
    /// Number of visits, of all kinds.
    pub visits: u64,
    /// Number of visits of walks and of roots.
    pub walk_visits: u64,
    /// Number of attempts that met a lock of another context.
    pub aborts: u64,
    /// Number of visits that were made again because the context with the priority waited for a lock.
    pub waits: u64,
    /// Number of roots that had changed under their lock.
    pub root_retries: u64,
    /// Number of moves that wrote the point alone.
    pub moved_in_place: u64,
    /// Number of insertions whose boundary was longer than the list.
    pub solos: u64,
    /// Number of writes of records.
    pub writes: u64,
    /// For each item, in the order in which they ended, the number of clocks from its start to its end.
    pub latencies: Vec<u32>,
}
