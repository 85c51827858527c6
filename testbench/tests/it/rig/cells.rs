//! Counts the cells that blocks take in an ECP5.

use incircle_testbench::gate::{cell_count, Cells};

/// Counts the cells of the exported block of this name, with these lines before its Verilog.
pub fn cells_with(defines: &str, name: &str) -> Cells {
    let blocks = incircle_blocks::blocks();
    let (_, verilog) = blocks.iter().find(|block| block.0 == name).expect("a block of this name");
    cell_count(&format!("{defines}{verilog}"), name).unwrap_or_else(|error| panic!("{error}"))
}

/// Counts the cells of the exported block of this name in neutral Verilog.
pub fn cells(name: &str) -> Cells {
    cells_with("", name)
}
