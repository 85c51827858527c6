//! Rewrites Verilog before its translation, so that a clock of the model costs less. What the module does stays the
//! same, at every clock and every output.

mod inputs;
mod processes;

use super::error::BuildError;
use super::source::ModelSource;

/// The text that Verilator gets for this model.
pub(super) fn rewritten(model: &ModelSource) -> Result<String, BuildError> {
    if !model.fast_clocks {
        return Ok(model.verilog.clone());
    }
    let held = inputs::held(&model.verilog, &model.top);
    let held = held.ok_or_else(|| BuildError::Inputs { model: model.name.clone(), top: model.top.clone() })?;
    Ok(processes::divided(&held))
}
