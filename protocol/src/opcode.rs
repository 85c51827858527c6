//! The numbers of commands.

/// The number of a command, in the top byte of its first word. The other bits of that word are zero unless the
/// command's own entry says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Opcode {
    /// Ask the device for its [`Identity`](crate::Identity). No arguments.
    Hello = 1,
    /// Forget all points, triangles and counters, and begin the job that a [`Clear`](crate::Clear) describes. No
    /// arguments, no payload. The time does not depend on what the device holds.
    Clear = 2,
    /// Insert points. The arguments are the number of points and the points themselves. The answer, an
    /// [`InsertReport`](crate::InsertReport), comes when the last point is in.
    Insert = 3,
    /// Read triangle records. The arguments are the first id and the number of records. The answer has the records, or
    /// [`Status::BadRange`](crate::Status::BadRange) and no payload if the range goes beyond the last record.
    Read = 4,
    /// Read the counters. No arguments; the answer has [`COUNTER_WORDS`](crate::COUNTER_WORDS) words.
    Counters = 5,
    /// Read the histogram of insertion latencies. No arguments; the answer has one word for each of the
    /// [`LATENCY_BUCKETS`](crate::LATENCY_BUCKETS) buckets.
    Latencies = 6,
    /// Read the vertices of triangle records without their neighbours. The arguments are those of [`Opcode::Read`]; the
    /// answer has the ids as [`Layout::triangles_words`](crate::Layout::triangles_words) packs them.
    Triangles = 7,
    /// Say what places are: the run's items are points. This run and the next five are for devices with the feature
    /// [`FEATURE_RUNS`](crate::FEATURE_RUNS). The first argument of each is the number of items, which follow.
    Locate = 8,
    /// Say which triangles hold places, and what each corner weighs there: the items are points.
    Interpolate = 9,
    /// Say which vertices are nearest to places; of vertices at the same distance, that with the smaller x, then y. The
    /// items are points.
    Nearest = 10,
    /// Insert points as vertices that the host chooses: an item is a vertex that is not in the mesh, and its point.
    InsertAs = 11,
    /// Delete vertices: the items are vertices.
    Delete = 12,
    /// Move vertices: an item is a vertex, and the point to which it moves.
    Move = 13,
}

impl Opcode {
    /// The opcode of this number, if there is one.
    pub const fn from_u8(value: u8) -> Option<Self> {
        Some(match value {
            1 => Self::Hello,
            2 => Self::Clear,
            3 => Self::Insert,
            4 => Self::Read,
            5 => Self::Counters,
            6 => Self::Latencies,
            7 => Self::Triangles,
            8 => Self::Locate,
            9 => Self::Interpolate,
            10 => Self::Nearest,
            11 => Self::InsertAs,
            12 => Self::Delete,
            13 => Self::Move,
            _ => return None,
        })
    }
}
