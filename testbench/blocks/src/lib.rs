//! Every block of the hardware that is tested alone, in the shapes in which tests run it, by name.
//!
//! The build script of the test bench translates this list, and the tests look blocks up in it.

mod control;
mod exported;
mod leaf;
mod links;
mod serial;
mod stream;
mod visit;

pub use links::{HASTY_LINK, QUICK_LINK};

/// Every block that is tested alone: the name of its root module, and its Verilog.
///
/// # Panics
/// If a block is not fit for export, which is a fault in its source.
pub fn blocks() -> Vec<(String, String)> {
    [leaf::blocks(), visit::blocks(), control::blocks(), serial::blocks(), stream::blocks()].concat()
}
