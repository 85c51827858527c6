//! Arrays of NumPy, which `.npy` files and the archives `.npz` hold.

mod cells;
mod header;
mod stream;

pub use cells::Cells;
pub use header::Wanted;
pub use stream::Source;
