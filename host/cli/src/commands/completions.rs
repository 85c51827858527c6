//! `incircle completions`: prints completion scripts for shells.

use clap::CommandFactory;

use crate::arguments::{Cli, CompletionsArguments};
use crate::failure::Failure;
use crate::output;

/// Prints the completion script for the chosen shell.
pub fn run(arguments: &CompletionsArguments) -> Result<(), Failure> {
    // The script is made in memory, because the generator panics if it cannot write.
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "incircle", &mut script);
    output::print(&String::from_utf8_lossy(&script))
}
