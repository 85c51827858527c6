//! The stream link's registers; `protocol/STREAM.md` says what they mean.

/// Version of the stream link, `major << 16 | minor`. A host refuses a device of another major version, or of an older minor one.
pub const STREAM_VERSION: u32 = 1 << 16;
/// Beats that each FIFO holds.
pub const STREAM_FIFO_BEATS: u32 = 512;
/// Bits of a beat that a stream can be built with.
pub const BEAT_BITS: [u32; 2] = [64, 128];
/// Bytes of the register space.
pub const REGISTER_SPACE: u32 = 4096;

/// A register; its value is its byte offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum StreamRegister {
    /// [`MAGIC`](crate::MAGIC).
    Magic = 0x00,
    /// [`STREAM_VERSION`].
    StreamVersion = 0x04,
    /// As in the identity, like the next five.
    ProtocolVersion = 0x08,
    /// Version of the core.
    CoreVersion = 0x0c,
    /// Bits of a coordinate.
    CoordBits = 0x10,
    /// Points it holds.
    Capacity = 0x14,
    /// Insertions it works on at once.
    Contexts = 0x18,
    /// Boundary edges of a cavity it keeps.
    Ring = 0x1c,
    /// Bits of a beat.
    BeatBits = 0x20,
    /// [`STREAM_FIFO_BEATS`].
    FifoBeats = 0x24,
    /// Writing [`CONTROL_RESET`] resets; reads as that until the reset has ended.
    Control = 0x40,
    /// What the device is at: `STREAM_STATUS_...`.
    Status = 0x44,
    /// `ERROR_...`; writing a 1 clears a bit.
    Errors = 0x48,
    /// Header of the last answer with a status other than `Ok`.
    Fault = 0x4c,
    /// Clocks of the bus; reading keeps the high half.
    ClocksLow = 0x80,
    /// The high half that was kept.
    ClocksHigh = 0x84,
    /// Command beats taken.
    CommandBeats = 0x88,
    /// Answer beats taken.
    AnswerBeats = 0x8c,
    /// Answers taken to their last beat.
    Answers = 0x90,
    /// Clocks that a command beat waited.
    CommandWaits = 0x94,
    /// Clocks that an answer beat waited.
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

    /// Its byte offset.
    pub const fn offset(self) -> u32 {
        self as u32
    }
}

/// Bit of `Control`: reset the core and both FIFOs.
pub const CONTROL_RESET: u32 = 1;
/// Bit of `Status`: the core's clock runs, and no reset is under way.
pub const STREAM_STATUS_RUNS: u32 = 1;
/// Bit of `Status`: beats are held, or a command has not been answered to its end.
pub const STREAM_STATUS_BUSY: u32 = 1 << 1;
/// Bit of `Status`: a reset is under way.
pub const STREAM_STATUS_RESETTING: u32 = 1 << 2;
/// Bit of `Status`: some bit of `Errors` is set.
pub const STREAM_STATUS_ERROR: u32 = 1 << 3;
/// Bit of `Errors`: a beat without all its bytes was dropped.
pub const ERROR_PARTIAL_BEAT: u32 = 1;
/// Bit of `Errors`: an answer had a status other than `Ok`.
pub const ERROR_ANSWER_STATUS: u32 = 1 << 1;
