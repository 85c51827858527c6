//! `incircle completions`: completion scripts.

use clap::CommandFactory;

use crate::arguments::{Cli, CompletionsArguments};
use crate::failure::Failure;
use crate::output;

/// Runs the subcommand.
pub fn run(arguments: &CompletionsArguments) -> Result<(), Failure> {
    // Into memory first: the generator panics when it cannot write.
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "incircle", &mut script);
    output::print(&String::from_utf8_lossy(&script))
}
