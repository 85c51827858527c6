//! Sets of any size, by tiles.

mod error;
mod join;
mod local;
mod product;
mod reach;
mod region;
#[cfg(test)]
mod tests;
mod tree;
mod triangulate;

pub use error::Error;
pub use join::{join, Union};
pub use local::{local, Border, Tile};
pub use reach::{reach, Reach, Sides, TilePoint};
pub use region::Region;
pub use tree::{Step, Tree};
pub use triangulate::triangulate;
