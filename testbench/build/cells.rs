//! Blocks with the primitives of the ECP5 instead of the neutral Verilog.

use std::fs;

/// What the models of the primitives are called.
const CELLS: [&str; 2] = ["DP16KD", "MULT18X18D"];

/// Blocks that are run in both forms: the leaves that instantiate primitives, in every shape that is exported.
const LEAVES: [&str; 5] = ["multiplier", "block_memory_", "paced_memory_", "shared_memory_", "lock_memory_"];

/// The block with the primitives, and with models of them, so that it runs; nothing if it is not one that is run so.
pub fn with_primitives(name: &str, verilog: &str) -> Option<String> {
    if !LEAVES.iter().any(|leaf| name.starts_with(leaf)) {
        return None;
    }
    let mut text = format!("`define INCIRCLE_ECP5\n{verilog}");
    for cell in CELLS.iter().filter(|cell| verilog.contains(*cell)) {
        let path = format!("cells/{cell}.v");
        text += &fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    }
    Some(text)
}
