//! The command `incircle`; everything is in the library of this package.

use std::process::ExitCode;

fn main() -> ExitCode {
    incircle_cli::run(std::env::args_os())
}
