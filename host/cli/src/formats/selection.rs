//! Which points of a file are taken.

use crate::number::Decimal;

/// The choices that say which points of a file are taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// The name of the array in an archive of arrays.
    pub array: Option<String>,
    /// The classes of LiDAR points that are taken; all if there are none.
    pub classes: Vec<u8>,
    /// The rectangle whose points are taken.
    pub bounds: Option<Bounds>,
}

/// A rectangle with its edges, in the numbers as the user wrote them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The lowest x and y.
    pub low: [Decimal; 2],
    /// The highest x and y.
    pub high: [Decimal; 2],
}
