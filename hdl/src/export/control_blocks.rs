//! The blocks that carry insertions through their phases, and the command streams.

/// The name of each root module, and its Verilog.
pub(super) fn control_blocks() -> Vec<(String, String)> {
    vec![]
}
