//! Every block of the hardware that is tested by itself, by name, in the shapes in which tests run it.
//!
//! The build script of the test bench translates this list, and the tests look blocks up in it.

mod control;
mod ethernet;
mod exported;
mod leaf;
mod links;
mod living;
mod serial;
mod stream;
mod udp;
mod visit;

pub use ethernet::PHY_WRITES;
pub use links::{HASTY_LINK, QUICK_LINK};
pub use udp::{QUICK_UDP_LINK, UDP_PAGE_LINK};

/// Returns the name of the root module and the Verilog of every block that is tested by itself.
///
/// # Panics
/// Panics if a block is not fit for export, which is a fault in its source.
pub fn blocks() -> Vec<(String, String)> {
    [
        leaf::blocks(),
        visit::blocks(),
        living::blocks(),
        control::blocks(),
        serial::blocks(),
        stream::blocks(),
        ethernet::blocks(),
        udp::blocks(),
    ]
    .concat()
}
