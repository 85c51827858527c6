//! What a device can say that no sound device says.

use incircle_protocol::{MAX_MODEL_POINTS, MIN_POINTS};

use incircle_geometry::Point;

/// Most contexts of a device: `Clear` names them in a byte.
pub(crate) const MAX_DEVICE_CONTEXTS: u32 = 255;

/// A fault in the answer of a device. A hostile or broken device ends in one of these, never in a panic.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DeviceFault {
    /// The identity does not start with the project's letters.
    #[error("its identity starts with {found:#010x}, not {expected:#010x}, so it is no incircle device")]
    Magic {
        /// Word received.
        found: u32,
        /// Word of every incircle device.
        expected: u32,
    },
    /// It speaks another major version of the protocol, or an older minor one.
    #[error("it speaks protocol {}.{}, this library {}.{}", found >> 16, found & 0xffff, expected >> 16, expected & 0xffff)]
    ProtocolVersion {
        /// Version of the device.
        found: u32,
        /// Version of this library.
        expected: u32,
    },
    /// It claims coordinate bits that no device has.
    #[error("it claims {0} coordinate bits, but 1 to 31 are possible")]
    CoordBits(u32),
    /// It claims a capacity that no device has.
    #[error("it claims to hold {0} points, but {MIN_POINTS} to {MAX_MODEL_POINTS} are possible")]
    Capacity(u32),
    /// It claims a number of contexts that no device has.
    #[error("it claims {0} contexts, but 1 to {MAX_DEVICE_CONTEXTS} are possible")]
    Contexts(u32),
    /// The first word of an answer is none.
    #[error("the answer starts with {found:#010x}, which is no header of an answer to opcode {opcode}")]
    Header {
        /// Word received.
        found: u32,
        /// Opcode of the command.
        opcode: u8,
    },
    /// It reports that the command failed.
    #[error("it reports status {status} ({meaning})")]
    Status {
        /// Status byte.
        status: u8,
        /// The status in words.
        meaning: &'static str,
    },
    /// The payload has another length than the command asks for.
    #[error("the answer announces {found} words where {expected} are due")]
    PayloadLength {
        /// Words announced.
        found: u32,
        /// Words due.
        expected: u32,
    },
    /// A count of the insertion report is not what the points sent make it.
    #[error("it counts {found} {what} where {expected} are due")]
    Count {
        /// What is counted.
        what: &'static str,
        /// Count received.
        found: u32,
        /// Count due.
        expected: u32,
    },
    /// A record names a vertex that does not exist.
    #[error("record {record} names vertex {vertex}, but only {points} points were sent")]
    VertexOutOfRange {
        /// Number of the record.
        record: usize,
        /// Vertex id received.
        vertex: u32,
        /// Points sent.
        points: usize,
    },
    /// A record names a neighbour that does not exist.
    #[error("record {record} names record {neighbor} as a neighbour, but there are only {records}")]
    NeighborOutOfRange {
        /// Number of the record.
        record: usize,
        /// Record id received.
        neighbor: u32,
        /// Records of the mesh.
        records: usize,
    },
    /// A record is locked though no insertion is under way.
    #[error("record {record} is locked though no insertion is under way")]
    Locked {
        /// Number of the record.
        record: usize,
    },
    /// Bits of a narrow record that hold nothing are set.
    #[error("word {place} of record {record} is {word:#010x}, but its bits above the two ids must be 0")]
    SpareBits {
        /// Number of the record.
        record: usize,
        /// Which of its words, from 0.
        place: usize,
        /// The word received.
        word: u32,
    },
    /// The half of a word behind the last packed vertex is set.
    #[error("the last word of the triangles up to record {record} is {word:#010x}, but its high half must be 0")]
    SpareHalf {
        /// Number of the last record.
        record: usize,
        /// The word received.
        word: u32,
    },
    /// A record of a batch has vertices of several jobs.
    #[error("record {record} of a batch has the vertices {}, {}, {}, which belong to several jobs", vertices[0], vertices[1], vertices[2])]
    MixedJobs {
        /// Number of the record.
        record: usize,
        /// Vertex ids received.
        vertices: [u32; 3],
    },
    /// A record has one vertex twice.
    #[error("record {record} has a vertex twice")]
    RepeatedVertex {
        /// Number of the record.
        record: usize,
    },
    /// A finite triangle does not turn counter-clockwise.
    #[error("record {record}, the triangle {} {} {}, is not counter-clockwise", corners[0], corners[1], corners[2])]
    Orientation {
        /// Number of the record.
        record: usize,
        /// Its corners.
        corners: [Point; 3],
    },
    /// One triangle came twice.
    #[error("the triangle of the points {}, {}, {} came twice", triangle[0], triangle[1], triangle[2])]
    TriangleTwice {
        /// Input indices of its corners.
        triangle: [u32; 3],
    },
    /// The ghosts do not close one hull.
    #[error(
        "its {ghosts} ghost records do not close one hull: the edge that leaves point {point} is missing or doubled"
    )]
    OpenHull {
        /// Ghost records received.
        ghosts: usize,
        /// Input index of the point where the hull breaks.
        point: u32,
    },
    /// The triangles do not fill the hull.
    #[error("its triangles cover {triangles} half grid squares, its hull {hull}")]
    Area {
        /// Twice the area of all triangles.
        triangles: i128,
        /// Twice the area of the hull.
        hull: i128,
    },
}
