//! The Verilog of every exported block, as a model that runs.

use verilated::Model;

verilated::include_models!();

/// The block of this name with zero state; see `incircle_blocks::blocks`.
///
/// # Panics
/// With the list of blocks, if none has this name.
pub fn model(name: &str) -> Model {
    Model::new(description(name))
}

/// The block of this name with random registers and memories, the same for the same seed.
///
/// # Panics
/// As [`model`].
pub fn randomized(name: &str, seed: u32) -> Model {
    Model::randomized(description(name), seed)
}

fn description(name: &str) -> &'static verilated::ModelDescription {
    find(name).unwrap_or_else(|| panic!("no block {name:?}; there are {}", NAMES.join(", ")))
}
