//! What the formats whose files are read piece by piece have in common.

use crate::failure::Failure;
use crate::points::Coordinates;

/// A function that takes the coordinates of the next points of a file.
pub type Take<'a> = &'a mut dyn FnMut(&Coordinates) -> Result<(), Failure>;

/// A function that takes the next triangle of a file.
pub type TakeTriangle<'a> = &'a mut dyn FnMut([u32; 3]) -> Result<(), Failure>;

/// The failure of a file that must have some bytes and has none.
pub fn no_byte() -> Failure {
    Failure::input("the file is empty: a set without points is a file with a header, such as 'x,y'")
}
