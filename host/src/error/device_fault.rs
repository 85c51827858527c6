//! Faults in the answers of a device.

use incircle_protocol::{MAX_MODEL_POINTS, MIN_POINTS, OLDEST_PROTOCOL_VERSION};

use incircle_geometry::Point;

/// Most contexts of a device, since `Clear` has a byte for their number.
pub(crate) const MAX_DEVICE_CONTEXTS: u32 = 255;
/// Most engines of a device, since the header of an answer has a byte for their number.
pub(crate) const MAX_DEVICE_ENGINES: u32 = 256;

/// A fault in the answer of a device: something that no sound device says.
///
/// Every answer is checked before it is used, so a hostile or broken device ends in one of these, never in a panic. The
/// checks on the way are cheap ones; [`Mesh::verify`](crate::Mesh::verify) proves that a mesh is Delaunay.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DeviceFault {
    /// The identity does not start with the word that marks an incircle device.
    #[error("its identity starts with {found:#010x}, not {expected:#010x}, so it is not an incircle device")]
    Magic {
        /// First word of the identity received.
        found: u32,
        /// First word of the identity of every incircle device.
        expected: u32,
    },
    /// The device speaks a version of the protocol that this library does not speak.
    #[error(
        "it speaks version {}.{} of the protocol, but this library speaks {}.{} to {}.{}",
        found >> 16, found & 0xffff, OLDEST_PROTOCOL_VERSION >> 16, OLDEST_PROTOCOL_VERSION & 0xffff,
        expected >> 16, expected & 0xffff
    )]
    ProtocolVersion {
        /// Version of the device, `major << 16 | minor`.
        found: u32,
        /// Newest version of this library, `major << 16 | minor`.
        expected: u32,
    },
    /// The device claims a number of coordinate bits that no device has.
    #[error("it claims {0} coordinate bits, but 1 to 31 are possible")]
    CoordBits(u32),
    /// The device claims a capacity that no device has.
    #[error("it claims to hold {0} points, but {MIN_POINTS} to {MAX_MODEL_POINTS} are possible")]
    Capacity(u32),
    /// The device claims a number of contexts that no device has.
    #[error("it claims {0} contexts, but 1 to {MAX_DEVICE_CONTEXTS} are possible")]
    Contexts(u32),
    /// The device claims a number of engines that no device has.
    #[error("it claims {0} engines, but 1 to {MAX_DEVICE_ENGINES} are possible")]
    Engines(u32),
    /// The first word of an answer is not the header of an answer to this command.
    #[error("the answer starts with {found:#010x}, which is not the header of an answer to opcode {opcode}")]
    Header {
        /// First word of the answer received.
        found: u32,
        /// Opcode of the command that was sent.
        opcode: u8,
    },
    /// All engines got stuck over one job.
    #[error("each of its {engines} engines got stuck over the job")]
    AllStuck {
        /// Number of engines of the device.
        engines: u32,
    },
    /// The device reports that the command failed.
    #[error("it reports status {status} ({meaning})")]
    Status {
        /// Status byte of the header.
        status: u8,
        /// The status in words.
        meaning: &'static str,
    },
    /// The answer announces another length of payload than the command asks for.
    #[error("the answer announces {found} words where {expected} are due")]
    PayloadLength {
        /// Words of payload that the answer announces.
        found: u32,
        /// Words of payload that are due.
        expected: u32,
    },
    /// The answer to an item of a run does not begin with the number of the item and an outcome.
    #[error("the answer to item {item} of a run starts with {found:#010x}, which is not its number with an outcome")]
    Part {
        /// Number of the item.
        item: u32,
        /// First word of its answer.
        found: u32,
    },
    /// An item of a run has an outcome that a sound device does not give to it.
    #[error("an item has the outcome {found}, which is impossible for what was asked of its mesh")]
    Outcome {
        /// Number of the outcome.
        found: u8,
    },
    /// The answer to a question names a vertex that is not in the mesh.
    #[error("it names vertex {vertex}, which is not in its mesh")]
    NoSuchVertex {
        /// Vertex id in the answer.
        vertex: u32,
    },
    /// A count in the insertion report does not agree with the points that were sent.
    #[error("it counts {found} {what} where {expected} are due")]
    Count {
        /// Noun for the things counted, such as `"points inserted"`.
        what: &'static str,
        /// Count in the report.
        found: u32,
        /// Count that follows from the points sent.
        expected: u32,
    },
    /// A record names a vertex that does not exist.
    #[error("record {record} names vertex {vertex}, but only {points} points were sent")]
    VertexOutOfRange {
        /// Number of the record, from 0.
        record: usize,
        /// Vertex id in the record.
        vertex: u32,
        /// Points that were sent.
        points: usize,
    },
    /// A record names a neighbour that does not exist.
    #[error("record {record} names record {neighbor} as a neighbour, but there are only {records}")]
    NeighborOutOfRange {
        /// Number of the record, from 0.
        record: usize,
        /// Record id that the record names as a neighbour.
        neighbor: u32,
        /// Records that the mesh has.
        records: usize,
    },
    /// A record is locked though no insertion is under way.
    #[error("record {record} is locked though no insertion is under way")]
    Locked {
        /// Number of the record, from 0.
        record: usize,
    },
    /// Unused bits of a narrow record are set.
    #[error("word {place} of record {record} is {word:#010x}, but its bits above the two ids must be 0")]
    SpareBits {
        /// Number of the record, from 0.
        record: usize,
        /// Number of the word within the record, from 0.
        place: usize,
        /// Value of the word received.
        word: u32,
    },
    /// The unused half word behind the last packed vertex is not 0.
    #[error("the last word of the triangles up to record {record} is {word:#010x}, but its high half must be 0")]
    SpareHalf {
        /// Number of the last record read.
        record: usize,
        /// Value of the last word received.
        word: u32,
    },
    /// A record has vertices of several jobs of a batch.
    #[error(
        "record {record} of a batch has the vertices {}, {}, {}, which belong to several jobs",
        vertices[0], vertices[1], vertices[2]
    )]
    MixedJobs {
        /// Number of the record, from 0.
        record: usize,
        /// Vertex ids in the record.
        vertices: [u32; 3],
    },
    /// A record has the same vertex twice.
    #[error("record {record} has a vertex twice")]
    RepeatedVertex {
        /// Number of the record, from 0.
        record: usize,
    },
    /// The corners of a triangle are not in counter-clockwise order.
    #[error("record {record}, the triangle {} {} {}, is not counter-clockwise", corners[0], corners[1], corners[2])]
    Orientation {
        /// Number of the record, from 0.
        record: usize,
        /// Corners of the triangle, in the order received.
        corners: [Point; 3],
    },
    /// The same triangle came twice.
    #[error("the triangle of the points {}, {}, {} came twice", triangle[0], triangle[1], triangle[2])]
    TriangleTwice {
        /// Input indices of the corners.
        triangle: [u32; 3],
    },
    /// The ghost triangles do not close one hull.
    #[error(
        "its {ghosts} ghost triangles do not close one hull: the edge that leaves point {point} is missing or doubled"
    )]
    OpenHull {
        /// Number of ghost triangles received.
        ghosts: usize,
        /// Input index of the point where the hull breaks.
        point: u32,
    },
    /// The meshes of the parts of a set do not fit together.
    #[error(
        "its meshes of the parts of a set do not fit together, so one of them is not the Delaunay triangulation of its \
         points"
    )]
    Unsound,
    /// The areas of the triangles do not sum to the area of the hull.
    #[error("its triangles cover {triangles} half grid squares, but its hull covers {hull}")]
    Area {
        /// Twice the area of all triangles, in grid squares.
        triangles: i128,
        /// Twice the area of the hull, in grid squares.
        hull: i128,
    },
}
