//! Blocks that use the primitives of the ECP5 instead of the neutral Verilog.

use std::fs;

/// Primitives that have a model in the folder `cells`.
const CELLS: [&str; 2] = ["DP16KD", "MULT18X18D"];

/// Blocks that run in both forms, by the start of their names: the leaves that instantiate primitives,
/// in every shape that is exported.
const LEAVES: [&str; 5] = ["multiplier", "block_memory_", "paced_memory_", "shared_memory_", "lock_memory_"];

/// Returns the block with the primitives and the models of these, or `None` for a block that
/// runs in the neutral form only.
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
