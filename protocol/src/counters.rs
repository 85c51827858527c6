//! The event counters of a core. A reset and `Clear` set them to zero.

/// An event counter. The value is the index of the counter's first word in the answer to `Counters`.
///
/// All counters count modulo 2^32, except the three cycle counts, which have 64 bits, low word first. The model by
/// commands counts events only; its cycle counts are zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Counter {
    /// Clocks from the acceptance of a job's first point to the release of its last lock, summed over jobs (2 words).
    InsertCycles = 0,
    /// The part of `InsertCycles` in which the insertion engine was idle because no point had come (2 words).
    WaitCycles = 2,
    /// Clocks from the acceptance of a `Read` or `Triangles` until its last word was taken (2 words).
    ReadCycles = 4,
    /// Points inserted into the mesh, the first three included.
    Insertions = 6,
    /// Points equal to an earlier one.
    Duplicates = 7,
    /// Points refused: beyond the capacity, or after a collinear start.
    Refused = 8,
    /// Triangles visited by walks, the last of each walk included.
    WalkVisits = 9,
    /// Tests for conflict, in cavities and in solo insertions.
    Tests = 10,
    /// Triangles that cavities removed. Insertions whose list overflowed are not counted.
    CavityTriangles = 11,
    /// Insertions whose boundary list overflowed, and which became solo insertions.
    Overflows = 12,
    /// Flips of solo insertions.
    Flips = 13,
    /// Root visits: visits that read the root again, under its lock.
    RootVisits = 14,
    /// Visits that were repeated because the record was being written, its lock was held, or the context's own
    /// commit had not finished.
    Revisits = 15,
    /// Attempts that aborted because another context held a lock.
    Aborts = 16,
    /// Roots that no longer conflicted with the point when they were locked.
    RootRetries = 17,
    /// Times that a context acquired the priority.
    PrioritiesTaken = 18,
    /// Clocks in which a visit was issued, each of which uses the read port of the triangle memory.
    IssueCycles = 19,
    /// Clocks in which the write port of the triangle memory wrote a record or a neighbour.
    WriteCycles = 20,
    /// Clocks in which a commit was in progress.
    CommitCycles = 21,
    /// Clocks in which a lock was released.
    ReleaseCycles = 22,
    /// Shortest latency in clocks, from the time when a context takes a point to the write of its last record. Solo
    /// insertions and the first three points do not count; 0 if there was no other insertion.
    LatencyMin = 23,
    /// Longest latency, counted as for `LatencyMin`.
    LatencyMax = 24,
}

/// Number of words in the answer to `Counters`.
pub const COUNTER_WORDS: usize = 25;

/// Bits of a latency. Latencies count modulo 2^22, which is more than [`patience`](crate::patience) allows.
pub const LATENCY_BITS: u32 = 22;
/// Number of buckets in the histogram of latencies.
pub const LATENCY_BUCKETS: usize = 128;

/// The bucket of a latency in clocks. From 16 clocks on, every octave has eight buckets. The first bucket takes all
/// latencies below 18, the last all from 2^20 - 2^16 on.
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

/// The shortest latency of a bucket, in clocks.
pub const fn latency_of_bucket(bucket: usize) -> u32 {
    (8 + (bucket as u32 & 7)) << (bucket as u32 / 8 + 1)
}
