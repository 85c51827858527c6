//! The registers of the stream link. `protocol/STREAM.md` says how a host uses them.

/// Version of the stream link, `major << 16 | minor`. A host refuses a device with another major version, or with
/// an older minor version.
pub const STREAM_VERSION: u32 = 1 << 16;
/// Number of beats that each of the two FIFOs holds.
pub const STREAM_FIFO_BEATS: u32 = 512;
/// Widths of a beat in bits with which a stream link can be built.
pub const BEAT_BITS: [u32; 2] = [64, 128];
/// Size of the register space in bytes.
pub const REGISTER_SPACE: u32 = 4096;

/// A register of the stream link. The value is the register's byte offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum StreamRegister {
    /// The letters `inCi`, [`MAGIC`](crate::MAGIC).
    Magic = 0x00,
    /// Version of the stream link, as [`STREAM_VERSION`] packs it.
    StreamVersion = 0x04,
    /// Version of the protocol. The register and the next five repeat the core's [`Identity`](crate::Identity).
    ProtocolVersion = 0x08,
    /// Version of the core, `major << 16 | minor << 8 | patch`.
    CoreVersion = 0x0c,
    /// Bits of one coordinate.
    CoordBits = 0x10,
    /// Number of points that the memory holds.
    Capacity = 0x14,
    /// Number of contexts of the core.
    Contexts = 0x18,
    /// Number of boundary edges that a context's list holds.
    Ring = 0x1c,
    /// Bits of a beat, one of [`BEAT_BITS`].
    BeatBits = 0x20,
    /// Number of beats that each FIFO holds, [`STREAM_FIFO_BEATS`].
    FifoBeats = 0x24,
    /// Writing [`CONTROL_RESET`] starts a reset. The register reads as [`CONTROL_RESET`] until the reset has ended.
    Control = 0x40,
    /// State of the device, in the bits `STREAM_STATUS_...`.
    Status = 0x44,
    /// Errors so far, in the bits `ERROR_...`. Writing a 1 clears the bit.
    Errors = 0x48,
    /// Header of the last answer that had a status other than `Ok`.
    Fault = 0x4c,
    /// Low half of the count of bus clocks. Reading it stores the high half for `ClocksHigh`.
    ClocksLow = 0x80,
    /// High half of the count of bus clocks, as stored when the low half was read.
    ClocksHigh = 0x84,
    /// Number of command beats that the device took.
    CommandBeats = 0x88,
    /// Number of answer beats that the host took.
    AnswerBeats = 0x8c,
    /// Number of answers that the host took to their last beat.
    Answers = 0x90,
    /// Number of clocks in which a command beat waited.
    CommandWaits = 0x94,
    /// Number of clocks in which an answer beat waited.
    AnswerWaits = 0x98,
}

impl StreamRegister {
    /// All registers, by offset.
    pub const ALL: [Self; 21] = [
        Self::Magic,
        Self::StreamVersion,
        Self::ProtocolVersion,
        Self::CoreVersion,
        Self::CoordBits,
        Self::Capacity,
        Self::Contexts,
        Self::Ring,
        Self::BeatBits,
        Self::FifoBeats,
        Self::Control,
        Self::Status,
        Self::Errors,
        Self::Fault,
        Self::ClocksLow,
        Self::ClocksHigh,
        Self::CommandBeats,
        Self::AnswerBeats,
        Self::Answers,
        Self::CommandWaits,
        Self::AnswerWaits,
    ];

    /// Byte offset of the register.
    pub const fn offset(self) -> u32 {
        self as u32
    }
}

/// Bit of `Control`: resets the core and both FIFOs.
pub const CONTROL_RESET: u32 = 1;
/// Bit of `Status`: the clock of the core runs, and no reset is in progress.
pub const STREAM_STATUS_RUNS: u32 = 1;
/// Bit of `Status`: a FIFO holds beats, or a command has not been answered to its end.
pub const STREAM_STATUS_BUSY: u32 = 1 << 1;
/// Bit of `Status`: a reset is in progress.
pub const STREAM_STATUS_RESETTING: u32 = 1 << 2;
/// Bit of `Status`: some bit of `Errors` is set.
pub const STREAM_STATUS_ERROR: u32 = 1 << 3;
/// Bit of `Errors`: a command beat came without all its bytes and was dropped.
pub const ERROR_PARTIAL_BEAT: u32 = 1;
/// Bit of `Errors`: an answer had a status other than `Ok`.
pub const ERROR_ANSWER_STATUS: u32 = 1 << 1;
