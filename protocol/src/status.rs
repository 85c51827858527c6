//! How a command ended.

/// Status byte of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// The opcode is not known; nothing was done. Words that follow are taken as new commands.
    UnknownOpcode = 1,
    /// The range passes the last record; nothing was sent.
    BadRange = 2,
    /// The first three points lie on one line (or fall together); nothing was inserted. Every later
    /// [`Insert`](crate::Opcode::Insert) is answered the same until a [`Clear`](crate::Opcode::Clear).
    Collinear = 3,
    /// The memory is full: the points past the capacity were refused, all others are in and the mesh is valid.
    Full = 4,
    /// A [`Clear`](crate::Opcode::Clear) asked for more contexts than the core has; nothing was cleared.
    BadContexts = 5,
    /// No point was finished for longer than any insertion takes: a fault in the device. It must be reset.
    Stuck = 6,
}

impl Status {
    /// The status with this number.
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
