//! The status codes of answers, and the outcomes of the items of runs.

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
    /// A run came where there is no mesh to ask or change: before three points that span a triangle, or in a batch. The
    /// items were taken, nothing was done, and the answer has no payload.
    NoMesh = 7,
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
            7 => Self::NoMesh,
            _ => return None,
        })
    }
}

/// The outcome of one item of a run. After every outcome but `Done`, and `Duplicate` of a `Move`, the mesh is as
/// before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Outcome {
    /// The change was made. The second word is the vertex of the item.
    Done = 0,
    /// The place is that of a vertex. The answer to a `Nearest` has this outcome as well, with the nearest vertex.
    Vertex = 1,
    /// The place lies inside an edge.
    Edge = 2,
    /// The place lies inside a triangle.
    Triangle = 3,
    /// The place lies outside the hull. The edge is the first, counter-clockwise, of the hull edges that are visible
    /// from there.
    Outside = 4,
    /// Another vertex, the second word, has the point of an `InsertAs` or `Move`. An `InsertAs` changes nothing. A
    /// `Move` has deleted its vertex.
    Duplicate = 5,
    /// A `Delete` or `Move` names a vertex that is not in the mesh: never inserted, deleted, or a duplicate.
    Missing = 6,
    /// An `InsertAs` names a vertex that is in the mesh already.
    InUse = 7,
    /// An `InsertAs` names a vertex at or beyond the capacity: the memory has no such vertex.
    Full = 8,
    /// A coordinate has more bits than the coordinates of the device.
    OffGrid = 9,
    /// The vertex of a `Delete` or `Move` has more neighbours than the list of a context has entries; the infinite
    /// vertex counts. The host must make the mesh anew without it.
    ManyNeighbors = 10,
    /// Without the vertex of a `Delete` or `Move`, all points would lie on one line, and there would be no mesh.
    Flat = 11,
}

impl Outcome {
    /// All outcomes, in the order of their numbers.
    pub const ALL: [Self; 12] = [
        Self::Done,
        Self::Vertex,
        Self::Edge,
        Self::Triangle,
        Self::Outside,
        Self::Duplicate,
        Self::Missing,
        Self::InUse,
        Self::Full,
        Self::OffGrid,
        Self::ManyNeighbors,
        Self::Flat,
    ];

    /// The outcome of this number, if there is one.
    pub const fn from_u8(value: u8) -> Option<Self> {
        if (value as usize) < Self::ALL.len() {
            Some(Self::ALL[value as usize])
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_agree() {
        for number in 0..=u8::MAX {
            assert!(Status::from_u8(number).is_none_or(|status| status as u8 == number));
            assert!(Outcome::from_u8(number).is_none_or(|outcome| outcome as u8 == number));
        }
        assert_eq!((0..=u8::MAX).filter_map(Status::from_u8).count(), 8);
        assert_eq!((0..=u8::MAX).filter_map(Outcome::from_u8).count(), Outcome::ALL.len());
    }
}
