//! Sets of any size, by tiles.

mod product;
mod reach;
mod region;

pub use reach::{reach, Reach, Sides, TilePoint};
pub use region::Region;
