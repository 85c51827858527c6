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
    /// Clock cycles from a `Read` accepted to its last word taken (2 words).
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
}

/// Words in the answer to `Counters`.
pub const COUNTER_WORDS: usize = 14;
