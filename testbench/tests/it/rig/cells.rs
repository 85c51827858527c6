//! What blocks take of an ECP5.

use incircle_testbench::gate::{cell_count, Cells};

/// What the exported block of this name takes in an ECP5, with these lines before its Verilog.
pub fn cells_with(defines: &str, name: &str) -> Cells {
    let blocks = incircle_blocks::blocks();
    let (_, verilog) = blocks.iter().find(|block| block.0 == name).expect("a block of this name");
    cell_count(&format!("{defines}{verilog}"), name).unwrap_or_else(|error| panic!("{error}"))
}

/// The same, in neutral Verilog.
pub fn cells(name: &str) -> Cells {
    cells_with("", name)
}
