//! The Verilog of every exported block as a model that runs.

use verilated::Model;

verilated::include_models!();

/// Builds the block of this name with a state of zeros; `incircle_blocks::blocks` has the names.
///
/// # Panics
/// Panics with the list of blocks if none has this name.
pub fn model(name: &str) -> Model {
    Model::new(description(name))
}

/// Builds the block of this name with random registers and memories, the same for the same seed.
///
/// # Panics
/// Panics as [`model`] does.
pub fn randomized(name: &str, seed: u32) -> Model {
    Model::randomized(description(name), seed)
}

fn description(name: &str) -> &'static verilated::ModelDescription {
    find(name).unwrap_or_else(|| panic!("no block {name:?}; the blocks are {}", NAMES.join(", ")))
}
