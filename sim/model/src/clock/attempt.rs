//! The state of an attempt: the cavity that grows round a root, or the star that is locked, and its visits in flight.

/// The cavity of one insertion, from the root visit on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Attempt {
    /// Number of visits that were pushed and have not completed.
    pub outstanding: u32,
    /// Number of entries in the ring.
    pub count: u32,
    /// Number of inner records.
    pub inners: u32,
    /// Number of locks in the log.
    pub logged: u32,
    /// Bit `y` says that the boundary has moved across one of the two edges that the cavity record of entry `y`
    /// brought. The root uses bits 0 and 1.
    pub half_open: u64,
    /// Whether the attempt aborts: its visits in flight complete first.
    pub drains: bool,
}

impl Attempt {
    /// Whether both edges that a cavity record brought have been passed, so that it is an inner record.
    pub(super) fn passes_last_edge(&mut self, cavity_entry: usize) -> bool {
        let bit = 1 << cavity_entry;
        let half = self.half_open & bit != 0;
        let root_half = cavity_entry == 0 && half && self.half_open & 2 == 0;
        self.half_open |= bit | u64::from(root_half) << 1;
        half && !root_half
    }
}
