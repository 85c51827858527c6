//! Every block of the hardware that is tested alone, in the shapes in which tests run it, by name.
//!
//! The build script of the test bench translates this list, and the tests look blocks up in it.

mod control;
mod leaf;
mod serial;
mod stream;
mod visit;

use incircle_hdl::export::{verilog, ExportError};
use incircle_protocol::LinkConfig;
use rust_hdl_core::prelude::*;

/// A link that is quick to simulate: under nine clocks a bit at the first rate, short silence, and the smallest FIFO.
pub const QUICK_LINK: LinkConfig = LinkConfig { clock_hz: 1_000_000, fifo_bytes: 2_048, silence_ms: 400 };

/// The same, and forgets its session at once.
pub const HASTY_LINK: LinkConfig = LinkConfig { silence_ms: 20, ..QUICK_LINK };

/// Every block that is tested alone: the name of its root module, and its Verilog.
///
/// # Panics
/// If a block is not fit for export, which is a fault in its source.
pub fn blocks() -> Vec<(String, String)> {
    [leaf::blocks(), visit::blocks(), control::blocks(), serial::blocks(), stream::blocks()].concat()
}

/// Connects a block and exports it under a name.
fn block<U: Block>(mut uut: U, name: &str) -> (String, String) {
    uut.connect_all();
    named(name, verilog(&uut, name))
}

fn named(name: &str, text: Result<String, ExportError>) -> (String, String) {
    (name.to_string(), text.unwrap_or_else(|error| panic!("block {name}: {error}")))
}
