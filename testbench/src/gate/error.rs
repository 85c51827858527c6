//! Why Verilog does not pass the gate.

/// Why Verilog does not pass.
#[derive(Debug, thiserror::Error)]
pub enum GateError {
    /// The tool cannot be started.
    #[error("cannot run {tool} ({source}): install the Debian package {tool}")]
    Missing {
        /// The program.
        tool: &'static str,
        /// What the system says.
        source: std::io::Error,
    },
    /// The tool ended with an error.
    #[error("{tool} refuses {top}:\n{output}")]
    Refused {
        /// The program.
        tool: &'static str,
        /// The top module.
        top: String,
        /// All that the tool printed.
        output: String,
    },
    /// The tool ended well but printed what is a fault in this project.
    #[error("{tool} says of {top}:\n{lines}")]
    Complaint {
        /// The program.
        tool: &'static str,
        /// The top module.
        top: String,
        /// The lines that complain.
        lines: String,
    },
    /// The tool's report is not in the form known.
    #[error("the report of {tool} on {top} cannot be read: {reason}")]
    Report {
        /// The program.
        tool: &'static str,
        /// The top module.
        top: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The scratch folder fails.
    #[error("cannot use the scratch folder: {0}")]
    Scratch(#[from] std::io::Error),
}
