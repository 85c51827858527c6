//! The reasons why Verilog does not pass the gate.

/// The reasons why Verilog does not pass the gate.
#[derive(Debug, thiserror::Error)]
pub enum GateError {
    /// The tool cannot be started.
    #[error("cannot run {tool} ({source}): install the Debian package {tool}")]
    Missing {
        /// Name of the program.
        tool: &'static str,
        /// The reason that the system gives.
        source: std::io::Error,
    },
    /// The tool ended with an error.
    #[error("{tool} refuses {top}:\n{output}")]
    Refused {
        /// Name of the program.
        tool: &'static str,
        /// Name of the top module.
        top: String,
        /// Everything that the tool printed.
        output: String,
    },
    /// The tool ended well but printed a message that counts as a fault in this project.
    #[error("{tool} says of {top}:\n{lines}")]
    Complaint {
        /// Name of the program.
        tool: &'static str,
        /// Name of the top module.
        top: String,
        /// The lines with the faults.
        lines: String,
    },
    /// The tool's report does not have the known form.
    #[error("the report of {tool} on {top} cannot be read: {reason}")]
    Report {
        /// Name of the program.
        tool: &'static str,
        /// Name of the top module.
        top: String,
        /// The fault of the report.
        reason: String,
    },
    /// The scratch folder cannot be used.
    #[error("cannot use the scratch folder: {0}")]
    Scratch(#[from] std::io::Error),
}
