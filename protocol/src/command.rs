//! Commands and the headers of their answers.

/// What the host can ask. The opcode stands in the top byte of a command word; the rest is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Opcode {
    /// Who are you? No arguments; answered with an [`Identity`](crate::Identity).
    Hello = 1,
    /// Forget all points, triangles and counters. No arguments, no payload. O(1).
    Clear = 2,
    /// Insert points: a word with their number, then the points. Answered, when the last point is in, with
    /// an [`InsertReport`](crate::InsertReport).
    Insert = 3,
    /// Read triangle records: a word with the first id, a word with their number. Answered with the records, or with
    /// [`Status::BadRange`](crate::Status::BadRange) and no payload if the range passes the last record.
    Read = 4,
    /// Read the counters. No arguments; answered with [`COUNTER_WORDS`](crate::COUNTER_WORDS) words.
    Counters = 5,
}

impl Opcode {
    /// The opcode with this number.
    pub const fn from_u8(value: u8) -> Option<Self> {
        Some(match value {
            1 => Self::Hello,
            2 => Self::Clear,
            3 => Self::Insert,
            4 => Self::Read,
            5 => Self::Counters,
            _ => return None,
        })
    }
}

/// The word that starts a command.
pub const fn command_word(opcode: Opcode) -> u32 {
    (opcode as u32) << 24
}

/// The opcode byte of a command word.
pub const fn command_opcode(word: u32) -> u8 {
    (word >> 24) as u8
}

/// The first word of an answer: opcode in the top byte, status in the next, zeros below.
/// An unknown opcode is echoed as it came.
pub const fn answer_header(opcode: u8, status: crate::Status) -> u32 {
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
