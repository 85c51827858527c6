//! Turns a block into its name and Verilog.

use incircle_hdl::export::{verilog, ExportError};
use rust_hdl_core::prelude::*;

/// Connects a block and exports it under a name.
pub(crate) fn block<U: Block>(mut uut: U, name: &str) -> (String, String) {
    uut.connect_all();
    named(name, verilog(&uut, name))
}

/// Puts the name beside the Verilog of a block.
pub(crate) fn named(name: &str, text: Result<String, ExportError>) -> (String, String) {
    (name.to_string(), text.unwrap_or_else(|error| panic!("block {name}: {error}")))
}
