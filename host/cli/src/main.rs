//! The command `incircle`. All its code is in the library of this package.

use std::process::ExitCode;

fn main() -> ExitCode {
    incircle_cli::run(std::env::args_os())
}
