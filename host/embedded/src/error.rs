//! Errors of the driver, each a sentence with its numbers. None needs an allocator.

/// The reason why there is no mesh.
///
/// `E` is the error of the port. After any of these errors the device can be asked again: each job opens a new session,
/// which resets the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error<E> {
    /// The port reports an error.
    #[error("the serial port failed ({0}): check the port's settings and the wiring")]
    Port(E),
    /// The port reads or writes no byte although it should.
    #[error("the serial port is closed: open it again")]
    Closed,
    /// No byte came back.
    #[error("nothing answers: check that the board has power and its configuration, and that the lines are crossed")]
    Silent,
    /// Bytes came back, but no frame of an incircle device.
    #[error("{bytes} bytes came back, but no frame of an incircle device: check the rate (115,200) and the device")]
    Noise {
        /// Number of bytes received.
        bytes: u32,
    },
    /// The device fell silent in a job.
    #[error("the device said nothing for {milliseconds} ms in the middle of a job: check wiring and power, try again")]
    Lost {
        /// Milliseconds since its last frame.
        milliseconds: u32,
    },
    /// The device forgot the session, because it was reset or heard nothing for too long.
    #[error("the device lost the session, since it was reset or heard nothing for {silence_ms} ms: try again")]
    Reset {
        /// Milliseconds without a frame after which the device forgets a session.
        silence_ms: u32,
    },
    /// Another host opened a session on the same line.
    #[error("another host opened session {session} in the middle of the job: end it, and try again")]
    Taken {
        /// Number of the other session.
        session: u8,
    },
    /// The job took longer than the caller allowed.
    #[error("the job was not done after {milliseconds} ms: allow more time, or check the line for noise")]
    Timeout {
        /// Milliseconds that the caller allowed.
        milliseconds: u32,
    },
    /// A buffer of the caller is too small.
    #[error("the buffer `{name}` has {given} entries, but these points need {needed}")]
    Buffer {
        /// Name of the field of [`Buffers`](crate::Buffers).
        name: &'static str,
        /// Entries of the buffer.
        given: usize,
        /// Entries needed.
        needed: usize,
    },
    /// There are more points than indices of 16 bits.
    #[error("there are {given} points, but this driver numbers at most {most}")]
    TooManyPoints {
        /// Points given.
        given: usize,
        /// Most points.
        most: usize,
    },
    /// The device cannot hold the points.
    #[error("there are {given} distinct points, but the device holds {capacity}: use a larger core, or fewer points")]
    Capacity {
        /// Distinct points.
        given: usize,
        /// Points that the device holds.
        capacity: u32,
    },
    /// A coordinate is beyond the grid of the device.
    #[error("point {index} is at ({x}, {y}), but the device takes coordinates of {bits} bits")]
    Coordinate {
        /// Index of the point.
        index: usize,
        /// First coordinate.
        x: u16,
        /// Second coordinate.
        y: u16,
        /// Bits of a coordinate on the device.
        bits: u32,
    },
    /// The device gave an answer that no sound device gives.
    #[error("{0}: reset the device, and if that does not help, do not trust it")]
    Device(#[source] Fault),
}

impl<E> From<Fault> for Error<E> {
    fn from(fault: Fault) -> Self {
        Self::Device(fault)
    }
}

/// A fault of an unsound device. Noise on the line is repaired and never ends in one of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A word of the greeting is not one of a device that this driver serves.
    #[error("the greeting says {found:#x} as {what}, but this driver serves {least:#x} to {most:#x}")]
    Greeting {
        /// Noun for the number.
        what: &'static str,
        /// Number that the device claims.
        found: u32,
        /// Least number that is served.
        least: u32,
        /// Largest number that is served.
        most: u32,
    },
    /// The device claims more free bytes than its FIFO has.
    #[error("the device claims {free} free bytes in a FIFO of {fifo}")]
    Credit {
        /// Free bytes that the device claims.
        free: u32,
        /// Bytes of the FIFO.
        fifo: u32,
    },
    /// The device took other bytes than were sent, although the check sum of every frame held.
    #[error("the device took other points than were sent: their check sum is {found:#010x}, not {expected:#010x}")]
    PayloadDigest {
        /// Check sum that the device reports.
        found: u32,
        /// Check sum of the bytes that were sent.
        expected: u32,
    },
    /// The check sum of an answer is wrong, although the check sum of its frame held.
    #[error("an answer has the check sum {found:#010x}, but it announces {expected:#010x}")]
    AnswerDigest {
        /// Check sum of the words received.
        found: u32,
        /// Check sum that the device announced.
        expected: u32,
    },
    /// An answer has another length than its command asks for.
    #[error("an answer to command {opcode} has {found} words of payload, not {expected}")]
    AnswerLength {
        /// Number of the command.
        opcode: u8,
        /// Words of payload that came.
        found: u32,
        /// Words of payload of a sound answer.
        expected: u32,
    },
    /// The status of an answer is not `Ok`, or the answer is to another command.
    #[error("the answer to command {opcode} begins with {header:#010x}, which is no success")]
    Status {
        /// Number of the command.
        opcode: u8,
        /// First word of the answer.
        header: u32,
    },
    /// A total of the insert report is wrong.
    #[error("the device reports {found} {what}, not {expected}")]
    Report {
        /// Noun for the things counted.
        what: &'static str,
        /// Number that the device reports.
        found: u32,
        /// Number that follows from the points.
        expected: u32,
    },
    /// A record names a vertex that does not exist, or one vertex twice.
    #[error("record {record} has the vertices {vertices:?}, of which one is out of range or repeated")]
    Vertices {
        /// Number of the record.
        record: usize,
        /// The vertices of the record, as the device numbers them.
        vertices: [u32; 3],
    },
    /// A triangle is flat or turns clockwise.
    #[error("record {record} is no triangle that turns counter-clockwise")]
    Orientation {
        /// Number of the record.
        record: usize,
    },
    /// The ghost triangles do not close one hull.
    #[error("the {ghosts} hull edges do not close at point {point}")]
    OpenHull {
        /// Number of ghost triangles.
        ghosts: usize,
        /// Index of the point at which the hull is open.
        point: u16,
    },
    /// The triangles do not cover the hull.
    #[error("the triangles have twice the area {triangles}, but their hull has {hull}")]
    Area {
        /// Twice the area of all triangles, in grid squares.
        triangles: i64,
        /// Twice the area of the hull, in grid squares.
        hull: i64,
    },
    /// A triangle comes twice.
    #[error("the triangle {0:?} comes twice")]
    TriangleTwice([u16; 3]),
}
