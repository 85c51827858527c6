//! Passes every exported block through the gate, each in a folder of its own.

use incircle_testbench::gate;

#[test]
fn every_block_passes_lint_and_synthesis() {
    let blocks = incircle_blocks::blocks();
    assert!(!blocks.is_empty());
    let failures: Vec<_> = blocks
        .iter()
        .filter_map(|(name, verilog)| gate::pass(verilog, name).err())
        .map(|error| error.to_string())
        .collect();
    assert!(failures.is_empty(), "{} of {} blocks fail:\n{}", failures.len(), blocks.len(), failures.join("\n"));
}
