//! Arrays of NumPy, which `.npy` files and the archives `.npz` hold.

mod cells;
mod header;
mod pieces;
mod stream;

pub use cells::Cells;
pub use header::{Layout, Wanted};
pub use pieces::Pieces;
pub use stream::Source;
