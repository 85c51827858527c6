//! The status codes of answers.

/// Status byte of an answer: how the command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// The command was done.
    Ok = 0,
    /// The opcode is unknown, and nothing was done. The device reads the words that follow as new commands.
    UnknownOpcode = 1,
    /// The range goes beyond the last record, and the answer has no payload.
    BadRange = 2,
    /// The first three points are collinear, or two of them are equal. The mesh stays empty, and every later
    /// [`Insert`](crate::Opcode::Insert) gets the same status until a [`Clear`](crate::Opcode::Clear).
    Collinear = 3,
    /// The memory is full. Points beyond the capacity were refused; all others are in, and the mesh is valid.
    Full = 4,
    /// A [`Clear`](crate::Opcode::Clear) named more contexts than the core has, or a number of meshes that does not
    /// divide them, and nothing was cleared.
    BadContexts = 5,
    /// No insertion ended for longer than the longest one can take: the device has a fault and must be reset.
    Stuck = 6,
}

impl Status {
    /// The status of this number, if there is one.
    pub const fn from_u8(value: u8) -> Option<Self> {
        Some(match value {
            0 => Self::Ok,
            1 => Self::UnknownOpcode,
            2 => Self::BadRange,
            3 => Self::Collinear,
            4 => Self::Full,
            5 => Self::BadContexts,
            6 => Self::Stuck,
            _ => return None,
        })
    }
}
