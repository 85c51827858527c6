//! Commands and the headers of their answers.

/// What the host can ask. The opcode stands in the top byte of a command word; the rest is zero but where said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Opcode {
    /// Who are you? No arguments; answered with an [`Identity`](crate::Identity).
    Hello = 1,
    /// Forget all points, triangles and counters. The low byte of the command word is the number of contexts that work from now on,
    /// 0 for all; see [`clear_word`]. With [`CLEAR_BATCH`] each of them works on a mesh of its own; see [`batch_word`]. No arguments, no
    /// payload. O(1).
    Clear = 2,
    /// Insert points: a word with their number, then the points. Answered, when the last point is in, with
    /// an [`InsertReport`](crate::InsertReport).
    Insert = 3,
    /// Read triangle records: a word with the first id, a word with their number. Answered with the records, or with
    /// [`Status::BadRange`](crate::Status::BadRange) and no payload if the range passes the last record.
    Read = 4,
    /// Read the counters. No arguments; answered with [`COUNTER_WORDS`](crate::COUNTER_WORDS) words.
    Counters = 5,
    /// Read the histogram of insertion latencies. No arguments; answered with [`LATENCY_BUCKETS`](crate::LATENCY_BUCKETS) words.
    Latencies = 6,
    /// Read the vertices of triangle records without their links: arguments as of [`Opcode::Read`]. Answered with the ids as
    /// [`Layout::triangles_words`](crate::Layout::triangles_words) packs them.
    Triangles = 7,
}

/// A command word that asks for nothing and is not answered: links with wide beats fill them with it.
pub const PADDING: u32 = 0;

impl Opcode {
    /// The opcode with this number.
    pub const fn from_u8(value: u8) -> Option<Self> {
        Some(match value {
            1 => Self::Hello,
            2 => Self::Clear,
            3 => Self::Insert,
            4 => Self::Read,
            5 => Self::Counters,
            6 => Self::Latencies,
            7 => Self::Triangles,
            _ => return None,
        })
    }
}

/// The word that starts a command.
pub const fn command_word(opcode: Opcode) -> u32 {
    (opcode as u32) << 24
}

/// The word of a [`Clear`](Opcode::Clear) for this many contexts; 0 is all the device has.
///
/// At most 255 contexts can be named; more are named as 255, which every device refuses.
pub const fn clear_word(contexts: u32) -> u32 {
    command_word(Opcode::Clear) | if contexts > 255 { 255 } else { contexts }
}

/// The bit of a [`Clear`](Opcode::Clear) that starts a batch.
pub const CLEAR_BATCH: u32 = 1 << 8;

/// The word of a [`Clear`](Opcode::Clear) for a batch: from then on each of this many contexts works alone on a mesh of its own.
pub const fn batch_word(contexts: u32) -> u32 {
    clear_word(contexts) | CLEAR_BATCH
}

/// A `Clear` starts a batch.
pub const fn command_starts_batch(word: u32) -> bool {
    word & CLEAR_BATCH != 0
}

/// The contexts that a `Clear` names.
pub const fn command_contexts(word: u32) -> u32 {
    word & 0xff
}

/// The opcode byte of a command word.
pub const fn command_opcode(word: u32) -> u8 {
    (word >> 24) as u8
}

/// The first word of an answer: opcode in the top byte, status in the next, zeros below.
/// An unknown opcode is echoed as it came.
pub const fn answer_header(opcode: u8, status: crate::status::Status) -> u32 {
    (opcode as u32) << 24 | (status as u32) << 16
}

/// The opcode an answer belongs to.
pub const fn answer_opcode(header: u32) -> u8 {
    (header >> 24) as u8
}

/// The status byte of an answer.
pub const fn answer_status(header: u32) -> u8 {
    (header >> 16) as u8
}
