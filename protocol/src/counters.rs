//! Event counters, cleared by reset and by `Clear`.

/// One counter; its value is the index of its word in the answer to `Counters`.
///
/// All count modulo 2^32; the three cycle counts are 64 bits wide, low word first. The software model counts
/// events; its cycle counts are zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Counter {
    /// Clock cycles from a job's first point accepted to its last lock released, summed over jobs (2 words).
    InsertCycles = 0,
    /// Those of them in which the engine had no work because no point had come (2 words).
    WaitCycles = 2,
    /// Clock cycles from a `Read` or `Triangles` accepted to its last word taken (2 words).
    ReadCycles = 4,
    /// Points inserted into the mesh (the first three included).
    Insertions = 6,
    /// Points that fell onto an earlier one.
    Duplicates = 7,
    /// Points refused: past the capacity, or after a collinear start.
    Refused = 8,
    /// Triangles visited by walks, the located one included.
    WalkVisits = 9,
    /// Conflict tests: cavity tests and those of insertions done alone.
    Tests = 10,
    /// Triangles removed by cavities (insertions that overflowed not included).
    CavityTriangles = 11,
    /// Insertions whose boundary list overflowed; they were done alone, by flips.
    Overflows = 12,
    /// Flips of insertions done alone.
    Flips = 13,
    /// Visits that lock the located triangle and look at it again.
    RootVisits = 14,
    /// Visits made once more: a record being written, a lock waited for, the own commit not finished.
    Revisits = 15,
    /// Attempts given up because another context held a lock.
    Aborts = 16,
    /// Located triangles that no longer held the point when they were locked.
    RootRetries = 17,
    /// Times a context took the priority.
    PrioritiesTaken = 18,
    /// Clocks in which a visit was issued: the read port of the triangle memory.
    IssueCycles = 19,
    /// Clocks in which a record or a link was written: the write port.
    WriteCycles = 20,
    /// Clocks in which a commit was at work.
    CommitCycles = 21,
    /// Clocks in which a lock was released.
    ReleaseCycles = 22,
    /// Fewest and most clocks from a point taken by its context to its last record written. Points inserted alone and the first
    /// three are left out; 0 if there is no other.
    LatencyMin = 23,
    /// See `LatencyMin`.
    LatencyMax = 24,
}

/// Words in the answer to `Counters`.
pub const COUNTER_WORDS: usize = 25;

/// Bits of a latency: it counts modulo 2^22, more than [`patience`](crate::patience) allows.
pub const LATENCY_BITS: u32 = 22;
/// Buckets of the histogram of latencies.
pub const LATENCY_BUCKETS: usize = 128;

/// The bucket of a latency in clocks: eight to an octave from 16 clocks on; the first takes all below 18, the last all from 2^20 - 2^16 on.
pub const fn latency_bucket(clocks: u32) -> usize {
    if clocks < 16 {
        return 0;
    }
    let octave = u32::BITS - 1 - clocks.leading_zeros();
    let bucket = (octave - 4) * 8 + (clocks >> (octave - 3) & 7);
    if bucket as usize >= LATENCY_BUCKETS {
        LATENCY_BUCKETS - 1
    } else {
        bucket as usize
    }
}

/// The fewest clocks of a bucket.
pub const fn latency_of_bucket(bucket: usize) -> u32 {
    (8 + (bucket as u32 & 7)) << (bucket as u32 / 8 + 1)
}
