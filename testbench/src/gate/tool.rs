//! A tool of the gate, run in a scratch folder.

use std::process::Command;

use super::error::GateError;
use super::scratch::Scratch;

/// Runs a tool and returns everything that it printed.
///
/// # Errors
/// The tool cannot be started, or its exit code is not 0; the error then holds what it printed.
pub(super) fn run(tool: &'static str, arguments: &[&str], top: &str, scratch: &Scratch) -> Result<String, GateError> {
    let output = Command::new(tool)
        .args(arguments)
        .current_dir(scratch.path())
        .output()
        .map_err(|source| GateError::Missing { tool, source })?;
    let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    if output.status.success() {
        Ok(printed)
    } else {
        Err(GateError::Refused { tool, top: top.to_string(), output: printed })
    }
}

/// Returns an error if there are complaints.
pub(super) fn complain(tool: &'static str, top: &str, complaints: &[&str]) -> Result<(), GateError> {
    if complaints.is_empty() {
        return Ok(());
    }
    Err(GateError::Complaint { tool, top: top.to_string(), lines: complaints.join("\n") })
}
