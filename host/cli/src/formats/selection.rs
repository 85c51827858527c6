//! The choice of the points that are taken from a file.

use crate::number::Decimal;

/// The options that select points of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// The name of the array in an archive of arrays.
    pub array: Option<String>,
    /// The classes of LiDAR points that are taken. If the list is empty, all classes are.
    pub classes: Vec<u8>,
    /// The rectangle whose points are taken.
    pub bounds: Option<Bounds>,
    /// The column of a CSV file that is taken for z: its name in the header, or its number, counted from 1.
    pub value: Option<String>,
}

/// A rectangle with its edges, in the numbers as the user wrote them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The lowest x and y.
    pub low: [Decimal; 2],
    /// The highest x and y.
    pub high: [Decimal; 2],
}
